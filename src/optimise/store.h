// What a run keeps in its folder, so that it can go on: the response and the state of the search, each with a hash of
// all it depends on.
#pragma once

#include <filesystem>
#include <string>

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
struct ResponseSizes {
  size_t candidates = 0, elements = 0, eyes = 0, conditions = 0;
};
Status saveResponse(const std::filesystem::path& file, const std::string& hash, const Response& response);
Result<std::optional<Response>> loadResponse(const std::filesystem::path& file, const std::string& hash,
                                             const ResponseSizes& sizes);

Status saveSearch(const std::filesystem::path& file, const std::string& hash, const search::State& state);
Result<std::optional<search::State>> loadSearch(const std::filesystem::path& file, const std::string& hash,
                                                const search::Problem& problem);

}  // namespace roomlight::optimise
