// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <span>
#include <vector>

#include "orca/idl/bulk.hpp"
#include "orca/idl/cdr_reader.hpp"
#include "orca/idl/cdr_writer.hpp"
#include "orca/idl/dump_writer.hpp"
#include "orca/idl/generated/object.h"
#include "orca/idl/make_value.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/time.hpp"

namespace orca::detail {

/// Appends what `write` writes of the object.
void append_written(std::size_t (*write)(const void* object, std::span<std::byte> to), const void* object,
                    std::vector<std::byte>& out);

/// The operations of a reflected type T, with its type erased.
template <class T>
struct Operations {
  static const T& as(const void* object) { return *static_cast<const T*>(object); }
  static T& as(void* object) { return *static_cast<T*>(object); }

  static void construct(void* place) { new (place) T(); }
  static void destroy(void* object) { std::destroy_at(&as(object)); }
  static void assign(void* to, const void* from) { as(to) = as(from); }
  static bool equal(const void* a, const void* b) { return as(a) == as(b); }
  static idl::OrcaObject& header(void* object) { return as(object); }

  static TimePoint stamp(const void* object) {
    const T& known = as(object);
    if constexpr (requires { to_time_point(known.stamp()); }) return to_time_point(known.stamp());
    if constexpr (requires { to_time_point(known.pose().stamp()); })
      if (known.pose().stamp().ns() != 0) return to_time_point(known.pose().stamp());
    return to_time_point(known.creation_time());
  }
  static std::string dump(const void* object) {
    DumpWriter writer(Reflection<T>::name);
    Reflection<T>::fields(as(object), writer);
    return std::move(writer).take();
  }
  static std::size_t write(const void* object, std::span<std::byte> to) {
    CdrWriter writer(to);
    Reflection<T>::fields(as(object), writer);
    return writer.size();
  }
  static void serialize(const void* object, std::vector<std::byte>& out) {
    append_written(write, object, out);
  }
  static Status deserialize(std::span<const std::byte> payload, void* object) {
    CdrReader reader(payload);
    Reflection<T>::fields(as(object), reader);
    return reader.status(Reflection<T>::name);
  }
};

/// A visitor that gives back all blocks of bulk data.
struct BulkRelease {
  template <class T>
  void field(const FieldInfo&, T& value) {
    let_go(value);
  }
  template <class T>
  void let_go(Bulk<T>& values) {
    values.let_go();
  }
  template <class T>
  void let_go(T& value) {
    if constexpr (ReflectedStruct<T>) {
      if constexpr (Reflection<T>::has_bulk) Reflection<T>::fields(value, *this);
    } else if constexpr (requires { typename T::value_type; }) {
      if constexpr (ReflectedStruct<typename T::value_type>)
        for (auto& element : value) let_go(element);
    }
  }
};

template <class T>
struct OperationsOnBulk {
  static std::size_t write(const void* object, std::span<std::byte> to, BulkLender& lender) {
    CdrWriter writer(to, lender);
    Reflection<T>::fields(*static_cast<const T*>(object), writer);
    return writer.size();
  }
  static Status deserialize(std::span<const std::byte> payload, void* object, BulkSource& source) {
    CdrReader reader(payload, source);
    Reflection<T>::fields(*static_cast<T*>(object), reader);
    return reader.status(Reflection<T>::name);
  }
  static void let_go(void* object) noexcept {
    BulkRelease release;
    Reflection<T>::fields(*static_cast<T*>(object), release);
  }
  static constexpr BulkOperations all{write, deserialize, let_go};
};

template <class T>
constexpr const BulkOperations* bulk_operations() {
  if constexpr (Reflection<T>::has_bulk) return &OperationsOnBulk<T>::all;
  return nullptr;
}

template <class T>
constexpr ObjectType make_object_type(std::string_view layout, std::uint64_t layout_hash,
                                      const ObjectType* parent, Pool& pool) {
  using Do = Operations<T>;
  return {.name = Reflection<T>::name,
          .layout = layout,
          .layout_hash = layout_hash,
          .parent = parent,
          .size = sizeof(T),
          .align = alignof(T),
          .construct = Do::construct,
          .destroy = Do::destroy,
          .assign = Do::assign,
          .equal = Do::equal,
          .header = Do::header,
          .stamp = Do::stamp,
          .dump = Do::dump,
          .fields = visit_fields<T>,
          .write = Do::write,
          .serialize = Do::serialize,
          .deserialize = Do::deserialize,
          .bulk = bulk_operations<T>(),
          .pool = pool};
}

}  // namespace orca::detail
