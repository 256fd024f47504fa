// What a run keeps in its folder, so that it can go on: the response and the state of the search, each with a hash of
 // all it depends on.
#pragma once

#include <filesystem>

#include "optimise/response.h"
#include "search/search.h"

namespace roomlight::optimise {

// 64 bits (FNV-1a) in hexadecimal.
std::string hashOf(std::string_view text);
std::string hashOfFile(const std::filesystem::path& file);  // "-" where there is none to read
// Of home, study, catalogue with its photometric files, lighting, and settings.
std::string inputHash(const std::filesystem::path& home, const StudyFile& study, const std::string& settings);
// Of what an imported home took from other files too: shapes, pictures, and what materials look like.
std::string hashOfScene(const Scene& scene);

// Whole or not at all.
Status saveResponse(const std::filesystem::path& file, const std::string& hash, const Response& response);
// None where there is none, or one of other inputs or sizes.
struct ResponseSizes {
  size_t candidates = 0, elements = 0, eyes = 0, conditions = 0;
};
std::optional<Response> loadResponse(const std::filesystem::path& file, const std::string& hash,
                                     const ResponseSizes& sizes);

Status saveSearch(const std::filesystem::path& file, const std::string& hash, const search::State& state);
std::optional<search::State> loadSearch(const std::filesystem::path& file, const std::string& hash,
                                        const search::Problem& problem);

}  // namespace roomlight::optimise
