// The lines of an OBJ file as a stream buffer: hands out one line at a time, so that a reader's callbacks know where they
// are, and refuses damaged lines before anything parses them.
#pragma once

#include <cstddef>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

namespace roomlight::importers {

class ObjLines : public std::streambuf {
 public:
  explicit ObjLines(std::string_view text) : rest_(text) {}

  size_t number() const { return number_; }                               // of the line handed out last, from 1
  std::string place() const { return "line " + std::to_string(number_); }
  const std::string& failure() const { return failure_; }                 // why reading stopped early, or empty
  const std::vector<std::string>& libraries() const { return libraries_; }  // names after mtllib so far

  size_t linesAndPoints() const { return linesAndPoints_; }  // elements that are no surfaces
  size_t freeForm() const { return freeForm_; }              // curves and patches

 protected:
  int_type underflow() override;

 private:
  void takeLine();
  void check();

  std::string_view rest_;
  std::string line_;
  size_t number_ = 0, next_ = 1;
  size_t linesAndPoints_ = 0, freeForm_ = 0;
  std::vector<std::string> libraries_;
  std::string failure_;
};

}  // namespace roomlight::importers
