// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "orca/idl/generated/object.h"
#include "orca/idl/object_type.hpp"
#include "orca/idl/travelling.hpp"

namespace orca {

namespace detail {

/// The record in front of each pooled object.
struct Slot {
  const ObjectType* type;
  void* object;
  idl::OrcaObject* header;  // of the object
  std::atomic<std::uint32_t> references{0};
  Slot* next_free = nullptr;
};

/// Acquire and release a slot. Both functions live in liborca_idl.so, so that the end of an object needs no
/// code or memory of a plugin.
[[nodiscard]] Slot* acquire_slot(const ObjectType& type) noexcept;
void release_slot(Slot* slot) noexcept;

struct LoanDeleter {
  void operator()(Slot* slot) const noexcept { release_slot(slot); }
};
using SlotOwner = std::unique_ptr<Slot, LoanDeleter>;

}  // namespace detail

/// A type that extends T, directly or not.
template <class U, class T>
concept StrictlyDerivedFrom = std::derived_from<U, T> && !std::same_as<U, T>;

/// A shared view of an immutable object of any type; or empty.
///
/// A copy of a view refers to the same object. The object returns to its pool when the last view goes. The
/// pool is never unloaded, so views may outlive the plugin that made the object.
///
/// Thread contract: like std::shared_ptr. Views may be copied and dropped in any thread, but one view belongs
/// to one thread at a time. The object is immutable and may be read by all threads.
class ObjectRef {
 public:
  ObjectRef() = default;
  ObjectRef(const ObjectRef& other) noexcept : slot_(other.slot_) {
    if (slot_ != nullptr) slot_->references.fetch_add(1, std::memory_order_relaxed);
  }
  ObjectRef(ObjectRef&& other) noexcept : slot_(std::exchange(other.slot_, nullptr)) {}
  ObjectRef& operator=(ObjectRef other) noexcept {
    std::swap(slot_, other.slot_);
    return *this;
  }
  ~ObjectRef() {
    if (slot_ != nullptr) detail::release_slot(slot_);
  }

  explicit operator bool() const { return slot_ != nullptr; }
  /// Returns whether both are views of one object, or both are empty.
  friend bool operator==(const ObjectRef&, const ObjectRef&) = default;

  /// @pre  *this, for the next five functions.
  [[nodiscard]] const ObjectType& type() const { return *slot_->type; }
  [[nodiscard]] const void* get() const { return slot_->object; }
  [[nodiscard]] const idl::OrcaObject& header() const { return *slot_->header; }
  [[nodiscard]] TimePoint stamp() const { return slot_->type->stamp(slot_->object); }
  [[nodiscard]] std::string dump() const { return slot_->type->dump(slot_->object); }

 private:
  friend class ObjectLoan;
  explicit ObjectRef(detail::Slot* slot) : slot_(slot) {}

  detail::Slot* slot_ = nullptr;
};

template <class T>
class ObjectPtr;

/// Returns the typed view of `ref`; empty if `ref` is empty or its object is neither a T nor of a type derived
/// from it.
template <class T>
[[nodiscard]] ObjectPtr<T> object_cast(ObjectRef ref);

/// An ObjectRef that knows its type: a shared view of an immutable T; or empty. The object may be of a type
/// that is derived from T, and is then whole; as() asks for it. Where T is a plain struct that travels, the view
/// shows it with its header (Travelling).
///
/// Thread contract: as ObjectRef.
template <class T>
class ObjectPtr {
 public:
  ObjectPtr() = default;
  ObjectPtr(std::nullptr_t) {}  // NOLINT(google-explicit-constructor)
  template <StrictlyDerivedFrom<T> U>
  ObjectPtr(ObjectPtr<U> other)  // NOLINT(google-explicit-constructor)
      : ref_(std::move(other).ref()) {}

  explicit operator bool() const { return static_cast<bool>(ref_); }
  friend bool operator==(const ObjectPtr&, const ObjectPtr&) = default;
  friend bool operator==(const ObjectPtr& a, std::nullptr_t) { return !a.ref_; }

  /// Returns the object, or nullptr if the view is empty.
  [[nodiscard]] const ObjectOf<T>* get() const {
    return ref_ ? static_cast<const ObjectOf<T>*>(ref_.get()) : nullptr;
  }
  /// @pre  *this
  const ObjectOf<T>& operator*() const { return *get(); }
  const ObjectOf<T>* operator->() const { return get(); }

  /// Returns the same object as a U, which derives from T; empty if the object is none.
  template <StrictlyDerivedFrom<T> U>
  [[nodiscard]] ObjectPtr<U> as() const {
    return object_cast<U>(ref_);
  }

  [[nodiscard]] const ObjectRef& ref() const& { return ref_; }
  [[nodiscard]] ObjectRef ref() && { return std::move(ref_); }
  operator ObjectRef() const { return ref_; }  // NOLINT(google-explicit-constructor)

 private:
  template <class U>
  friend ObjectPtr<U> object_cast(ObjectRef ref);
  explicit ObjectPtr(ObjectRef ref) : ref_(std::move(ref)) {}

  ObjectRef ref_;
};

template <class T>
ObjectPtr<T> object_cast(ObjectRef ref) {
  if (!ref || !is_a(ref.type(), object_type<T>())) return {};
  return ObjectPtr<T>(std::move(ref));
}

/// A pooled object of any type that is still being filled. It has one owner, who may change it. Sealing makes
/// it immutable and shareable. An object that is dropped unsealed returns to its pool.
///
/// Thread contract: one thread at a time. After a move it is empty and may only be assigned to or destroyed.
class ObjectLoan {
 public:
  [[nodiscard]] const ObjectType& type() const { return *slot_->type; }
  [[nodiscard]] void* get() { return slot_->object; }
  [[nodiscard]] const void* get() const { return slot_->object; }
  [[nodiscard]] idl::OrcaObject& header() { return *slot_->header; }
  explicit operator bool() const { return slot_ != nullptr; }

  [[nodiscard]] ObjectRef seal() && { return ObjectRef(slot_.release()); }

 private:
  friend ObjectLoan make_object(const ObjectType& type);
  explicit ObjectLoan(detail::Slot* slot) : slot_(slot) {}

  detail::SlotOwner slot_;
};

/// An ObjectLoan that knows its type. A loan of a derived type becomes one of T without losing anything.
///
/// Thread contract: as ObjectLoan.
template <class T>
class Loan {
 public:
  template <StrictlyDerivedFrom<T> U>
  Loan(Loan<U> other)  // NOLINT(google-explicit-constructor)
      : loan_(static_cast<ObjectLoan>(std::move(other))) {}

  [[nodiscard]] ObjectOf<T>* get() { return static_cast<ObjectOf<T>*>(loan_.get()); }
  [[nodiscard]] const ObjectOf<T>* get() const { return static_cast<const ObjectOf<T>*>(loan_.get()); }
  ObjectOf<T>& operator*() { return *get(); }
  const ObjectOf<T>& operator*() const { return *get(); }
  ObjectOf<T>* operator->() { return get(); }
  const ObjectOf<T>* operator->() const { return get(); }
  explicit operator bool() const { return static_cast<bool>(loan_); }

  [[nodiscard]] ObjectPtr<T> seal() && { return object_cast<T>(std::move(loan_).seal()); }
  operator ObjectPtr<T>() && { return std::move(*this).seal(); }  // NOLINT(google-explicit-constructor)
  operator ObjectLoan() && { return std::move(loan_); }           // NOLINT(google-explicit-constructor)

 private:
  template <class U>
  friend Loan<U> make_object();
  template <class U>
  friend Loan<U> copy_value(const ObjectPtr<U>& original);
  explicit Loan(ObjectLoan loan) : loan_(std::move(loan)) {}

  ObjectLoan loan_;
};

/// Returns a default object from the pool of its type. The heap is used only while the pool grows. Texts and
/// sequences keep the capacity that earlier objects in the same place gave them. If there is no memory, the
/// process ends.
/// @thread  any.
[[nodiscard]] ObjectLoan make_object(const ObjectType& type);

template <class T>
[[nodiscard]] Loan<T> make_object() {
  return Loan<T>(make_object(object_type<T>()));
}

/// Returns a pooled T with the given value. From a value that refers to an object of a derived type it takes
/// the fields of T only; copy_value() keeps them all.
template <class T>
[[nodiscard]] Loan<T> make_object(const T& value) {
  Loan<T> loan = make_object<T>();
  *loan = value;
  return loan;
}

/// Returns a copy that may be changed (thesis 8.3) and has the type of the original, which stays as it is.
/// @pre  original
[[nodiscard]] ObjectLoan copy_value(const ObjectRef& original);

template <class T>
[[nodiscard]] Loan<T> copy_value(const ObjectPtr<T>& original) {
  return Loan<T>(copy_value(original.ref()));
}

/// The number of live objects of a type, and the number that its pool has places for. The capacity never
/// shrinks.
struct PoolStatistics {
  std::size_t live = 0;
  std::size_t capacity = 0;
};

/// @thread  any; a snapshot.
[[nodiscard]] PoolStatistics pool_statistics(const ObjectType& type);

}  // namespace orca
