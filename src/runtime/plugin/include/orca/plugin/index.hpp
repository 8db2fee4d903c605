// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"

namespace orca::plugin {

/// An index of the plugin files by type. It is read from the NAME.types files that the build writes beside
/// NAME.so, with lines of "component TYPE SENTENCE", "hardware TYPE SENTENCE" or, for a library of object types, "object TYPE
/// SENTENCE"; the sentence may be missing.
///
/// A plain value.
class PluginIndex {
 public:
  /// @param folders  searched in this order; the first that knows a type wins. Missing folders are remembered
  ///                 for error texts.
  explicit PluginIndex(const std::vector<std::string>& folders) { add(folders); }

  /// Adds folders that are searched after the present ones.
  void add(const std::vector<std::string>& folders);

  /// Reads all folders again, since plugins may have come, gone or got other types.
  void refresh();

  /// Returns the plugin file that holds a type.
  /// @errors  not_found, naming the places searched; already_exists if two plugins of one folder hold it.
  [[nodiscard]] Result<std::string> file_of(const std::string& type) const;

  /// Returns what a type is, a sentence of its author; empty if he says nothing or the type is not known.
  [[nodiscard]] std::string text_of(const std::string& type) const;

  /// Returns the folders, in the order in which they are searched.
  [[nodiscard]] const std::vector<std::string>& folders() const { return folders_; }

  /// Returns the names of all types of one kind, sorted.
  [[nodiscard]] std::vector<std::string> types(PluginKind kind) const;

  /// Returns the files of the libraries of object types, in the order of the folders.
  [[nodiscard]] const std::vector<std::string>& object_libraries() const { return object_libraries_; }

  /// An object type in a library.
  struct ObjectPlace {
    std::string library;
    std::string text;  ///< A sentence of its author on what it is; may be empty.
  };

  /// Returns the object types of these libraries by name; where two libraries list one, in the first.
  [[nodiscard]] const std::map<std::string, ObjectPlace>& object_types() const { return object_types_; }

 private:
  struct Place {
    PluginKind kind;
    std::string file;
    std::string rival;  // another plugin of the same folder with the same type; empty: none
    std::string text;
  };
  void read_folder(const std::string& folder);
  void add_type(const std::string& type, const Place& place);
  void add_object_type(const std::string& type, const ObjectPlace& place);

  std::vector<std::string> folders_;
  std::vector<std::string> searched_;  // the same for error texts
  std::map<std::string, Place> place_by_type_;
  std::vector<std::string> object_libraries_;
  std::map<std::string, ObjectPlace> object_types_;
};

}  // namespace orca::plugin
