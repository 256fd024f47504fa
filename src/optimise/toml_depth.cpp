#include "optimise/toml_tree.h"

#include <algorithm>
#include <string>
#include <vector>

namespace roomlight::optimise {
namespace {

// Reads no more of TOML than where keys, values, brackets, texts and comments begin and end.
class Scan {
 public:
  explicit Scan(std::string_view text) : text_(text) {}

  int lineTooDeep(size_t most) {
    for (; at_ < text_.size(); ++at_) {
      step(text_[at_]);
      if (depth_ > most) return 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + at_, '\n'));
    }
    return 0;
  }

 private:
  struct Open {
    bool table;  // else a list
    size_t outside;  // depth
  };

  void step(char c) {
    switch (c) {
      case '\n':
        if (open_.empty()) key_ = true, header_ = false, depth_ = table_;
        break;
      case '#': at_ = std::min(text_.find('\n', at_), text_.size()) - 1; break;
      case '"':
      case '\'': passText(c); break;
      case '.': depth_ += key_; break;
      case '=': key_ = false; break;
      case ',':
        if (!open_.empty()) key_ = open_.back().table, depth_ = open_.back().outside + 1;
        break;
      case '[':
      case '{': open(c == '{'); break;
      case ']':
      case '}': close(); break;
      default: break;
    }
  }

  // Where a key could be, it is a header: [a.b] is a table in a table, [[a]] a table in a list.
  void open(bool table) {
    if (key_ && open_.empty()) {
      depth_ = header_ ? depth_ + 1 : 1, header_ = true;
      return;
    }
    open_.push_back({table, depth_});
    ++depth_, key_ = table;
  }

  void close() {
    if (open_.empty()) {
      if (header_) table_ = depth_;
      return;
    }
    depth_ = open_.back().outside, key_ = false;
    open_.pop_back();
  }

  // On to the last quote of the text that begins here; one without three quotes ends with its line at the latest.
  void passText(char quote) {
    const std::string three(3, quote);
    const bool lines = text_.substr(at_).starts_with(three);
    at_ += lines ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\' && quote == '"') {
        ++at_;
      } else if (!lines && text_[at_] == '\n') {
        --at_;
        return;
      } else if (!lines && text_[at_] == quote) {
        return;
      } else if (lines && text_.substr(at_).starts_with(three)) {
        // Up to two quotes before the three are part of the text.
        for (int more = 0; more < 2 && text_.substr(at_ + 1).starts_with(three); ++more) ++at_;
        at_ += 2;
        return;
      }
    }
  }

  std::string_view text_;
  size_t at_ = 0;
  size_t table_ = 0;  // depth of the table that the last header names
  size_t depth_ = 0;
  bool key_ = true;  // else a value
  bool header_ = false;  // on this line
  std::vector<Open> open_;  // brackets of values
};

}  // namespace

int lineTooDeep(std::string_view text, size_t most) { return Scan(text).lineTooDeep(most); }

}  // namespace roomlight::optimise
