// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca {

/// Which plugin file holds which type, read from the NAME.types files that the build writes beside NAME.so.
///
/// A plain value.
class PluginIndex {
 public:
  /// @param folders  searched in this order; the first that knows a type wins. Missing folders are remembered
  /// for
  ///                 error texts.
  explicit PluginIndex(const std::vector<std::string>& folders) { add(folders); }

  /// More folders, searched after those there are.
  void add(const std::vector<std::string>& folders);

  /// The plugin file that holds a type.
  /// @errors  not_found, naming the places searched.
  [[nodiscard]] Result<std::string> file_of(const std::string& type) const;

  [[nodiscard]] std::vector<std::string> types() const;

 private:
  void read_folder(const std::string& folder);

  std::vector<std::string> searched_;
  std::map<std::string, std::string> file_by_type_;
};

}  // namespace orca
