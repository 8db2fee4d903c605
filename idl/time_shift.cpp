// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/time_shift.hpp"

#include <cstdint>
#include <variant>

#include "orca/idl/object_type.hpp"
#include "orca/idl/time.hpp"
#include "orca/idl/value.hpp"

namespace orca {
namespace {

class Shifter final : public FieldVisitor {
 public:
  explicit Shifter(Duration by) : by_(by) {}

  void field(const FieldInfo& /*info*/, const Value& value) override { shift(value); }

 private:
  void shift(const Value& value) {
    if (auto* const* const time = std::get_if<idl::TimeValue*>(&value.of)) {
      if ((*time)->ns() != 0) (*time)->ns(sum((*time)->ns(), by_.count()));
    } else if (const auto* const part = std::get_if<StructValue>(&value.of)) {
      part->fields(part->object, *this);
    } else if (const auto* const list = std::get_if<ListValue>(&value.of)) {
      for (std::size_t i = 0, size = list->size(list->list); i < size; ++i) {
        const Value element = list->at(list->list, i);
        if (i == 0 && !may_have_times(element)) return;
        shift(element);
      }
    }
  }

  // Wraps around: what comes from a network may hold any number.
  static std::int64_t sum(std::int64_t a, std::int64_t b) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + static_cast<std::uint64_t>(b));
  }

  static bool may_have_times(const Value& value) {
    return std::holds_alternative<idl::TimeValue*>(value.of) || std::holds_alternative<StructValue>(value.of);
  }

  const Duration by_;
};

}  // namespace

void shift_times(ObjectLoan& object, Duration by) {
  if (by == Duration{0}) return;
  Shifter shifter(by);
  object.type().fields(object.get(), shifter);
}

}  // namespace orca
