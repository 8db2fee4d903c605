// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

#include "orca/idl/object_type.hpp"

namespace orca::test {

using Bytes = std::vector<std::byte>;

template <class T>
[[nodiscard]] Bytes serialized(const T& object) {
  Bytes bytes;
  object_type<T>().serialize(&object, bytes);
  return bytes;
}

}  // namespace orca::test
