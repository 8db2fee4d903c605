// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace orca::detail {

/// Converts to anything, which shows how many members a plain struct can be made of.
struct AnyPart {
  template <class T>
  operator T() const;  // NOLINT: the conversion is the purpose
};

template <class T, class... Parts>
constexpr std::size_t count_parts() {
  if constexpr (requires { T{Parts{}..., AnyPart{}}; }) {
    return count_parts<T, Parts..., AnyPart>();
  } else {
    return sizeof...(Parts);
  }
}

/// Returns references to the members of a plain struct, in their order.
template <class T>
auto parts_of(T& value) {
  static_assert(std::is_aggregate_v<T>,
                "a value of a state is a plain struct or a basic type, or its class has a function "
                "auto state() { return std::tie(member, ...); }");
  constexpr std::size_t kParts = count_parts<T>();
  static_assert(kParts >= 1 && kParts <= 8,
                "a plain struct in a state has one to eight members; give others a function "
                "auto state() { return std::tie(member, ...); }");
  if constexpr (kParts == 1) {
    auto& [a] = value;
    return std::tie(a);
  } else if constexpr (kParts == 2) {
    auto& [a, b] = value;
    return std::tie(a, b);
  } else if constexpr (kParts == 3) {
    auto& [a, b, c] = value;
    return std::tie(a, b, c);
  } else if constexpr (kParts == 4) {
    auto& [a, b, c, d] = value;
    return std::tie(a, b, c, d);
  } else if constexpr (kParts == 5) {
    auto& [a, b, c, d, e] = value;
    return std::tie(a, b, c, d, e);
  } else if constexpr (kParts == 6) {
    auto& [a, b, c, d, e, f] = value;
    return std::tie(a, b, c, d, e, f);
  } else if constexpr (kParts == 7) {
    auto& [a, b, c, d, e, f, g] = value;
    return std::tie(a, b, c, d, e, f, g);
  } else {
    auto& [a, b, c, d, e, f, g, h] = value;
    return std::tie(a, b, c, d, e, f, g, h);
  }
}

/// Returns references to both parts of a pair.
template <class First, class Second>
auto parts_of(std::pair<First, Second>& pair) {
  return std::tie(pair.first, pair.second);
}

}  // namespace orca::detail
