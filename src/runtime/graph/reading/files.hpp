// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>

#include "orca/graph/loader.hpp"
#include "orca/xml/document.hpp"

namespace orca::graph {

// The files that a graph includes, each read once, however often it is named.
class Files {
 public:
  struct File {
    std::string unreadable;                 // the system's reason; empty: it could be read
    std::optional<xml::Document> document;  // nothing if it is not XML, which is reported
    std::size_t elements = 0;
  };

  Files(FileReader read, xml::Diagnostics& diagnostics) : read_(std::move(read)), diagnostics_(diagnostics) {}

  // @param path  the path as positions in the file are to show it
  const File& open(const std::string& path);

 private:
  const FileReader read_;
  xml::Diagnostics& diagnostics_;
  std::map<std::string, File> files_;
};

}  // namespace orca::graph
