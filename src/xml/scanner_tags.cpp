// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "blanks.hpp"
#include "codes.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"
#include "scanner.hpp"

namespace orca::xml {
namespace {

bool is_name_character(char c) { return is_name_start(c) || (c >= '0' && c <= '9') || c == '-' || c == '.'; }

std::string attribute_text(std::string_view name) { return "attribute \"" + shown(name) + "\""; }

}  // namespace

// Follows tinyxml2: everything beyond ASCII counts as a letter.
bool is_name_start(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' ||
         static_cast<unsigned char>(c) >= 0x80;
}

std::string_view Scanner::name() {
  const std::size_t from = cursor_.offset();
  if (is_name_start(cursor_.peek()) && !odd_blank(cursor_.rest())) cursor_.advance();
  while (is_name_character(cursor_.peek()) && cursor_.offset() > from && !odd_blank(cursor_.rest()))
    cursor_.advance();
  return cursor_.since(from);
}

void Scanner::start_tag() {
  const Mark begin = cursor_.mark();
  cursor_.advance();
  const std::string_view tag = name();
  if (tag.empty()) {
    return broken(codes::kTag, begin, "no name follows \"<\"; a \"<\" for itself is written &lt;");
  }
  if (!has_place(tag, begin)) return;
  const std::size_t index = scan_.elements.size();
  scan_.elements.push_back({begin, begin, false, {}});
  seen_.clear();
  if (attributes(tag, begin) == TagEnd::opens) {
    open_.push_back({tag, begin, index});
  } else if (open_.empty()) {
    root_closed_ = true;
  }
}

bool Scanner::has_place(std::string_view tag, Mark begin) {
  if (scan_.elements.size() == Limits::kElements) {
    stop(codes::kLimit, begin, "there are more than " + std::to_string(Limits::kElements) + " elements");
    return false;
  }
  if (open_.size() >= Limits::kNesting) {
    stop(codes::kLimit, begin,
         "<" + shown(tag) + "> is nested in " + std::to_string(open_.size()) + " elements, the limit is " +
             std::to_string(Limits::kNesting));
    return false;
  }
  if (root_closed_ && open_.empty() && !second_root_ && !end_tags_wrong_) {
    second_root_ = true;
    broken(codes::kOutsideRoot, begin,
           "<" + shown(tag) + "> is a second root element; the first one is closed already");
  }
  return true;
}

Scanner::TagEnd Scanner::attributes(std::string_view tag, Mark begin) {
  const std::string whole = "the tag <" + shown(tag) + "> from " + place(begin);
  for (;;) {
    const bool blank = skip_blanks();
    const Mark here = cursor_.mark();
    if (cursor_.at_end()) {
      stop(codes::kTruncated, here, "the file ends inside " + whole);
      return TagEnd::opens;
    }
    if (cursor_.peek() == '>' || cursor_.starts_with("/>")) return skip_rest_of_tag();
    if (!is_name_start(cursor_.peek())) {
      broken(codes::kTag, here,
             "\"" + std::string(1, cursor_.peek()) + "\" does not belong in " + whole +
                 "; an attribute, \">\" or \"/>\" is expected");
      return skip_rest_of_tag();
    }
    if (!blank) flaw(codes::kTag, here, "a blank is missing before this attribute in " + whole);
    if (const auto end = attribute()) return *end;
  }
}

Scanner::TagEnd Scanner::skip_rest_of_tag() {
  char before = '\0';
  while (!cursor_.at_end() && cursor_.peek() != '<' && cursor_.peek() != '>') {
    before = cursor_.peek();
    cursor_.advance();
  }
  if (cursor_.peek() == '>') cursor_.advance();
  return before == '/' ? TagEnd::closed : TagEnd::opens;
}

std::optional<Scanner::TagEnd> Scanner::attribute() {
  AttributeMark mark;
  mark.name = cursor_.mark();
  const std::size_t from = cursor_.offset();
  const std::string_view attribute_name = name();
  skip_blanks();
  if (cursor_.peek() != '=') {
    broken(codes::kAttribute, mark.name,
           attribute_text(attribute_name) + " has no value: write " + shown(attribute_name) + "=\"...\"");
    return std::nullopt;
  }
  cursor_.advance();
  skip_blanks();
  if (cursor_.peek() != '"' && cursor_.peek() != '\'') {
    missing_quote(attribute_name);
    return skip_rest_of_tag();
  }
  const auto end = value(attribute_name, mark);
  note_attribute(attribute_name, mark, {from, cursor_.offset() - from});
  return end;
}

void Scanner::missing_quote(std::string_view name) {
  const bool typographic = cursor_.starts_with("\xE2\x80");
  broken(codes::kAttribute, cursor_.mark(),
         "the value of " + attribute_text(name) + " must stand in quotes" +
             (typographic ? "; these are typographic ones, write \"...\"" : ", \"...\" or '...'"));
}

std::optional<Scanner::TagEnd> Scanner::value(std::string_view name, AttributeMark& mark) {
  const char quote = cursor_.peek();
  const Mark begin = cursor_.mark();
  cursor_.advance();
  mark.value = cursor_.mark();
  const std::size_t from = cursor_.offset();
  while (!cursor_.at_end() && cursor_.peek() != quote && cursor_.peek() != '<') cursor_.advance();
  const std::string_view content = cursor_.since(from);
  if (cursor_.at_end()) {
    stop(codes::kTruncated, cursor_.mark(),
         "the file ends inside the value of " + attribute_text(name) + " from " + place(begin));
    return TagEnd::opens;
  }
  if (cursor_.peek() == '<') return value_runs_on(name, begin, content);
  cursor_.advance();
  mark.intact = check_references(content, mark.value);
  return std::nullopt;
}

// A '<' in a value is nearly always the next tag after a forgotten quote: the tag of the attribute ended
// before it.
Scanner::TagEnd Scanner::value_runs_on(std::string_view name, Mark begin, std::string_view so_far) {
  broken(codes::kLessThanInValue, cursor_.mark(),
         "\"<\" in the value of " + attribute_text(name) + " from " + place(begin) +
             ": is the closing quote missing? A \"<\" for itself is written &lt;");
  return trimmed(so_far).ends_with("/>") ? TagEnd::closed : TagEnd::opens;
}

void Scanner::note_attribute(std::string_view name, AttributeMark mark, Range range) {
  auto& marks = scan_.elements.back().attributes;
  if (const auto first = std::ranges::find(seen_, name); first != seen_.end()) {
    scan_.repeated.push_back(range);
    const Mark before = marks[static_cast<std::size_t>(first - seen_.begin())].name;
    return flaw(codes::kDuplicateAttribute, mark.name,
                attribute_text(name) + " is given already at " + place(before));
  }
  if (seen_.size() == Limits::kAttributes) {
    stop(codes::kLimit, mark.name,
         "more than " + std::to_string(Limits::kAttributes) + " attributes in one tag");
  }
  seen_.push_back(name);
  marks.push_back(mark);
}

}  // namespace orca::xml
