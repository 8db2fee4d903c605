// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/document.hpp"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "codes.hpp"
#include "encoding.hpp"
#include "scanner.hpp"
#include "tree.hpp"

namespace orca::xml {
namespace {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

}  // namespace

Result<std::string> read_bytes(const std::string& path) {
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) return fail(Code::not_found, std::strerror(errno));
  std::string bytes;
  std::array<char, 65536> buffer{};
  while (bytes.size() <= Limits::kBytes) {
    const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get());
    bytes.append(buffer.data(), count);
    if (count < buffer.size()) break;
  }
  if (std::ferror(file.get()) != 0) return fail(Code::data_loss, std::strerror(errno));
  return bytes;
}

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
