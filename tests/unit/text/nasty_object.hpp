// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <bit>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/time.hpp"

namespace orca::test {

/// Gives every field a value that is hard to write down: special doubles and any bits, limits of integers,
/// texts of any bytes; sequences get 0 to 3 elements.
class NastyFill final : public FieldVisitor {
 public:
  explicit NastyFill(RandomStream& stream) : stream_(stream) {}

  void field(const FieldInfo&, const Value& value) override { fill(value); }

 private:
  void fill(const Value& value) {
    if (stream_.chance(0.2)) return;  // Stays the default.
    std::visit([this](auto& v) { set(v); }, value.of);
  }
  void set(bool* const& value) { *value = stream_.chance(0.5); }
  template <class T>
  void set(T* const& value) {
    const std::array<T, 3> edges{std::numeric_limits<T>::min(), std::numeric_limits<T>::max(), T{1}};
    *value = stream_.chance(0.5) ? edges[below(3)] : static_cast<T>(stream_());
  }
  void set(double* const& value) {
    using Limits = std::numeric_limits<double>;
    const std::array special{-0.0,
                             Limits::infinity(),
                             -Limits::infinity(),
                             Limits::quiet_NaN(),
                             Limits::max(),
                             Limits::denorm_min(),
                             0.1,
                             -1e-7,
                             Limits::min(),
                             Limits::signaling_NaN()};
    *value = stream_.chance(0.5) ? special[below(special.size())] : std::bit_cast<double>(stream_());
  }
  void set(std::string* const& value) {
    constexpr std::string_view kMarks = " \t\n\r\"'<>&;\\x0#]\x7f\x1b\xc3\xa4\xff";
    value->resize(below(24));
    for (char& c : *value)
      c = stream_.chance(0.7) ? kMarks[below(kMarks.size())] : static_cast<char>(stream_());
  }
  void set(idl::TimeValue* const& value) { value->ns(static_cast<std::int64_t>(stream_() >> below(60))); }
  void set(const EnumValue& value) {
    value.set(value.place, static_cast<std::uint32_t>(below(value.names.size())));
  }
  void set(const StructValue& value) { value.fields(value.object, *this); }
  void set(const ListValue& value) {
    if (value.resize != nullptr) value.resize(value.list, below(4));
    for (std::size_t i = 0; i < value.size(value.list); ++i) fill(value.at(value.list, i));
  }

  std::size_t below(std::size_t limit) { return stream_() % limit; }

  RandomStream& stream_;
};

/// Returns a T whose content depends only on the seed.
template <class T>
[[nodiscard]] T nasty_object(std::uint64_t seed) {
  RandomStream stream(seed, "test", object_type<T>().name);
  T object;
  NastyFill fill(stream);
  object_type<T>().fields(&object, fill);
  return object;
}

}  // namespace orca::test
