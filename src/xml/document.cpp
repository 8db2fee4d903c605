// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/document.hpp"

#include <tinyxml2.h>

#include <array>
#include <cstdio>
#include <string>
#include <string_view>

#include "codes.hpp"
#include "cursor.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/input_file.hpp"
#include "scanner.hpp"

namespace orca::xml {
namespace {

using namespace std::string_view_literals;

unsigned byte_at(std::string_view text, std::size_t i) {
  return i < text.size() ? static_cast<unsigned char>(text[i]) : 0U;
}

bool is_utf16_or_32(std::string_view bytes) {
  for (const std::string_view start : {"\xFF\xFE"sv, "\xFE\xFF"sv, "\0\0\xFE\xFF"sv, "<\0"sv, "\0<"sv})
    if (bytes.starts_with(start)) return true;
  return false;
}

std::size_t sequence_length(unsigned first) {
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return 2;
  if (first >= 0xE0 && first <= 0xEF) return 3;
  if (first >= 0xF0 && first <= 0xF4) return 4;
  return 0;
}

// The second byte excludes overlong forms, surrogates and everything beyond U+10FFFF.
bool second_byte_fits(unsigned first, unsigned second) {
  switch (first) {
    case 0xE0: return second >= 0xA0 && second <= 0xBF;
    case 0xED: return second >= 0x80 && second <= 0x9F;
    case 0xF0: return second >= 0x90 && second <= 0xBF;
    case 0xF4: return second >= 0x80 && second <= 0x8F;
    default: return second >= 0x80 && second <= 0xBF;
  }
}

bool is_allowed_control(unsigned byte) { return byte == '\t' || byte == '\n' || byte == '\r'; }

std::size_t first_bad_byte(std::string_view text) {
  std::size_t i = 0;
  while (i < text.size()) {
    const std::size_t length = character_size(text.substr(i));
    if (length == 0) return i;
    i += length;
  }
  return std::string_view::npos;
}

void report_bad_byte(std::string_view text, std::size_t at, const std::string& file, Diagnostics& out) {
  Cursor cursor(text);
  cursor.advance(at);
  std::array<char, 8> hex{};
  std::snprintf(hex.data(), hex.size(), "0x%02x", byte_at(text, at));
  std::string message = "the byte " + std::string(hex.data()) + " at offset " + std::to_string(at);
  message += byte_at(text, at) < 0x80
                 ? " is no character of a text file; this is a binary file, or a damaged one"
                 : " is not UTF-8; save the file as UTF-8";
  out.error(codes::kBadByte, {file, cursor.mark().line, cursor.mark().column}, message);
}

// Returns the text that can be scanned: UTF-8 without control characters and without a byte order mark.
// Anything else is reported. If only a byte order mark is wrong, it is cut off, so that the other errors of
// the file can be reported as well.
std::optional<std::string_view> checked_text(std::string_view bytes, const std::string& file,
                                             Diagnostics& out) {
  const Position start{file, 1, 1};
  if (bytes.empty()) {
    out.error(codes::kEmpty, start, "the file is empty, an XML document is expected");
    return std::nullopt;
  }
  if (bytes.size() > Limits::kBytes) {
    out.error(codes::kTooLarge, start, "the file has more than 16 MB, which is the limit");
    return std::nullopt;
  }
  if (is_utf16_or_32(bytes)) {
    out.error(codes::kEncoding, start,
              "the file is UTF-16 or UTF-32; save it as UTF-8 without byte order mark");
    return std::nullopt;
  }
  if (bytes.starts_with("\xEF\xBB\xBF")) {
    out.error(codes::kByteOrderMark, start,
              "the file starts with a byte order mark (bytes ef bb bf); save it as UTF-8 without one");
    bytes.remove_prefix(3);
  }
  const std::size_t bad = first_bad_byte(bytes);
  if (bad == std::string_view::npos) return bytes;
  report_bad_byte(bytes, bad, file, out);
  return std::nullopt;
}

std::string without(const std::vector<Range>& ranges, std::string_view text) {
  std::string result(text);
  for (const Range& range : ranges) result.replace(range.offset, range.size, range.size, ' ');
  return result;
}

}  // namespace

class TreeBuilder {
 public:
  TreeBuilder(const Scan& scan, const std::string& file) : scan_(scan), file_(file) {}

  // Returns false as soon as tinyxml2 and the scanner saw different things.
  bool build(const tinyxml2::XMLElement& from, Element& to) {
    if (next_ == scan_.elements.size()) return false;
    const ElementMark& mark = scan_.elements[next_++];
    to.name_ = from.Name();
    to.position_ = position(mark.begin);
    to.text_position_ = position(mark.text);
    return attributes(from, mark, to) && content(from, to);
  }
  [[nodiscard]] bool complete() const { return next_ == scan_.elements.size(); }

 private:
  bool attributes(const tinyxml2::XMLElement& from, const ElementMark& mark, Element& to) {
    auto next = mark.attributes.begin();
    for (const auto* a = from.FirstAttribute(); a != nullptr; a = a->Next(), ++next) {
      if (next == mark.attributes.end()) return false;
      to.attributes_.push_back(
          {a->Name(), a->Value(), position(next->name), position(next->value), next->intact});
    }
    return next == mark.attributes.end();
  }

  bool content(const tinyxml2::XMLElement& from, Element& to) {
    for (const auto* node = from.FirstChild(); node != nullptr; node = node->NextSibling()) {
      if (const auto* text = node->ToText()) to.text_ += text->Value();
      const auto* element = node->ToElement();
      if (element != nullptr && !build(*element, to.children_.emplace_back())) return false;
    }
    return true;
  }

  [[nodiscard]] Position position(Mark mark) const { return {file_, mark.line, mark.column}; }

  const Scan& scan_;
  const std::string& file_;
  std::size_t next_ = 0;
};

namespace {

// Builds tinyxml2's tree of a text that was found readable, and adds the positions of the scan in document
// order.
std::optional<Document> build_tree(std::string_view text, const Scan& scan, const std::string& file,
                                   Diagnostics& out) {
  tinyxml2::XMLDocument tree;
  Document document;
  TreeBuilder builder(scan, file);
  const std::string unique = without(scan.repeated, text);
  tree.Parse(unique.data(), unique.size());
  const auto* root = tree.RootElement();
  const bool built =
      !tree.Error() && root != nullptr && builder.build(*root, document.root) && builder.complete();
  if (built) return document;
  const int line = tree.Error() ? tree.ErrorLineNum() : 1;
  out.error(codes::kReaderBug, {file, line, 1},
            "Orca's two readers do not agree about this file; this is a bug in Orca, please report it with "
            "the file");
  return std::nullopt;
}

}  // namespace

std::size_t character_size(std::string_view text) {
  if (text.empty()) return 0;
  const unsigned first = byte_at(text, 0);
  if ((first < 0x20 && !is_allowed_control(first)) || first == 0x7F) return 0;
  const std::size_t length = sequence_length(first);
  if (length == 1 || length == 0) return length;
  if (!second_byte_fits(first, byte_at(text, 1))) return 0;
  for (std::size_t k = 2; k < length; ++k)
    if ((byte_at(text, k) & 0xC0U) != 0x80U) return 0;
  return length;
}

Result<std::string> read_bytes(const std::string& path) { return read_input_file(path, Limits::kBytes + 1); }

const Attribute* Element::attribute(std::string_view name) const {
  for (const Attribute& attribute : attributes_)
    if (attribute.name == name) return &attribute;
  return nullptr;
}

std::optional<Document> read_text(std::string_view text, const std::string& file_name,
                                  Diagnostics& diagnostics) {
  const auto checked = checked_text(text, file_name, diagnostics);
  if (!checked) return std::nullopt;
  const Scan scan = Scanner(*checked, file_name, diagnostics).run();
  if (!scan.readable) return std::nullopt;
  return build_tree(*checked, scan, file_name, diagnostics);
}

std::optional<Document> read_file(const std::string& path, Diagnostics& diagnostics) {
  const Result<std::string> bytes = read_bytes(path);
  if (bytes) return read_text(*bytes, path, diagnostics);
  diagnostics.error(codes::kUnreadable, {path, 1, 1},
                    "the file cannot be read: " + bytes.error().message + hint_at_own_file(path));
  return std::nullopt;
}

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&': result += "&amp;"; break;
      case '<': result += "&lt;"; break;
      case '>': result += "&gt;"; break;
      case '"': result += "&quot;"; break;
      case '\n': result += "&#10;"; break;
      case '\r': result += "&#13;"; break;
      case '\t': result += "&#9;"; break;
      default: result += c;
    }
  }
  return result;
}

}  // namespace orca::xml
