#include "json/json_file.h"

#include "base/utf8.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <stdexcept>
#include <vector>

namespace roomlight {
namespace {

constexpr uintmax_t kLargestFileBytes = 16u << 20;
constexpr int kDeepest = 32;
constexpr size_t kLongestMessage = 600;

// Watches the parser: stops at what it would accept and we do not.
class Guard {
 public:
  bool operator()(int depth, nlohmann::json::parse_event_t event, nlohmann::json& value) {
    using Event = nlohmann::json::parse_event_t;
    if ((event == Event::object_start || event == Event::array_start) && depth >= kDeepest) {
      throw std::runtime_error(fmt::format("nested more than {} deep", kDeepest));
    }
    if (event == Event::object_start) keysOfOpenObjects_.emplace_back();
    if (event == Event::object_end) keysOfOpenObjects_.pop_back();
    if (event == Event::key && !keysOfOpenObjects_.back().insert(value.get<std::string>()).second) {
      throw std::runtime_error(fmt::format("the key '{}' is given twice", printable(value.get<std::string>())));
    }
    return true;
  }

 private:
  std::vector<std::set<std::string>> keysOfOpenObjects_;
};

Result<nlohmann::json> parsed(std::string_view text, bool comments) {
  try {
    Guard guard;
    return nlohmann::json::parse(text, std::ref(guard), true, comments);
  } catch (const std::exception& e) {
    // nlohmann's own: "[json.exception.parse_error.101] parse error at line 3, column 5: ..."
    const std::string_view what = e.what();
    const size_t close = what.starts_with("[json") ? what.find("] ") : std::string_view::npos;
    return Error{printable(close == std::string_view::npos ? what : what.substr(close + 2), kLongestMessage)};
  }
}

}  // namespace

Result<nlohmann::json> parseJson(std::string_view text) { return parsed(text, false); }

Result<nlohmann::json> readJsonFile(const std::filesystem::path& file) {
  const auto error = [&](std::string_view what) {
    return Error{fmt::format("{}: {}", file.string(), printable(what, kLongestMessage))};
  };
  std::error_code code;
  const uintmax_t size = std::filesystem::file_size(file, code);
  if (code) return error(std::filesystem::exists(file, code) ? "not a readable file" : "no such file");
  if (size > kLargestFileBytes)
    return error(fmt::format("larger than {} MiB; this is no lighting file", kLargestFileBytes >> 20));
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  if (!in.good() && !in.eof()) return error("cannot be read");
  Result<nlohmann::json> document = parsed(text, true);
  if (!document) return error(document.error());
  return document;
}

}  // namespace roomlight
