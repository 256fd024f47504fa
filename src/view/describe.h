// The home and its state as messages to browsers have them (docs/reference/view-protocol.md).
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "view/home.h"
#include "view/overlaps.h"
#include "view/window.h"

namespace roomlight::view {

using Json = nlohmann::ordered_json;

Json vectorJson(Vec3 v);
Json lampJson(const EditableHome& home, size_t index, const HomeState& state);
Json objectJson(const EditableHome& home, const Scene& scene, size_t index, const HomeState& state);
// Pairs of things that run into each other.
Json overlapsJson(const std::vector<Overlap>& overlaps);
Json sunJson(const ViewHome& home, const HomeState& state);
std::string lampId(size_t index);
std::string objectId(size_t index);

// What is in `welcome` and never changes.
Json homeJson(const ViewHome& home);
// What is in it of the window.
void addWindow(const Window& window, Json& welcome);

// Text for the wire: what is not UTF-8 in names of files is replaced.
std::string textOf(const Json& json);
std::string errorText(const ViewError& error);
std::string okText(uint32_t id);
// What was asked about a point; `hit` null: there is nothing, or it is of no interest any more.
std::string pointText(const Point& asked, Json hit);

}  // namespace roomlight::view
