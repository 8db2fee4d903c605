// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/document.hpp"

#include "codes.hpp"
#include "encoding.hpp"
#include "orca/base/input_file.hpp"
#include "scanner.hpp"
#include "tree.hpp"

namespace orca::xml {
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
  diagnostics.error(codes::kUnreadable, {path, 1, 1}, "the file cannot be read: " + bytes.error().message);
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
