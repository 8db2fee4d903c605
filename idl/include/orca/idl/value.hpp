// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "orca/idl/reflection.hpp"

namespace orca {

namespace idl {
class TimeValue;
}

struct Value;

/// A visitor that receives the fields of a struct, one after another.
class FieldVisitor {
 public:
  /// @param value  value of that field. It is valid while the object lives and no list around it changes its
  ///               length.
  virtual void field(const FieldInfo& info, const Value& value) = 0;

 protected:
  ~FieldVisitor() = default;
};

/// A value of an IDL enum. Its number is an index into `names`, unless the program that set it was wrong.
struct EnumValue {
  std::string_view type;                    ///< IDL name.
  std::span<const std::string_view> names;  ///< The enumerators, 0 first.
  void* place;
  std::uint32_t (*get)(const void* place);
  void (*set)(void* place, std::uint32_t number);
};

/// A value of an IDL struct. It may be a whole object.
struct StructValue {
  std::string_view type;  ///< IDL name.
  void* object;
  void (*fields)(void* object, FieldVisitor& visitor);  ///< All of them, inherited ones first.
};

/// The kind of a list's elements, which is known even if the list is empty.
enum class ElementKind {
  plain,     ///< Numbers, booleans, enumerators or instants.
  text,      ///< Texts.
  structure  ///< Structs.
};

/// A sequence, or an array of fixed length.
struct ListValue {
  ElementKind kind;
  void* list;
  std::size_t (*size)(const void* list);
  void (*resize)(void* list, std::size_t count);  ///< Null for an array.
  Value (*at)(void* list, std::size_t index);     ///< @pre  index < size(list)
};

/// A value inside an object, seen without its C++ type. It serves code that treats all types alike and is not
/// compiled for each, such as the text form. Pointers refer into the object and are never null.
///
/// Thread contract: that of the object it refers to.
struct Value {
  std::variant<bool*, std::uint8_t*, std::int32_t*, std::uint32_t*, std::int64_t*, std::uint64_t*, double*,
               std::string*, idl::TimeValue*, EnumValue, StructValue, ListValue>
      of;
};

}  // namespace orca
