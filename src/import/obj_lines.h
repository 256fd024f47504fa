// The lines of an OBJ file and the words in them.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace roomlight::importers {

class ObjLines {
 public:
  explicit ObjLines(std::string_view text);

  // The next line, without blanks at its ends; a backslash at its end joins the one after. It is good until the next
// call.
  bool next(std::string_view& line);

  size_t number() const { return number_; }  // of the line handed out last, from 1
  std::string place() const { return "line " + std::to_string(number_); }

 private:
  std::string_view takePart(bool& joined);

  std::string_view rest_;
  std::string joined_;
  size_t number_ = 0, next_ = 1;
};

// Takes the first word off the text; empty at its end.
std::string_view nextWord(std::string_view& text);

// NaN where the word is no finite float. "+1", "1." and a decimal comma are numbers too.
float objNumber(std::string_view word);

// Which position, texture coordinate and normal: as the file counts them, from 1 or back from -1; 0: none.
struct ObjCorner {
  int64_t v = 0, vt = 0, vn = 0;
};
// "7", "7/1", "7//2", "7/1/2"; none where the word is something else.
std::optional<ObjCorner> objCorner(std::string_view word);

}  // namespace roomlight::importers
