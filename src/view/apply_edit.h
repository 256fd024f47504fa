// An edit of a browser, put into a state or refused as a whole.
#pragma once

#include <optional>
#include <string>

#include "view/home.h"
#include "view/message.h"

namespace roomlight::view {

struct Edited {
  HomeState state;
  std::string label;  // in words: "Dim Sofa lamp"
  std::optional<size_t> moved{};  // number of the thing that was moved or turned
};

// Errors name the field: one that the thing does not have, or that goes against another.
std::optional<ViewError> applyEdit(const EditableHome& home, const Scene& scene, const Edit& edit, const HomeState& now,
                                   Edited& out);

}  // namespace roomlight::view
