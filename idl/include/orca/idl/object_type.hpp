// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/idl/value.hpp"

namespace orca {

namespace idl {
class OrcaObject;
}

namespace detail {
class Pool;
}

/// All that the framework must know of an object type to make, copy, move and show objects without knowing
/// their C++ type. One constant per type lives in liborca_idl.so, so two types are the same exactly if their
/// addresses are; between programs, compare type_id().
///
/// Thread contract: constant; the functions may run in any thread on different objects.
struct ObjectType {
  std::string_view name;      ///< IDL name, e.g. "SonarRangeReadings".
  std::string_view layout;    ///< Flattened layout: names, types, units and enumerators of all fields.
  std::uint64_t layout_hash;  ///< FNV-1a of `layout`.
  std::size_t size;           ///< [bytes] sizeof of the C++ type.
  std::size_t align;          ///< [bytes] alignof of the C++ type.

  void (*construct)(void* place);               ///< Makes a default object in raw memory.
  void (*destroy)(void* object);                ///< Ends its life; the memory stays.
  void (*assign)(void* to, const void* from);   ///< Copies the value; `to` keeps its capacity.
  bool (*equal)(const void* a, const void* b);  ///< All fields are equal, the header's too.
  idl::OrcaObject& (*header)(void* object);     ///< The inherited part.
  std::string (*dump)(const void* object);      ///< For people: one field per line, with units.

  void (*fields)(void* object, FieldVisitor& visitor);  ///< Shows all fields, inherited ones first.

  /// Appends the object as XCDR1, little-endian, without encapsulation header; alignment counts from the
  /// first byte appended. Allocates only if `out` must grow. Texts end at their first zero.
  void (*serialize)(const void* object, std::vector<std::byte>& out);

  /// Reads what serialize() wrote into an existing object, whose capacity is reused. Up to 3 bytes of padding
  /// may follow.
  /// @errors  data_loss if the payload is cut short, too long, or holds a value that cannot be; the object
  /// then
  ///          is valid, but its fields are unspecified.
  Status (*deserialize)(std::span<const std::byte> payload, void* object);

  detail::Pool& pool;  ///< Where objects of this type live.
};

/// The description of an IDL object type. Defined in liborca_idl.so for the types of the IDL files only.
template <class T>
[[nodiscard]] const ObjectType& object_type();

/// All object types, sorted by name.
[[nodiscard]] std::span<const ObjectType* const> object_types();

/// @return the type of that IDL name, nullptr if there is none.
[[nodiscard]] const ObjectType* find_object_type(std::string_view name);

/// What two programs compare before they exchange objects.
[[nodiscard]] TypeId type_id(const ObjectType& type);

}  // namespace orca
