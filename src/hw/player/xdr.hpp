// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace orca::hw::player {

// Fewest bytes of an element of a list on the line. Structures in lists specialise it.
template <class T>
inline constexpr std::size_t kElementSize = sizeof(T);

// Writes values in XDR. Structures have a function fields() in their namespace that names their members in order; it
// serves the reader as well.
class XdrWriter {
 public:
  template <class T>
  using Of = const T&;

  template <class... Members>
  void all(const Members&... members) {
    (one(members), ...);
  }
  [[nodiscard]] std::vector<std::uint8_t>&& take() && { return std::move(bytes_); }

  void one(std::uint32_t value);
  void one(std::int32_t value) { one(static_cast<std::uint32_t>(value)); }
  void one(bool value) { one(std::uint32_t{value}); }
  void one(float value);
  void one(double value);
  void one(const std::string& text);
  void one(const std::vector<std::uint8_t>& list);
  template <class T>
  void one(const std::vector<T>& list) {
    counts(list.size());
    for (const T& element : list) one(element);
  }
  // A flag, and in any case the value.
  template <class T>
  void one(const std::optional<T>& value) {
    one(value.has_value());
    one(value ? *value : T{});
  }
  template <class E>
  requires std::is_enum_v<E>
  void one(E value) { one(static_cast<std::uint32_t>(value)); }
  template <class T>
  requires std::is_class_v<T>
  void one(const T& structure) { fields(*this, structure); }

 private:
  void counts(std::size_t count);
  void padded(std::span<const std::uint8_t> bytes);

  std::vector<std::uint8_t> bytes_;
};

// Reads values in XDR. After the first error it reads zeros and empty lists.
class XdrReader {
 public:
  template <class T>
  using Of = T&;

  explicit XdrReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <class... Members>
  void all(Members&... members) {
    (one(members), ...);
  }
  // What is wrong; empty if nothing is.
  [[nodiscard]] const std::string& trouble() const { return trouble_; }
  // Complains if bytes are left.
  void finish();

  void one(std::uint32_t& value) { value = number(); }
  void one(std::int32_t& value) { value = static_cast<std::int32_t>(number()); }
  void one(bool& value) { value = number() != 0; }
  void one(float& value);
  void one(double& value);
  void one(std::string& text);
  void one(std::vector<std::uint8_t>& list);
  template <class T>
  void one(std::vector<T>& list) {
    list.resize(counts(kElementSize<T>));
    for (T& element : list) one(element);
  }
  template <class T>
  void one(std::optional<T>& value) {
    const bool is_there = number() != 0;
    T read{};
    one(read);
    if (is_there) value = std::move(read);
  }
  template <class E>
  requires std::is_enum_v<E>
  void one(E& value) {
    const std::uint32_t read = number();
    if (is_known(static_cast<E>(read)))
      value = static_cast<E>(read);
    else
      complain("a field has the value " + std::to_string(read) + ", which means nothing there");
  }
  template <class T>
  requires std::is_class_v<T>
  void one(T& structure) { fields(*this, structure); }

 private:
  std::uint32_t number();
  // The number of elements, once both counts agree and so many elements can follow; else 0.
  std::size_t counts(std::size_t element_size);
  std::span<const std::uint8_t> padded(std::size_t count);
  std::span<const std::uint8_t> next(std::size_t count);
  void complain(std::string trouble);

  std::span<const std::uint8_t> bytes_;
  std::string trouble_;
};

}  // namespace orca::hw::player
