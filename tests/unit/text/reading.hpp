// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "orca/text/object_xml.hpp"

namespace orca::test {

/// The result of from_xml() for a text.
struct Reading {
  std::optional<ObjectLoan> object;
  std::string errors;
};

inline Reading reading(std::string_view text, const ObjectType* expected = nullptr) {
  xml::Diagnostics diagnostics;
  std::optional<ObjectLoan> object = from_xml(text, "x", diagnostics, expected);
  return {std::move(object), diagnostics.text()};
}

/// Returns the T of a text without errors. Throws with the errors otherwise, which fails the test.
template <class T>
T read(std::string_view text) {
  const Reading result = reading(text, &object_type<T>());
  if (!result.object) throw std::runtime_error(result.errors);
  return *static_cast<const T*>(result.object->get());
}

template <class T>
std::string written(const T& object) {
  return to_xml(object_type<T>(), &object);
}

}  // namespace orca::test
