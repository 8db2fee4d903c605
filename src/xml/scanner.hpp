// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "codes.hpp"
#include "cursor.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::xml {

struct AttributeMark {
  Mark name;
  Mark value;
  bool intact = true;
};

struct ElementMark {
  Mark begin;
  Mark text;  // first character that is not blank directly inside
  bool has_text = false;
  std::vector<AttributeMark> attributes;
};

struct Range {
  std::size_t offset = 0;
  std::size_t size = 0;
};

struct Scan {
  std::vector<ElementMark> elements;  // in document order
  std::vector<Range> repeated;        // attributes that tinyxml2 must not see, because it gives up at them
  bool readable = true;               // a tree can be built, although there may be errors
};

// The scanner of a text. It reads the text once, reports everything that is not well-formed and notes the
// positions, because tinyxml2 knows no columns and accepts many errors. After an error it continues where a
// person would: one slip, one error.
class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file, Diagnostics& out);
  Scan run();

 private:
  enum class TagEnd { opens, closed };
  struct Open {
    std::string_view name;
    Mark begin;
    std::size_t element;
  };

  // scanner.cpp: the text between the tags, and end tags.
  bool starts_as_xml();
  void declaration();
  void content();
  void markup();
  void text();
  void note_text(std::string_view content, Mark begin);
  void comment();
  void cdata();
  void instruction();
  void end_tag();
  void close(std::string_view name, Mark begin);
  // Returns whether the end tag of an outer element closed this one, and its own end tag comes now.
  bool take_crossed(std::string_view tag);
  void check_complete();

  // scanner_tags.cpp: start tags. Where a TagEnd comes back early, the rest of a broken tag has been skipped.
  void start_tag();
  bool has_place(std::string_view tag, Mark begin);
  TagEnd attributes(std::string_view tag, Mark begin);
  TagEnd skip_rest_of_tag();
  std::optional<TagEnd> attribute();
  void missing_quote(std::string_view name);
  std::optional<TagEnd> value(std::string_view name, AttributeMark& mark);
  TagEnd value_runs_on(std::string_view name, Mark begin, std::string_view so_far);
  void note_attribute(std::string_view name, AttributeMark mark, Range range);

  // Used by both files.
  std::string_view name();
  // Skips odd blanks as well, after a report with that code.
  bool skip_blanks(const char* code = codes::kTag);
  // Returns false if there is a bad reference.
  bool check_references(std::string_view content, Mark begin);
  void flaw(const char* code, Mark at, std::string message);    // the tree is still to be had
  void broken(const char* code, Mark at, std::string message);  // it is not
  void stop(const char* code, Mark at, std::string message);    // nothing more can be said

  Cursor cursor_;
  const std::string& file_;
  Diagnostics& out_;
  std::size_t reported_ = 0;
  Scan scan_;
  std::vector<Open> open_;
  std::map<std::string_view, std::size_t> crossed_;  // elements that the end tag of an outer one closed
  std::vector<std::string_view> seen_;               // attribute names of the present tag
  bool root_closed_ = false;
  bool second_root_ = false;
  bool end_tags_wrong_ = false;
  bool stopped_ = false;
};

// Returns a name for messages, which a name of megabytes must not fill.
std::string shown(std::string_view name);

// "line 3, column 5"
std::string place(Mark mark);

bool is_name_start(char c);

}  // namespace orca::xml
