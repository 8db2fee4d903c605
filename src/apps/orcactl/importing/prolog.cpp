// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "prolog.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

#include "orca/xml/document.hpp"
#include "orca/xml/extras.hpp"

namespace orca::orcactl::importing {
namespace {

void blank(std::string& text, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < std::min(end, text.size()); ++i)
    if (text[i] != '\n') text[i] = ' ';
}

// The declaration names Latin-1, in any case of its letters.
bool is_latin_1(std::string_view text) {
  std::string head(text.substr(0, text.find('>')));
  std::ranges::transform(head, head.begin(), [](unsigned char c) { return std::tolower(c); });
  return head.starts_with("<?xml") && head.find("iso-8859-1") != std::string::npos;
}

std::string from_latin_1(const std::string& text) {
  std::string made;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      made += c;
    } else {
      made += static_cast<char>(0xC0 | (byte >> 6));
      made += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return made;
}

// A DOCTYPE with declarations of its own stays, and the reader refuses it.
void blank_doctype(std::string& text) {
  const std::size_t begin = text.find("<!DOCTYPE");
  const std::size_t end = text.find('>', begin == std::string::npos ? text.size() : begin);
  if (end != std::string::npos && text.find('[', begin) > end) blank(text, begin, end + 1);
}

std::string name_of(std::string_view tag) {
  return std::string(tag.substr(0, tag.find_first_of(" \t\r\n/>")));
}

// Finds lines and columns of bytes in a text, in the order of the text.
class LineCounter {
 public:
  LineCounter(const std::string& text, const std::string& file) : text_(text), position_{file, 1, 1} {}

  [[nodiscard]] const xml::Position& of(std::size_t at) {
    for (; at_ < at; ++at_)
      if (text_[at_] == '\n') {
        ++position_.line;
        position_.column = 1;
      } else if ((static_cast<unsigned char>(text_[at_]) & 0xC0) != 0x80) {
        ++position_.column;
      }
    return position_;
  }

 private:
  const std::string& text_;
  xml::Position position_;
  std::size_t at_ = 0;
};

// Comments and processing instructions are blank already. What is wrong in another way is left to the reader.
void blank_lone_end_tags(std::string& text, const std::string& file_name, xml::Diagnostics& out) {
  std::vector<std::string> open;
  LineCounter place(text, file_name);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) {
    const std::size_t end = text.find('>', at);
    if (end == std::string::npos || open.size() > xml::Limits::kNesting) return;
    const std::string tag = text.substr(at + 1, end - at - 1);
    const bool is_end = tag.starts_with('/');
    const std::string name = name_of(std::string_view(tag).substr(is_end ? 1 : 0));
    if (!is_end && !tag.ends_with('/') && !tag.starts_with('!') && !tag.starts_with('?')) {
      open.push_back(name);
    } else if (is_end && std::ranges::find(open, name) == open.end()) {
      out.warning("I003", place.of(at), "</" + name + "> closes nothing and is left out");
      blank(text, at, end + 1);
    } else if (is_end) {
      if (open.back() != name) return;
      open.pop_back();
    }
    at = end + 1;
  }
}

}  // namespace

std::string made_strict(std::string text, const std::string& file_name, xml::Diagnostics& out) {
  if (is_latin_1(text)) {
    text = from_latin_1(text);
    blank(text, 0, text.find('>') + 1);
  }
  text = xml::without_extras(std::move(text));
  blank_doctype(text);
  blank_lone_end_tags(text, file_name, out);
  return text;
}

}  // namespace orca::orcactl::importing
