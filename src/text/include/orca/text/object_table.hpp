// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/idl/object.hpp"

namespace orca {

/// The columns of a table of objects in CSV (RFC 4180): stamp, port, and one for each number, text or choice in
/// the objects (docs/tables.md). Types are added and room is made first, then header() fixes the columns.
///
/// It writes no file, and does not check that an object's type was added: fields without a column are left out.
///
/// Thread contract: not synchronised.
class ObjectTable {
 public:
  /// The largest number of elements of a sequence that have a column of their own.
  static constexpr std::size_t kMostElements = 2048;

  /// @param zero  all instants are written in seconds since then.
  explicit ObjectTable(TimePoint zero) : zero_(zero) {}

  /// Adds the fields of a type, and of all types derived from it.
  void add_type(const ObjectType& type);

  /// Makes each sequence at least as wide as in this object, up to kMostElements.
  /// @pre  object
  void make_room(const ObjectRef& object);

  /// Fixes the columns and returns the line with their names.
  [[nodiscard]] std::string header();

  /// Returns the line of one object.
  /// @pre  header() was called; object
  [[nodiscard]] std::string row(std::string_view port, const ObjectRef& object);

 private:
  void add_column(const std::string& name);

  const TimePoint zero_;
  std::vector<const ObjectType*> types_;
  std::map<std::string, std::size_t> widths_;  // columns of a sequence's elements, by the sequence's name
  std::vector<std::string> columns_;
  std::unordered_map<std::string, std::size_t> column_of_;
  std::vector<std::string> cells_;  // of the row that is being written
};

/// One value of an object, as text.
struct FieldText {
  std::string name;  ///< "x", "coordinate.point.x", "ranges[3]".
  std::string text;
};

/// Returns the values of a field of an object: one, or all that a struct or a list of this name holds, in their order.
/// @param field  named as the columns of a table are.
/// @return nothing if the type has no such field.
/// @pre  object is of the type.
/// @thread  any.
[[nodiscard]] std::optional<std::vector<FieldText>> field_texts(const ObjectType& type, const void* object,
                                                                std::string_view field);
/// Returns the names of all fields that an object has now, those of lists and their elements included.
[[nodiscard]] std::vector<std::string> field_names(const ObjectType& type, const void* object);
/// Returns the words that a field of an object can be: the enumerators of an enumeration, or true and false.
/// @return nothing for other fields, and if the object has no such field now.
[[nodiscard]] std::vector<std::string> field_words(const ObjectType& type, const void* object,
                                                   std::string_view field);

}  // namespace orca
