// What a run keeps in its folder, so that it can go on: the response and the state of the search, each with a hash of
// all it depends on.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "optimise/response.h"
#include "scene/scene.h"
#include "search/search.h"

namespace roomlight::optimise {

std::string hashOfFile(const std::filesystem::path& file);  // "-" where there is none to read
// Of all that a response and a search of it depend on: study and catalogue as files, settings, and the home as it is
// and as it is lit in every condition and by the luminaires, which is what comes of all other files. Errors: of
// lighting files and those that they name.
Result<std::string> inputHash(const Scene& home, const StudyFile& study, const std::string& settings);

// Whole or not at all; what is loaded is what was saved, bit by bit. None where there is no file, or one of other
// inputs or sizes; the error is of a file that is not as it was written.
Status saveResponse(const std::filesystem::path& file, const std::string& hash, const Response& response);
Result<std::optional<Response>> loadResponse(const std::filesystem::path& file, const std::string& hash,
                                             const ResponseSizes& sizes);

// Items of a response (ResponseItem), a file each, as several processes find them. `hash` and sizes are of the whole.
struct ItemPlace {
  size_t index = 0, all = 0;  // of so many
  bool operator==(const ItemPlace&) const = default;
};
std::string itemFileName(const ItemPlace& place);  // "response_0003_of_0012.item"
Status saveItem(const std::filesystem::path& folder, const std::string& hash, const ResponseSizes& sizes,
                const ItemPlace& place, const ResponseItem& item);
// As loadResponse().
Result<std::optional<ResponseItem>> loadItem(const std::filesystem::path& folder, const std::string& hash,
                                             const ResponseSizes& sizes, const ItemPlace& place);

// Writes the response of items that lie in several folders, as saveResponse() does, without the study that they are of.
// Files of other names are passed over. Returns how many items there are; the error is of a damaged file, of items of
// different studies, or names what is missing.
Result<size_t> joinItems(const std::vector<std::filesystem::path>& files, const std::filesystem::path& response);

Status saveSearch(const std::filesystem::path& file, const std::string& hash, const search::State& state);
Result<std::optional<search::State>> loadSearch(const std::filesystem::path& file, const std::string& hash,
                                                const search::Problem& problem);

}  // namespace roomlight::optimise
