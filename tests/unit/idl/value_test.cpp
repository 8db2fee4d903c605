// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <map>
#include <string>

#include "all_objects.hpp"
#include "orca/idl/system.hpp"

using orca::ElementKind;
using orca::EnumValue;
using orca::FieldInfo;
using orca::ListValue;
using orca::object_type;
using orca::StructValue;
using orca::Value;

namespace {

// Records the fields that it is shown.
class Fields final : public orca::FieldVisitor {
 public:
  template <class T>
  explicit Fields(T& object) {
    object_type<T>().fields(&object, *this);
  }

  void field(const FieldInfo& info, const Value& value) override {
    order += std::string(info.name) + (info.unit.empty() ? "" : "[" + std::string(info.unit) + "]") +
             (info.header ? "*" : "") + " ";
    values.emplace(info.name, value);
  }

  template <class V>
  V as(const std::string& name) const {
    return std::get<V>(values.at(name).of);
  }

  std::string order;
  std::map<std::string, Value> values;
};

}  // namespace

TEST_CASE("an object shows its fields with their units, inherited ones first, and marks the header",
          "[idl][value]") {
  orca::idl::Arrived arrived;
  CHECK(Fields(arrived).order ==
        "creation_time* origin* origin_port* seq* mission* cause* name x[m] y[m] stamp ");
}

TEST_CASE("a value is a place in the object, to read and to write", "[idl][value]") {
  orca::idl::Arrived arrived;
  const Fields fields(arrived);
  *fields.as<double*>("x") = 1.5;
  *fields.as<std::string*>("name") = "lab";
  *fields.as<std::uint64_t*>("seq") = 7;
  fields.as<orca::idl::TimeValue*>("stamp")->ns(9);
  CHECK(arrived.x() == 1.5);
  CHECK(arrived.name() == "lab");
  CHECK(arrived.seq() == 7);
  CHECK(arrived.stamp().ns() == 9);
}

TEST_CASE("an enum is shown with its enumerators", "[idl][value]") {
  orca::idl::MotionCommand command;
  const auto kind = Fields(command).as<EnumValue>("kind");
  CHECK(kind.type == "MotionKind");
  REQUIRE(kind.names.size() == 3);
  CHECK(kind.names[2] == "FULLSTOP");
  kind.set(kind.place, 2);
  CHECK(command.kind() == orca::idl::FULLSTOP);
  CHECK(kind.get(kind.place) == 2);
}

TEST_CASE("a struct is shown with its type and shows its own fields", "[idl][value]") {
  orca::idl::Arrived arrived;
  const auto cause = Fields(arrived).as<StructValue>("cause");
  CHECK(cause.type == "Cause");
  CHECK(cause.object == &arrived.cause());
}

TEST_CASE("a sequence can be resized, an array cannot, and both know what their elements are",
          "[idl][value]") {
  orca::idl::SonarRangeReadings sonar;
  const Fields fields(sonar);
  const auto ranges = fields.as<ListValue>("ranges");
  CHECK(ranges.kind == ElementKind::plain);
  ranges.resize(ranges.list, 2);
  *std::get<double*>(ranges.at(ranges.list, 1).of) = 0.5;
  CHECK(sonar.ranges() == std::vector<double>{0.0, 0.5});
  CHECK(fields.as<ListValue>("poses").kind == ElementKind::structure);
  CHECK(fields.as<ListValue>("stamps").kind == ElementKind::plain);

  orca::idl::ClientList list;
  CHECK(Fields(list).as<ListValue>("clients").kind == ElementKind::text);

  orca::idl::RobotPose pose;
  const auto covariance = Fields(pose).as<ListValue>("covariance");
  CHECK(covariance.resize == nullptr);
  CHECK(covariance.size(covariance.list) == 9);
}

TEST_CASE("the kind of an alarm is a word, whatever number stands there", "[idl][alarm]") {
  namespace idl = orca::idl;
  idl::Alarm alarm;
  alarm.kind(idl::SIGNAL_MASK);
  CHECK(kind_text(alarm) == "SIGNAL_MASK");
  alarm.kind(idl::OWN_KIND);
  alarm.own_kind("GRIPPER_WORN");
  CHECK(kind_text(alarm) == "GRIPPER_WORN");
  alarm.kind(static_cast<idl::AlarmKind>(99));
  CHECK(kind_text(alarm) == "unknown 99");
}
