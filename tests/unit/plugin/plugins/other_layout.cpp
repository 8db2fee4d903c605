// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin that seems built at a time when GoalPoint had another field and a type existed that is gone now.
#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"

namespace orca {

namespace idl {
class Balloon;
}

namespace detail {
template <>
const ObjectType& object_type_of<idl::GoalPoint, 0x1234U>();
template <>
const ObjectType& object_type_of<idl::Balloon, 0x5678U>();
}  // namespace detail

}  // namespace orca

namespace {

[[gnu::section("orca_layouts"), gnu::used, gnu::retain]] constexpr char layouts[] =
    "GoalPoint{creation_time:TimeValue{ns:int64 {us}},name:string}";

class Old final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override {
    return orca::detail::object_type_of<orca::idl::GoalPoint, 0x1234U>().size >
                   orca::detail::object_type_of<orca::idl::Balloon, 0x5678U>().size
               ? orca::again()
               : orca::done();
  }
};

}  // namespace

ORCA_COMPONENT(Old, "test.Old")
