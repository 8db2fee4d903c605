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
#include "orca/base/time.hpp"
#include "orca/idl/value.hpp"

namespace orca {

namespace idl {
class OrcaObject;
}

namespace detail {
class Pool;
class BulkLender;
class BulkSource;

/// The operations that objects with bulk data have besides. They do as those of ObjectType, but bulk data is lent where it can be.
struct BulkOperations {
  std::size_t (*write)(const void* object, std::span<std::byte> to, BulkLender& lender);
  Status (*deserialize)(std::span<const std::byte> payload, void* object, BulkSource& source);
  void (*let_go)(void* object) noexcept;  ///< Gives back all blocks of bulk data.
};

}  // namespace detail

/// The description of an object type, with which the framework makes, copies, moves and shows objects without
/// their C++ type. One constant per type lives in liborca_idl.so, so two types are the same exactly if their
/// addresses are equal. Between programs, compare type_id().
///
/// Thread contract: constant; the functions may run in any thread on different objects.
struct ObjectType {
  std::string_view name;      ///< IDL name, e.g. "SonarRangeReadings".
  std::string_view layout;    ///< Flattened layout: names, types, units and enumerators of all fields.
  std::uint64_t layout_hash;  ///< FNV-1a of `layout`.
  const ObjectType* parent;   ///< The type that this one extends; null: none but OrcaObject.
  std::size_t size;           ///< [bytes] sizeof of the C++ type.
  std::size_t align;          ///< [bytes] alignof of the C++ type.

  void (*construct)(void* place);               ///< Makes a default object in raw memory.
  void (*destroy)(void* object);                ///< Destroys the object; the memory stays.
  void (*assign)(void* to, const void* from);   ///< Copies the value; `to` keeps its capacity.
  bool (*equal)(const void* a, const void* b);  ///< Compares all fields, including the header's.
  idl::OrcaObject& (*header)(void* object);     ///< Returns the inherited part.
  /// Returns when the object's data were sensed: its field `stamp`; if it has none, the stamp of its `pose`; if that is
  /// missing or 0, its creation_time.
  TimePoint (*stamp)(const void* object);
  std::string (*dump)(const void* object);  ///< Returns a text for people: a field per line, with units.

  void (*fields)(void* object, FieldVisitor& visitor);  ///< Visits all fields, inherited ones first.

  /// Writes what serialize() appends, as far as it fits into `to`.
  /// @return the bytes that the whole object takes. If `to` has fewer, its contents are unspecified.
  std::size_t (*write)(const void* object, std::span<std::byte> to);

  /// Appends the object as XCDR1, little-endian, without encapsulation header; alignment counts from the
  /// first byte appended. Allocates only if `out` must grow. Texts end at their first zero.
  void (*serialize)(const void* object, std::vector<std::byte>& out);

  /// Reads the bytes that serialize() wrote into an existing object, whose capacity is reused. Up to 3 bytes
  /// of padding may follow.
  /// @errors  data_loss if the payload is cut short, too long, or holds an invalid value. The object is then
  ///          valid, but its fields are unspecified.
  Status (*deserialize)(std::span<const std::byte> payload, void* object);

  const detail::BulkOperations* bulk;  ///< Null: it has no bulk data.

  detail::Pool& pool;  ///< The memory of all objects of this type.
};

namespace detail {

/// Returns a type by its C++ type and the hash of its layout. liborca_idl.so defines it only for the layouts
/// that it was built with. A plugin that was built for another layout refers to a missing symbol and does not
/// load.
template <class T, std::uint64_t layout_hash>
[[nodiscard]] const ObjectType& object_type_of();

}  // namespace detail

/// Returns the description of an object type. Defined only for the types of the IDL files.
template <class T>
[[nodiscard]] const ObjectType& object_type();

/// Returns all object types, sorted by name.
[[nodiscard]] std::span<const ObjectType* const> object_types();

/// Returns the type with that IDL name, nullptr if there is none.
[[nodiscard]] const ObjectType* find_object_type(std::string_view name);

/// Returns whether an object of `type` is also one of `wanted`: the same type, or one derived from it.
[[nodiscard]] inline bool is_a(const ObjectType& type, const ObjectType& wanted) {
  const ObjectType* at = &type;
  while (at != nullptr && at != &wanted) at = at->parent;
  return at != nullptr;
}

/// Returns the type with that hash among `wanted` and the types derived from it, nullptr if there is none.
[[nodiscard]] const ObjectType* find_subtype(const ObjectType& wanted, std::uint64_t layout_hash);

/// Returns the identity that two programs compare before they exchange objects, with all ancestors.
[[nodiscard]] TypeId type_id(const ObjectType& type);

}  // namespace orca
