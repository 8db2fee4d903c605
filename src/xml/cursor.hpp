// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string_view>

namespace orca::xml {

// A line and a column, both counted from 1.
struct Mark {
  int line = 1;
  int column = 1;
};

// A position that walks through a text and knows its line and column.
class Cursor {
 public:
  explicit Cursor(std::string_view text, Mark start = {}) : text_(text), mark_(start) {}

  [[nodiscard]] bool at_end() const { return offset_ >= text_.size(); }
  [[nodiscard]] char peek() const { return at_end() ? '\0' : text_[offset_]; }
  [[nodiscard]] bool starts_with(std::string_view what) const {
    return text_.substr(offset_).starts_with(what);
  }
  [[nodiscard]] std::size_t offset() const { return offset_; }
  [[nodiscard]] Mark mark() const { return mark_; }
  // Returns the text from an earlier offset up to here.
  [[nodiscard]] std::string_view since(std::size_t from) const { return text_.substr(from, offset_ - from); }
  [[nodiscard]] std::string_view rest() const { return text_.substr(offset_); }
  // Returns the distance to the next `what`, npos if there is none.
  [[nodiscard]] std::size_t distance_to(std::string_view what) const {
    const std::size_t at = text_.find(what, offset_);
    return at == std::string_view::npos ? at : at - offset_;
  }

  void advance(std::size_t bytes = 1) {
    for (; bytes > 0 && !at_end(); --bytes) step();
  }
  void advance_to_end() { advance(text_.size() - offset_); }

 private:
  void step() {
    const auto byte = static_cast<unsigned char>(text_[offset_++]);
    const bool ends_line = byte == '\n' || (byte == '\r' && peek() != '\n');  // "\r\n" ends it only once
    if (ends_line) {
      ++mark_.line;
      mark_.column = 1;
    } else if (offset_ == text_.size() || !is_continuation(text_[offset_])) {
      ++mark_.column;  // counted at the last byte of a character, so that a mark never lies inside one
    }
  }
  static bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; }

  std::string_view text_;
  std::size_t offset_ = 0;
  Mark mark_;
};

inline bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

}  // namespace orca::xml
