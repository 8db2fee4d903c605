// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <concepts>
#include <string>
#include <type_traits>
#include <vector>

#include "orca/idl/bulk.hpp"
#include "orca/idl/generated/time.h"
#include "orca/idl/value.hpp"

namespace orca::detail {

template <class T>
concept SingleValue =
    std::is_arithmetic_v<T> || std::same_as<T, std::string> || std::same_as<T, idl::TimeValue>;

template <class T>
constexpr ElementKind element_kind() {
  if constexpr (std::same_as<T, std::string>) return ElementKind::text;
  return ReflectedStruct<T> && !SingleValue<T> ? ElementKind::structure : ElementKind::plain;
}

template <class T>
void visit_fields(void* object, FieldVisitor& visitor);

template <SingleValue T>
Value make_value(T& value) {
  return {&value};
}

template <ReflectedEnum T>
Value make_value(T& value) {
  return {
      EnumValue{.type = EnumReflection<T>::name,
                .names = EnumReflection<T>::names,
                .place = &value,
                .get = [](const void* place) { return std::uint32_t{*static_cast<const T*>(place)}; },
                .set = [](void* place, std::uint32_t n) { *static_cast<T*>(place) = static_cast<T>(n); }}};
}

template <ReflectedStruct T>
requires(!SingleValue<T>) Value make_value(T& value) {
  return {StructValue{.type = Reflection<T>::name, .object = &value, .fields = visit_fields<T>}};
}

template <class List>
ListValue make_list(List& list) {
  return {.kind = element_kind<typename List::value_type>(),
          .list = &list,
          .size = [](const void* l) { return static_cast<const List*>(l)->size(); },
          .resize = nullptr,
          .at = [](void* l, std::size_t index) { return make_value((*static_cast<List*>(l))[index]); }};
}

template <class T, std::size_t N>
Value make_value(std::array<T, N>& list) {
  return {make_list(list)};
}

template <class List>
Value make_sequence(List& list) {
  ListValue value = make_list(list);
  value.resize = [](void* l, std::size_t count) { static_cast<List*>(l)->resize(count); };
  return {value};
}

template <class T>
Value make_value(std::vector<T>& list) {
  return make_sequence(list);
}
template <class T>
Value make_value(Bulk<T>& list) {
  return make_sequence(list);
}

/// A visitor that passes on the fields of a struct without their C++ types.
class TypeEraser {
 public:
  explicit TypeEraser(FieldVisitor& visitor) : visitor_(visitor) {}

  template <class T>
  void field(const FieldInfo& info, T& value) {
    visitor_.field(info, make_value(value));
  }

 private:
  FieldVisitor& visitor_;
};

template <class T>
void visit_fields(void* object, FieldVisitor& visitor) {
  TypeEraser eraser(visitor);
  Reflection<T>::fields(*static_cast<T*>(object), eraser);
}

}  // namespace orca::detail
