// SPDX-License-Identifier: LGPL-3.0-or-later
#include "encoding.hpp"

#include <array>
#include <cstdint>
#include <cstdio>

#include "codes.hpp"
#include "cursor.hpp"
#include "orca/xml/document.hpp"

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

}  // namespace orca::xml
