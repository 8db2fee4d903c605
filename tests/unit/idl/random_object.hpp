// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <string>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/idl/bulk.hpp"
#include "orca/idl/reflection.hpp"

namespace orca::test {

/// A visitor that gives every field a random value; sequences get 0 to 3 elements, texts 0 to 20 letters.
class RandomFill {
 public:
  explicit RandomFill(RandomStream& stream) : stream_(stream) {}

  template <class T>
  void field(const FieldInfo&, T& value) {
    fill(value);
  }

  template <ReflectedStruct T>
  void fill(T& value) {
    Reflection<T>::fields(value, *this);
  }

 private:
  void fill(bool& value) { value = stream_.chance(0.5); }
  void fill(double& value) { value = stream_.normal(0.0, 100.0); }
  void fill(std::string& value) {
    value.resize(below(21));
    for (char& c : value) c = static_cast<char>('a' + below(26));
  }
  template <class T>
  requires std::is_integral_v<T>
  void fill(T& value) { value = static_cast<T>(stream_()); }
  template <ReflectedEnum T>
  void fill(T& value) {
    value = static_cast<T>(below(EnumReflection<T>::names.size()));
  }
  template <class T>
  void fill(std::vector<T>& values) {
    values.resize(below(4));
    for (T& value : values) fill(value);
  }
  template <class T>
  void fill(Bulk<T>& values) {
    values.resize(below(4));
    for (T& value : values) fill(value);
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& values) {
    for (T& value : values) fill(value);
  }

  std::size_t below(std::size_t limit) { return stream_() % limit; }

  RandomStream& stream_;
};

/// Returns a T whose content depends only on the seed.
template <class T>
[[nodiscard]] T random_object(std::uint64_t seed) {
  RandomStream stream(seed, "test", Reflection<T>::name);
  T object;
  RandomFill(stream).fill(object);
  return object;
}

}  // namespace orca::test
