// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "orca/idl/bulk.hpp"
#include "orca/idl/generated/time.h"
#include "orca/idl/reflection.hpp"

namespace orca::detail {

/// A writer of objects for people: a line per field, nested structs in braces on that line, each number
/// followed by its unit. Numbers are written with the fewest digits that read back as the same number.
///
/// Thread contract: one thread.
class DumpWriter {
 public:
  explicit DumpWriter(std::string_view type_name) : text_(type_name) {}

  template <class T>
  void field(const FieldInfo& info, const T& value) {
    if (info.header && depth_ > 0) return;  // Only the outermost object carries a time stamp.
    start_field(info.name);
    write(value);
    if (!info.unit.empty() && info.unit != "1") add_unit(info.unit);
  }

  [[nodiscard]] std::string take() && { return std::move(text_); }

 private:
  void write(bool value) { text_ += value ? "true" : "false"; }
  void write(double value);
  void write(const std::string& value);
  void write(const idl::TimeValue& value);

  template <class T>
  requires std::is_integral_v<T>
  void write(T value) { text_ += std::to_string(value); }
  template <ReflectedEnum T>
  void write(T value) {
    constexpr auto& names = EnumReflection<T>::names;
    const auto index = static_cast<std::size_t>(value);
    text_ += index < names.size() ? std::string(names[index]) : "unknown " + std::to_string(index);
  }
  template <ReflectedStruct T>
  void write(const T& value) {
    text_ += '{';
    ++depth_;
    first_ = true;
    Reflection<T>::fields(value, *this);
    --depth_;
    text_ += '}';
  }
  template <class T>
  void write(const std::vector<T>& values) {
    write_list(std::span<const T>(values));
  }
  template <class T, std::size_t N>
  void write(const std::array<T, N>& values) {
    write_list(std::span<const T>(values));
  }
  template <class T>
  void write(const Bulk<T>& values) {
    write_list(std::span<const T>(values));
  }
  template <class T>
  void write_list(std::span<const T> values) {
    text_ += '[';
    for (std::size_t i = 0; i < values.size(); ++i) {
      start_element(i, ReflectedStruct<T> && !std::is_same_v<T, idl::TimeValue>);
      write(values[i]);
    }
    text_ += ']';
  }

  void start_field(std::string_view name);
  void start_element(std::size_t index, bool own_line);
  void add_unit(std::string_view unit);

  std::string text_;
  int depth_ = 0;
  bool first_ = true;
};

}  // namespace orca::detail
