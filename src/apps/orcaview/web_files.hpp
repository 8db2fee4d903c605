// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace orca::view {

/// A file that the page needs.
struct WebFile {
  std::string type;  ///< Its media type.
  std::string text;
};

/// The files of the page: those of its folder, and parts of others from where Debian's packages have put them.
class WebFiles {
 public:
  /// @param folder  of the page: where index.html is.
  explicit WebFiles(std::string folder) : folder_(std::move(folder)) {}

  /// Returns a file; nothing if there is none of that name. Only plain names in the folder itself are found.
  /// @param target  of a request: "/", "/world_view.js", "/lib/dagre.min.js".
  [[nodiscard]] std::optional<WebFile> find(std::string_view target) const;

 private:
  std::string folder_;
};

}  // namespace orca::view
