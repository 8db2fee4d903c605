// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scanner.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "blanks.hpp"
#include "codes.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"

namespace orca::xml {
namespace {

// A '&' that does not start one of the references that XML has without a DTD.
struct BadReference {
  std::size_t offset;  // of the '&' in the text
  const char* code;
  std::string message;
};

constexpr std::array<std::string_view, 5> kPredefined{"amp", "lt", "gt", "apos", "quot"};

// Long enough for every legal reference; in anything longer, the '&' stands for itself.
constexpr std::size_t kLongest = 40;

bool is_xml_character(std::uint32_t c) {
  if (c < 0x20) return c == '\t' || c == '\n' || c == '\r';
  if (c >= 0xD800 && c <= 0xDFFF) return false;
  return c <= 0x10FFFF && c != 0xFFFE && c != 0xFFFF;
}

// Takes in `digits` the text between "&#" and ';'.
bool is_character_number(std::string_view digits) {
  const bool hex = digits.starts_with('x');
  if (hex) digits.remove_prefix(1);
  std::uint32_t value = 0;
  const char* end = digits.data() + digits.size();
  const auto [stop, problem] = std::from_chars(digits.data(), end, value, hex ? 16 : 10);
  return problem == std::errc{} && stop == end && is_xml_character(value);
}

bool is_name(std::string_view text) {
  const auto fits = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; };
  return !text.empty() && std::ranges::all_of(text, fits);
}

std::optional<BadReference> judge(std::string_view after_ampersand, std::size_t offset) {
  const std::size_t end = after_ampersand.substr(0, kLongest).find(';');
  const std::string_view name = after_ampersand.substr(0, end == std::string_view::npos ? 0 : end);
  if (name.starts_with('#')) {
    if (is_character_number(name.substr(1))) return std::nullopt;
    return BadReference{offset, codes::kCharacterReference,
                        "the character reference &" + std::string(name) + "; names no character of XML"};
  }
  if (!is_name(name)) return BadReference{offset, codes::kEntity, "a '&' for itself is written &amp;"};
  if (std::ranges::find(kPredefined, name) != kPredefined.end()) return std::nullopt;
  return BadReference{offset, codes::kEntity,
                      "the entity &" + std::string(name) +
                          "; is not defined; there are &amp; &lt; &gt; &apos; &quot; and &#number;"};
}

// Returns the first bad reference at or after `from`.
std::optional<BadReference> find_bad_reference(std::string_view text, std::size_t from) {
  for (std::size_t at = text.find('&', from); at != std::string_view::npos; at = text.find('&', at + 1)) {
    if (auto bad = judge(text.substr(at + 1), at)) return bad;
  }
  return std::nullopt;
}

// With more errors than this, a file is not XML with slips but something else.
constexpr std::size_t kMaxErrors = 1000;

// Returns the value of `name="value"` in an XML declaration, empty if there is none.
std::string declared(std::string_view declaration, std::string_view name) {
  std::size_t at = declaration.find(name);
  if (at == std::string_view::npos) return {};
  at = declaration.find_first_of("\"'", at);
  if (at == std::string_view::npos) return {};
  const std::size_t end = declaration.find(declaration[at], at + 1);
  if (end == std::string_view::npos) return {};
  std::string value(declaration.substr(at + 1, end - at - 1));
  std::ranges::transform(value, value.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return value;
}

bool is_utf8(const std::string& encoding) {
  return encoding.empty() || encoding == "utf-8" || encoding == "us-ascii" || encoding == "ascii";
}

// Returns the size of what leads editors to schemas, at the start of the text. tinyxml2 takes it for another declaration, which it
// reads only behind the first.
std::size_t size_of_schema_lines(std::string_view text) {
  for (std::size_t size = 0;;) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n", size);
    if (begin == std::string_view::npos || !text.substr(begin).starts_with("<?xml-model ")) return size;
    const std::size_t end = text.find("?>", begin);
    if (end == std::string_view::npos || text.find('<', begin + 1) < end)
      return size;  // instruction() reports it
    size = end + 2;
  }
}

}  // namespace

std::string shown(std::string_view name) {
  constexpr std::size_t kMost = 200;
  return shortened(name, kMost);
}

std::string place(Mark mark) {
  return "line " + std::to_string(mark.line) + ", column " + std::to_string(mark.column);
}

Scanner::Scanner(std::string_view text, const std::string& file, Diagnostics& out)
    : cursor_(text), file_(file), out_(out) {}

Scan Scanner::run() {
  if (starts_as_xml()) {
    declaration();
    while (!cursor_.at_end()) content();
    check_complete();
  }
  return std::move(scan_);
}

void Scanner::flaw(const char* code, Mark at, std::string message) {
  if (stopped_) return;
  out_.error(code, {file_, at.line, at.column}, std::move(message));
  if (++reported_ < kMaxErrors) return;
  scan_.readable = false;
  stopped_ = true;
  cursor_.advance_to_end();
}

void Scanner::broken(const char* code, Mark at, std::string message) {
  scan_.readable = false;
  flaw(code, at, std::move(message));
}

void Scanner::stop(const char* code, Mark at, std::string message) {
  broken(code, at, std::move(message));
  stopped_ = true;
  cursor_.advance_to_end();
}

bool Scanner::skip_blanks(const char* code) {
  const std::size_t from = cursor_.offset();
  bool reported = false;
  for (;;) {
    const auto odd = odd_blank(cursor_.rest());
    if (!odd && !is_blank(cursor_.peek())) return cursor_.offset() > from;
    if (odd && !std::exchange(reported, true))
      broken(code, cursor_.mark(), odd->name + " stands here, which separates nothing in XML; write a blank");
    cursor_.advance(odd ? odd->size : 1);
  }
}

bool Scanner::check_references(std::string_view content, Mark begin) {
  Cursor cursor(content, begin);
  std::size_t from = 0;
  while (const auto bad = find_bad_reference(content, from)) {
    cursor.advance(bad->offset - cursor.offset());
    // tinyxml2 leaves an unknown entity unchanged, but converts an impossible number.
    const bool number = bad->code == std::string_view(codes::kCharacterReference);
    if (number) scan_.readable = false;
    flaw(bad->code, cursor.mark(), bad->message);
    from = bad->offset + 1;
    if (stopped_) break;
  }
  return from == 0;
}

bool Scanner::starts_as_xml() {
  if (cursor_.starts_with("<?xml")) return true;
  skip_blanks(codes::kOutsideRoot);
  if (cursor_.at_end()) {
    stop(codes::kEmpty, cursor_.mark(), "the file holds nothing but blanks, an XML document is expected");
    return false;
  }
  if (cursor_.peek() == '<') return true;
  const std::string found{cursor_.peek()};
  const bool ascii = static_cast<unsigned char>(found[0]) < 0x80;
  stop(codes::kNotXml, cursor_.mark(),
       "this is not XML: it starts with " + (ascii ? in_quotes(found) : "another character") +
           " instead of \"<\"");
  return false;
}

void Scanner::declaration() {
  if (cursor_.offset() > 0 || !cursor_.starts_with("<?xml")) return;
  if (cursor_.starts_with("<?xml-")) return cursor_.advance(size_of_schema_lines(cursor_.rest()));
  const Mark begin = cursor_.mark();
  const std::size_t length = cursor_.distance_to("?>");
  if (length == std::string_view::npos) {
    return stop(codes::kInstruction, begin, "the XML declaration is not closed with \"?>\"");
  }
  const std::size_t from = cursor_.offset();
  cursor_.advance(length + 2);
  const std::string version = declared(cursor_.since(from), "version");
  if (version != "1.0")
    flaw(codes::kXmlVersion, begin,
         (version.empty() ? "the XML declaration has no version"
                          : "the file declares version " + in_quotes(version) + " of XML") +
             "; only 1.0 is read: write version=\"1.0\"");
  const std::string encoding = declared(cursor_.since(from), "encoding");
  if (!is_utf8(encoding)) {
    stop(codes::kEncoding, begin,
         "the file declares the encoding " + in_quotes(encoding) + ", only UTF-8 is read; save it as UTF-8");
  }
  cursor_.advance(size_of_schema_lines(cursor_.rest()));
}

void Scanner::content() {
  if (cursor_.peek() == '<') return markup();
  text();
}

void Scanner::markup() {
  if (cursor_.starts_with("<!--")) return comment();
  if (cursor_.starts_with("<![CDATA[")) return cdata();
  if (cursor_.starts_with("<!")) {
    return stop(codes::kDoctype, cursor_.mark(),
                "\"<!\" starts a DOCTYPE or another declaration, which is not read; remove it");
  }
  if (cursor_.starts_with("<?")) return instruction();
  if (cursor_.starts_with("</")) return end_tag();
  start_tag();
}

void Scanner::text() {
  const Mark begin = cursor_.mark();
  const std::size_t from = cursor_.offset();
  while (!cursor_.at_end() && cursor_.peek() != '<') cursor_.advance();
  const std::string_view content = cursor_.since(from);
  check_references(content, begin);
  note_text(content, begin);
}

void Scanner::note_text(std::string_view content, Mark begin) {
  Cursor cursor(content, begin);
  while (is_blank(cursor.peek())) cursor.advance();
  if (cursor.at_end()) return;
  if (open_.empty()) {
    const auto odd = odd_blank(cursor.rest());
    return broken(codes::kOutsideRoot, cursor.mark(),
                  "there is " + (odd ? odd->name : "text") + " outside the root element");
  }
  ElementMark& element = scan_.elements[open_.back().element];
  if (!element.has_text) element.text = cursor.mark();
  element.has_text = true;
}

void Scanner::comment() {
  const Mark begin = cursor_.mark();
  cursor_.advance(4);
  const std::size_t length = cursor_.distance_to("-->");
  if (length == std::string_view::npos)
    return stop(codes::kComment, begin, "the comment is not closed with \"-->\"");
  const std::size_t dashes = cursor_.distance_to("--");
  if (dashes < length) {
    cursor_.advance(dashes);
    flaw(codes::kComment, cursor_.mark(),
         "\"--\" may not stand inside the comment that starts at " + place(begin));
  }
  cursor_.advance(cursor_.distance_to("-->") + 3);
}

void Scanner::cdata() {
  const Mark begin = cursor_.mark();
  cursor_.advance(9);
  const std::size_t length = cursor_.distance_to("]]>");
  if (length == std::string_view::npos) {
    return stop(codes::kComment, begin, "the CDATA section is not closed with \"]]>\"");
  }
  const Mark inside = cursor_.mark();
  const std::size_t from = cursor_.offset();
  cursor_.advance(length);
  note_text(cursor_.since(from), inside);
  cursor_.advance(3);
}

void Scanner::instruction() {
  const Mark begin = cursor_.mark();
  const bool declaration = cursor_.starts_with("<?xml ");
  broken(codes::kInstruction, begin,
         declaration ? "the XML declaration may only stand at the very start of the file"
                     : "processing instructions (\"<?...?>\") are not read; remove it");
  const std::size_t length = cursor_.distance_to("?>");
  if (length == std::string_view::npos) return cursor_.advance_to_end();
  cursor_.advance(length + 2);
}

void Scanner::end_tag() {
  const Mark begin = cursor_.mark();
  cursor_.advance(2);
  const std::string_view tag = name();
  skip_blanks();
  if (cursor_.at_end() && !open_.empty()) return;  // check_complete() names what is open
  if (cursor_.peek() == '>') {
    cursor_.advance();
  } else if (!cursor_.at_end()) {
    broken(codes::kTag, cursor_.mark(), "the end tag </" + shown(tag) + "> is not closed with \">\"");
    skip_rest_of_tag();
  }
  close(tag, begin);
}

void Scanner::close(std::string_view tag, Mark begin) {
  const std::string end = "the end tag </" + shown(tag) + ">";
  if (open_.empty()) {
    if (!end_tags_wrong_) broken(codes::kEndTag, begin, end + " closes nothing: no element is open");
    end_tags_wrong_ = true;
    return;
  }
  const Open innermost = open_.back();
  const auto same = [&](const Open& open) { return open.name == tag; };
  const auto match = std::find_if(open_.rbegin(), open_.rend(), same);
  if (innermost.name != tag) {
    // A late end tag that was missing before: "<a><b></a></b>" is one error.
    if (match == open_.rend() && take_crossed(tag)) return;
    broken(codes::kEndTag, begin,
           end + " does not fit: <" + shown(innermost.name) + "> from " + place(innermost.begin) +
               " is open and needs </" + shown(innermost.name) + "> first");
    end_tags_wrong_ = true;
  }
  // An end tag that fits nothing is treated as a misspelt one. If it was one too many, the right one follows.
  const bool misspelt = match == open_.rend();
  const auto closed = misspelt ? open_.end() - 1 : match.base() - 1;
  for (auto crossed = misspelt ? closed : closed + 1; crossed != open_.end(); ++crossed)
    ++crossed_[crossed->name];
  open_.erase(closed, open_.end());
  root_closed_ = open_.empty();
}

bool Scanner::take_crossed(std::string_view tag) {
  const auto crossed = crossed_.find(tag);
  if (crossed == crossed_.end()) return false;
  if (--crossed->second == 0) crossed_.erase(crossed);
  return true;
}

void Scanner::check_complete() {
  if (stopped_) return;
  if (scan_.elements.empty()) {
    return broken(codes::kNoRoot, cursor_.mark(),
                  "there is no element in the file, a root element is expected");
  }
  if (open_.empty() || end_tags_wrong_) return;
  std::string message = "the file ends here, but <" + shown(open_.back().name) + "> from " +
                        place(open_.back().begin) + " is not closed";
  if (open_.size() > 1) message += ", nor the " + std::to_string(open_.size() - 1) + " around it";
  broken(codes::kTruncated, cursor_.mark(), message);
}

}  // namespace orca::xml
