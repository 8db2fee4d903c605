// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/component/parts_of.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/object_type.hpp"

namespace orca {

/// Says who has written a state: the type of the component, and the version that its state had there.
struct StateTag {
  std::string type;           ///< "orca.Goto"
  std::uint32_t version = 1;  ///< Component::state_version() of the object that wrote it.

  /// Returns the tag for people: "orca.Goto/1".
  [[nodiscard]] std::string text() const { return type + "/" + std::to_string(version); }
  friend bool operator==(const StateTag&, const StateTag&) = default;
};

namespace detail {

/// The kinds of value in a state. Each value is marked with its kind, so that a reader which expects something else
/// notices.
enum class StateKind : std::uint8_t { boolean = 1, integer, real, text, count, object };

template <class T>
concept TimeSpan = std::same_as<T, std::chrono::duration<typename T::rep, typename T::period>>;
template <class T>
concept Instant = requires(const T& value) {
  value.time_since_epoch();
};
/// An ObjectPtr.
template <class T>
concept SharedObject = std::same_as<std::remove_cvref_t<decltype(std::declval<T&>().ref())>, ObjectRef>;
template <class T>
concept Optional = std::same_as<T, std::optional<typename T::value_type>>;
template <class T>
concept Sequence = requires(T& value) {
  value.begin(), value.end(), value.size();
};
template <class T>
concept Growing = Sequence<T> && requires(T& value) {
  value.clear(), value.insert(value.end(), *value.begin());
};
/// A class that names its members itself: auto state() { return std::tie(a, b); }
template <class T>
concept NamesItsState = requires(T& value) {
  value.state();
};

// The type of an element as it can be made alone: a map's elements have constant keys. Only declared.
template <class T>
T made_alone(const T*);
template <class Key, class Value>
std::pair<Key, Value> made_alone(const std::pair<const Key, Value>*);

/// Returns references to the parts of a value that consists of parts.
template <class T>
auto parts_of_state(T& value) {
  if constexpr (NamesItsState<T>) {
    return value.state();
  } else {
    return parts_of(value);
  }
}

}  // namespace detail

/// The writer of the state that a component gives its successor: values one after the other, each with its kind.
///
/// A value is a bool, a number, an enumerator, a text, a time, an object of the IDL or an ObjectPtr, which keeps its type and
/// its header; a std::optional, std::pair, array, or
/// container of such values; a plain struct of up to eight of them; or of a class with a function
/// `auto state() { return std::tie(member, ...); }`.
///
/// Thread contract: not synchronised.
class StateWriter {
 public:
  /// Appends values, in this order.
  template <class... T>
  void write(const T&... values) {
    (put(values), ...);
  }
  [[nodiscard]] const std::vector<std::byte>& bytes() const { return bytes_; }

 private:
  template <class T>
  void put(const T& value);
  void put_boolean(bool value);
  void put_integer(std::int64_t value);
  void put_real(double value);
  void put_text(std::string_view value);
  void put_count(std::size_t value);
  void put_object(const ObjectType& type, const void* object);
  void put_shared(const ObjectRef& object);
  void put_bits(detail::StateKind kind, std::uint64_t bits);

  std::vector<std::byte> bytes_;
};

/// The reader of the state that a component gets from its predecessor.
///
/// Thread contract: not synchronised.
class StateReader {
 public:
  /// @param bytes  outlive the reader.
  StateReader(StateTag tag, std::span<const std::byte> bytes) : tag_(std::move(tag)), rest_(bytes) {}

  /// Returns who wrote the state.
  [[nodiscard]] const StateTag& tag() const { return tag_; }

  /// Takes values, in the order in which they were written. They all change, or none does.
  /// @errors  data_loss with the number of the value that is missing or of another kind.
  template <class... T>
  Status read(T&... values) {
    std::tuple<T...> taken{values...};
    std::apply([this](auto&... value) { (get(value), ...); }, taken);
    if (!error_) std::tie(values...) = taken;  // copied, so that containers keep the memory that they have
    return status();
  }

  /// Returns whether all reads succeeded.
  [[nodiscard]] Status status() const { return error_ ? Status(*error_) : ok(); }
  /// Returns whether all has been read.
  /// @errors  those of read(); data_loss if values are left.
  [[nodiscard]] Status finish() const;

 private:
  template <class T>
  void get(T& value);
  template <class T>
  void get_integer(T& value);
  template <class T>
  void get_pointer(ObjectPtr<T>& value);
  template <class T>
  void get_elements(T& value);
  [[nodiscard]] bool get_boolean();
  [[nodiscard]] std::int64_t get_integer();
  [[nodiscard]] double get_real();
  [[nodiscard]] std::string get_text();
  [[nodiscard]] std::size_t get_count();
  void get_object(const ObjectType& type, void* object);
  [[nodiscard]] ObjectRef get_shared();
  void check(bool fits, const char* what);
  [[nodiscard]] std::uint64_t get_bits(detail::StateKind kind);
  [[nodiscard]] std::span<const std::byte> get_bytes(std::uint64_t count);

  StateTag tag_;
  std::span<const std::byte> rest_;
  std::size_t values_ = 0;  // begun so far
  std::optional<Error> error_;
};

template <class T>
void StateWriter::put(const T& value) {
  if constexpr (std::same_as<T, bool>) {
    put_boolean(value);
  } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
    put_integer(static_cast<std::int64_t>(value));
  } else if constexpr (std::is_floating_point_v<T>) {
    static_assert(sizeof(T) <= sizeof(double), "a state holds no long double");
    put_real(static_cast<double>(value));
  } else if constexpr (std::same_as<T, std::string>) {
    put_text(value);
  } else if constexpr (std::derived_from<T, idl::OrcaObject>) {
    put_object(object_type<T>(), &value);
  } else if constexpr (detail::SharedObject<T>) {
    put_shared(value.ref());
  } else if constexpr (detail::TimeSpan<T>) {
    put(value.count());
  } else if constexpr (detail::Instant<T>) {
    put(value.time_since_epoch());
  } else if constexpr (detail::Optional<T>) {
    put_boolean(value.has_value());
    if (value) put(*value);
  } else if constexpr (detail::Sequence<T>) {
    put_count(value.size());
    for (const auto& element : value) put(element);
  } else {
    // The parts are only read, but a class names them once, for readers and writers.
    std::apply([this](const auto&... part) { (put(part), ...); },
               detail::parts_of_state(const_cast<T&>(value)));
  }
}

template <class T>
void StateReader::get(T& value) {
  if constexpr (std::same_as<T, bool>) {
    value = get_boolean();
  } else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>) {
    get_integer(value);
  } else if constexpr (std::is_floating_point_v<T>) {
    value = static_cast<T>(get_real());
  } else if constexpr (std::same_as<T, std::string>) {
    value = get_text();
  } else if constexpr (std::derived_from<T, idl::OrcaObject>) {
    get_object(object_type<T>(), &value);
  } else if constexpr (detail::SharedObject<T>) {
    get_pointer(value);
  } else if constexpr (detail::TimeSpan<T>) {
    typename T::rep count{};
    get(count);
    value = T{count};
  } else if constexpr (detail::Instant<T>) {
    typename T::duration since{};
    get(since);
    value = T{since};
  } else if constexpr (detail::Optional<T>) {
    value.reset();
    if (get_boolean()) get(value.emplace());
  } else if constexpr (detail::Sequence<T>) {
    get_elements(value);
  } else {
    std::apply([this](auto&... part) { (get(part), ...); }, detail::parts_of_state(value));
  }
}

template <class T>
void StateReader::get_integer(T& value) {
  const std::int64_t found = get_integer();
  value = static_cast<T>(found);
  check(static_cast<std::int64_t>(value) == found, "a number too large for its place");
}

template <class T>
void StateReader::get_pointer(ObjectPtr<T>& value) {
  ObjectRef object = get_shared();
  const bool is_there = static_cast<bool>(object);
  value = object_cast<T>(std::move(object));
  check(!is_there || value, "an object of another type");
}

template <class T>
void StateReader::get_elements(T& value) {
  const std::size_t count = get_count();
  if constexpr (detail::Growing<T>) {
    value.clear();
    for (std::size_t i = 0; i < count && !error_; ++i) {
      decltype(detail::made_alone(static_cast<const typename T::value_type*>(nullptr))) element{};
      get(element);
      value.insert(value.end(), std::move(element));
    }
  } else {
    check(count == value.size(), "an array of another length");
    for (auto& element : value)
      if (!error_) get(element);
  }
}

}  // namespace orca
