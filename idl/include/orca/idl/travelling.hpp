// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstddef>
#include <string_view>
#include <type_traits>

#include "orca/idl/generated/object.h"
#include "orca/idl/generated/object.reflection.hpp"
#include "orca/idl/reflection.hpp"

namespace orca {

/// An object made of a header and a plain struct that the IDL files mark with `@travels`, e.g. idl::Pose2D. It has the
/// accessors of both, and passes for a T wherever one is asked for. Ports, loans and views of T hold it, so components
/// seldom name it: `PushServer<idl::Pose2D>`, `make_object<idl::Pose2D>()`.
///
/// Thread contract: as a plain struct.
template <class T>
class Travelling : public idl::OrcaObject, public T {
 public:
  Travelling() = default;
  /// Takes the value; the header has its defaults.
  Travelling(const T& value) : T(value) {}  // NOLINT(google-explicit-constructor)

  /// Replaces the value; the header stays as it is.
  Travelling& operator=(const T& value) {
    static_cast<T&>(*this) = value;
    return *this;
  }

  /// Compares header and value.
  bool operator==(const Travelling&) const = default;
};

/// The C++ class of the objects of type T: T itself if it has a header, otherwise T behind one.
template <class T>
using ObjectOf = std::conditional_t<std::derived_from<T, idl::OrcaObject>, T, Travelling<T>>;

/// The fields of the header, then those of the struct; the type's name is the struct's.
template <class T>
struct Reflection<Travelling<T>> {
  static constexpr std::string_view name = Reflection<T>::name;
  static constexpr std::size_t min_wire_size =
      Reflection<idl::OrcaObject>::min_wire_size + Reflection<T>::min_wire_size;
  static constexpr bool has_bulk = Reflection<T>::has_bulk;

  template <class Object, class Visitor>
  static void fields(Object& object, Visitor& visitor) {
    Reflection<idl::OrcaObject>::fields(as_base<idl::OrcaObject>(object), visitor);
    Reflection<T>::fields(as_base<T>(object), visitor);
  }
};

}  // namespace orca
