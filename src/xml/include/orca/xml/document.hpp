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

/// An attribute of an element, references resolved.
struct Attribute {
  std::string name;
  std::string value;
  Position position;        ///< Of the name.
  Position value_position;  ///< Of the first character of the value, after the quote.
  bool intact = true;       ///< False: an error in the value is reported already; do not judge it again.
};

/// One element with everything in it. A plain value; comments are not kept.
class Element {
 public:
  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const Position& position() const { return position_; }  ///< Of the '<'.

  /// In document order, each name once.
  [[nodiscard]] const std::vector<Attribute>& attributes() const { return attributes_; }
  [[nodiscard]] const Attribute* attribute(std::string_view name) const;

  [[nodiscard]] const std::vector<Element>& children() const { return children_; }

  /// The characters directly inside the element, without those of its children.
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Of the first character of text() that is not blank; the element's own if there is none.
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

/// What one file may hold. The nesting is what tinyxml2 follows safely.
struct Limits {
  static constexpr std::size_t kBytes = 16 * 1024 * 1024;
  static constexpr std::size_t kNesting = 98;
  static constexpr std::size_t kAttributes = 64;  ///< In one tag.
  static constexpr std::size_t kElements = 500'000;
};

/// The bytes of a file; of one beyond Limits::kBytes only the first, and at least one too many.
/// @errors  not_found or data_loss, the message is the system's word for what is wrong.
[[nodiscard]] Result<std::string> read_bytes(const std::string& path);

/// Reads an XML file strictly: UTF-8 without byte order mark, one root, no DTD, only the five predefined
/// entities and character references, nothing beyond Limits.
///
/// @param diagnostics  receives every error of the text with its position (codes G1xx).
/// @return the tree, or nothing if it could not be made out. A Document may come together with errors (an
///         attribute given twice, an unknown entity), so that the checks of its content can run as well: ask
///         `diagnostics.has_errors()` before using what was read.
/// @thread  no shared state; any thread.
[[nodiscard]] std::optional<Document> read_file(const std::string& path, Diagnostics& diagnostics);

/// The same for text in memory; `file_name` only appears in positions.
[[nodiscard]] std::optional<Document> read_text(std::string_view text, const std::string& file_name,
                                                Diagnostics& diagnostics);

/// The bytes of the character that `text` starts with; 0 if it starts with none that may stand in an XML
/// file: a control character, broken UTF-8, the end.
[[nodiscard]] std::size_t character_size(std::string_view text);

/// `text` with the characters that mean something in XML written as references, for an attribute value in
/// double quotes. read_text() gives `text` back, whatever blanks it holds.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace orca::xml
