// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <type_traits>

namespace orca {

/// The description of a field in its IDL file. Both texts live as long as the program.
struct FieldInfo {
  std::string_view name;
  /// SI unit: "m", "rad/s", ...; "1" for a plain number, empty for a value that is not a number.
  std::string_view unit;
  bool header = false;  ///< A field of OrcaObject itself, set by the framework.
};

/// The fields of an IDL struct, for code that must treat all types alike: CDR, dump, XML.
///
/// Specialised for each struct by idl/tools/generate.py:
///   name           IDL name
///   min_wire_size  [bytes] the fewest that a value takes in XCDR1, without padding
///   has_bulk       whether it has fields of bulk data, its own or those of its parts
///   fields(object, visitor)  calls visitor.field(FieldInfo, value) for each field, inherited ones first. The
///                  value is a reference, or a copy of a number of a const object; writers take `const T&`,
///                  readers `T&`.
template <class T>
struct Reflection;

/// The enumerators of an IDL enum, 0 first: name, names. Specialised for each enum by idl/tools/generate.py.
template <class T>
struct EnumReflection;

template <class T>
concept ReflectedStruct = requires {
  Reflection<std::remove_const_t<T>>::min_wire_size;
};

template <class T>
concept ReflectedEnum = requires {
  EnumReflection<T>::names;
};

/// Returns the part of an object that it inherits from Base; const if the object is const.
template <class Base, class Object>
[[nodiscard]] auto& as_base(Object& object) {
  return static_cast<std::conditional_t<std::is_const_v<Object>, const Base&, Base&>>(object);
}

}  // namespace orca
