// SPDX-License-Identifier: LGPL-3.0-or-later
#include "files.hpp"

namespace orca::graph {
namespace {

std::size_t count(const xml::Element& element) {
  std::size_t sum = 1;
  for (const xml::Element& child : element.children()) sum += count(child);
  return sum;
}

}  // namespace

const Files::File& Files::open(const std::string& path) {
  const auto [found, fresh] = files_.try_emplace(path);
  File& file = found->second;
  if (!fresh) return file;
  const Result<std::string> bytes = read_(path);
  if (!bytes) {
    file.unreadable = bytes.error().message;
    return file;
  }
  file.document = xml::read_text(*bytes, path, diagnostics_);
  if (file.document) file.elements = count(file.document->root);
  return file;
}

}  // namespace orca::graph
