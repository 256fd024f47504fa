// Photometric files as text: lines, words and numbers that remember where they stand. Readers of this folder throw
// Damage; the functions that others call turn it into an Error.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace roomlight::photometric {

struct Damage : std::runtime_error {
  using std::runtime_error::runtime_error;  // "line 12: what is wrong"
};

[[noreturn]] void damage(size_t line, const std::string& what);  // line: from 1; 0: none

// What a file could be read in spite of; each kind once.
class Oddities {
 public:
  void add(const std::string& what);
  const std::vector<std::string>& lines() const { return lines_; }

 private:
  std::vector<std::string> lines_;
};

struct Line {
  size_t number;     // from 1
  std::string text;  // UTF-8, without spaces at its ends
};

// LF, CRLF and CR end lines. A byte-order mark and Latin-1 letters are oddities; NUL characters and more than 16 MiB
// are damage.
std::vector<Line> linesOf(std::string_view text, Oddities& odd);

// The whole of `text` as a finite number of at most 1e12; fails with what the number is for.
double numberIn(std::string_view text, size_t line, const std::string& what);

// Values separated by blanks, commas and line ends, one after the other.
class Words {
 public:
  Words(const std::vector<Line>& lines, size_t firstLine) : lines_(lines), line_(firstLine) {}

  double number(const std::string& what);
  size_t count(const std::string& what, size_t most);  // a whole number from 1
  std::vector<double> numbers(size_t count, const std::string& what);
  size_t lineNumber() const { return lastLine_; }  // of the last one read
  bool atEnd();
  size_t left() const;  // at most so many values can follow

 private:
  bool find();

  const std::vector<Line>& lines_;
  size_t line_, at_ = 0, lastLine_ = 0;
};

}  // namespace roomlight::photometric
