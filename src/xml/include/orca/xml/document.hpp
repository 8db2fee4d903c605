// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::xml {

/// An attribute of an element, with its references resolved.
struct Attribute {
  std::string name;
  std::string value;
  Position position;        ///< The name's.
  Position value_position;  ///< The first character of the value, after the quote.
  bool intact = true;       ///< False: an error in the value is reported already; do not judge it again.
};

/// An element with everything in it. A plain value; comments are not kept.
class Element {
 public:
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Position& position() const { return position_; }  ///< The place of the '<'.

  /// Returns the attributes in document order; each name occurs once.
  [[nodiscard]] const std::vector<Attribute>& attributes() const { return attributes_; }
  [[nodiscard]] const Attribute* attribute(std::string_view name) const;

  [[nodiscard]] const std::vector<Element>& children() const { return children_; }

  /// Returns the characters directly inside the element, without those of its children.
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Returns the position of the first character of text() that is not blank; the element's own if there is
  /// none.
  [[nodiscard]] const Position& text_position() const { return text_position_; }

 private:
  friend class TreeBuilder;

  std::string name_;
  Position position_;
  std::vector<Attribute> attributes_;
  std::vector<Element> children_;
  std::string text_;
  Position text_position_;
};

struct Document {
  Element root;
};

/// The limits of what one file may hold. tinyxml2 follows this depth of nesting safely.
struct Limits {
  static constexpr std::size_t kBytes = 16 * 1024 * 1024;
  static constexpr std::size_t kNesting = 98;
  static constexpr std::size_t kAttributes = 64;  ///< In one tag.
  static constexpr std::size_t kElements = 500'000;
};

/// Returns the bytes of a file. If the file is larger than Limits::kBytes, it returns only the first ones, one
/// more than allowed.
/// @errors  as read_input_file().
[[nodiscard]] Result<std::string> read_bytes(const std::string& path);

/// Reads an XML file strictly: UTF-8 without byte order mark, one root, no DTD, only the five predefined
/// entities and character references, nothing beyond Limits.
///
/// @param diagnostics  receives every error of the text with its position (codes G1xx).
/// @return the tree, or nothing if it could not be built. A Document may come together with errors (an
/// attribute given twice, an unknown entity), so that its content can be checked as well: check
/// `diagnostics.has_errors()` before using the result.
/// @thread  no shared state; any thread.
[[nodiscard]] std::optional<Document> read_file(const std::string& path, Diagnostics& diagnostics);

/// Does the same for text in memory; `file_name` only appears in positions.
[[nodiscard]] std::optional<Document> read_text(std::string_view text, const std::string& file_name,
                                                Diagnostics& diagnostics);

/// Returns the size [bytes] of the character that `text` starts with. Returns 0 if the text starts with none
/// that may occur in an XML file: a control character, broken UTF-8, the end.
[[nodiscard]] std::size_t character_size(std::string_view text);

/// Returns `text` with the characters that have a meaning in XML written as references, for an attribute
/// value in double quotes. read_text() restores `text`, whatever blanks it holds.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace orca::xml
