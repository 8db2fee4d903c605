// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <memory>
#include <new>
#include <set>

#include "all_objects.hpp"
#include "orca/base/hash.hpp"
#include "orca/idl/object.hpp"
#include "random_object.hpp"

using orca::find_object_type;
using orca::object_type;
using orca::object_types;
using orca::ObjectType;

TEMPLATE_LIST_TEST_CASE("an object type is found by its name", "[idl][type]", orca::test::AllObjects) {
  CHECK(find_object_type(orca::Reflection<TestType>::name) == &object_type<TestType>());
}

TEST_CASE("there is no object type by a name that the IDL files do not hold", "[idl][type]") {
  CHECK(find_object_type("SonarRangeReading") == nullptr);
  CHECK(find_object_type("") == nullptr);
  CHECK(find_object_type("zzz") == nullptr);
  CHECK(find_object_type("Frame3D") == nullptr);  // A part of objects, but no object itself.
}

TEMPLATE_LIST_TEST_CASE(
    "a plain struct that travels is known by its own name, with a header before its fields",
    "[idl][type][travelling]", orca::test::TravellingStructs) {
  const ObjectType& type = object_type<TestType>();
  CHECK(&type == &object_type<orca::Travelling<TestType>>());
  CHECK(type.name == orca::Reflection<TestType>::name);
  CHECK_THAT(std::string(type.layout),
             Catch::StartsWith(std::string(type.name)) &&
                 Catch::Contains("{creation_time:TimeValue{ns:int64 "
                                 "{ns}},origin:string,origin_port:string,seq:uint64,mission:uint64,"
                                 "cause:Cause{origin:string,port:string,seq:uint64},"));
}

TEST_CASE("a struct that travels and is a part of others has no header there", "[idl][type][travelling]") {
  const std::string_view goal = object_type<orca::idl::GoalPoint>().layout;
  CHECK_THAT(std::string(goal), Catch::Contains("coordinate:WorldCoordinate3D{point:Point{x:double {m},"));
  CHECK(goal.find("creation_time") == goal.rfind("creation_time"));
}

TEST_CASE("a struct that travels keeps its parent", "[idl][type][travelling]") {
  const ObjectType& attitude = object_type<orca::idl::WorldCoordinate6DOF>();
  CHECK(attitude.parent == &object_type<orca::idl::WorldCoordinate3D>());
  CHECK(object_type<orca::idl::Point>().parent == nullptr);
}

TEST_CASE("these tests cover every object type", "[idl][type]") {
  CHECK(object_types().size() == std::tuple_size_v<orca::test::AllObjects>);
}

TEST_CASE("the type hash is FNV-1a of the flattened layout, and no two types share one", "[idl][type]") {
  std::set<std::uint64_t> hashes;
  for (const ObjectType* type : object_types()) {
    orca::Fnv1a hash;
    hash.add_text(type->layout);
    CHECK(type->layout_hash == hash.value());
    hashes.insert(type->layout_hash);
    CHECK(orca::type_id(*type) == orca::TypeId{std::string(type->name), hash.value(), ""});
    CHECK(orca::type_id(*type).layout == type->layout);
  }
  CHECK(hashes.size() == object_types().size());
}

TEST_CASE("a type is one of its ancestors, and none of its descendants or siblings", "[idl][type]") {
  const ObjectType& ranges = object_type<orca::idl::RangeReadings>();
  const ObjectType& sonar = object_type<orca::idl::SonarRangeReadings>();
  const ObjectType& laser = object_type<orca::idl::LaserRangeReadings>();
  CHECK(ranges.parent == nullptr);
  CHECK(sonar.parent == &ranges);
  CHECK(is_a(sonar, sonar));
  CHECK(is_a(sonar, ranges));
  CHECK_FALSE(is_a(ranges, sonar));
  CHECK_FALSE(is_a(laser, sonar));
  CHECK(is_a(type_id(sonar), type_id(ranges)));
  CHECK_FALSE(is_a(type_id(ranges), type_id(sonar)));
  CHECK(orca::find_subtype(ranges, laser.layout_hash) == &laser);
  CHECK(orca::find_subtype(ranges, ranges.layout_hash) == &ranges);
  CHECK(orca::find_subtype(sonar, laser.layout_hash) == nullptr);
  CHECK(orca::find_subtype(ranges, 7) == nullptr);
}

TEST_CASE("the identity of a type names its ancestors, the nearest first", "[idl][type]") {
  const orca::TypeId door = type_id(object_type<orca::idl::Door>());
  REQUIRE(door.ancestors.size() == 1);
  CHECK(door.ancestors[0] == type_id(object_type<orca::idl::GoalPoint>()));
  CHECK(door.layout.starts_with("Door:GoalPoint{creation_time:"));
  CHECK(type_id(object_type<orca::idl::GoalPoint>()).ancestors.empty());
}

// Views of a derived object as its parent rely on this.
TEMPLATE_LIST_TEST_CASE("an object begins with the part that it inherits", "[idl][type]",
                        orca::test::AllObjects) {
  const auto object = orca::test::random_object<TestType>(6);
  const ObjectType& type = object_type<TestType>();
  CHECK(static_cast<const void*>(static_cast<const orca::idl::OrcaObject*>(&object)) == &object);
  for (const ObjectType* parent = type.parent; parent != nullptr; parent = parent->parent) {
    const auto part = orca::make_object(*parent);
    parent->assign(const_cast<void*>(part.get()), &object);
    CHECK(parent->equal(part.get(), &object));
    CHECK(type.layout.starts_with(std::string(type.name) + ":" + std::string(type.parent->name) + "{"));
  }
}

// A failure here means that programs built before and after the change cannot exchange motion commands. If
// that is meant, write the new layout here.
TEST_CASE("the layout of a MotionCommand is the one that other programs know", "[idl][type]") {
  CHECK(object_type<orca::idl::MotionCommand>().layout ==
        "MotionCommand{creation_time:TimeValue{ns:int64 "
        "{ns}},origin:string,origin_port:string,seq:uint64,mission:uint64,"
        "cause:Cause{origin:string,port:string,seq:uint64},kind:MotionKind(NORMAL,DONTCARE,FULLSTOP),"
        "steering:MotionSteering(BY_DIRECTION,BY_TURN_RATE),direction:double {rad},turn_rate:double {rad/s},"
        "speed:double {m/s},weight:double {1}}");
}

TEMPLATE_LIST_TEST_CASE("the erased operations are those of the type", "[idl][type]",
                        orca::test::AllObjects) {
  const ObjectType& type = object_type<TestType>();
  REQUIRE(type.size == sizeof(TestType));
  REQUIRE(type.align == alignof(TestType));
  const auto original = orca::test::random_object<TestType>(5);
  alignas(TestType) std::byte place[sizeof(TestType)];
  type.construct(place);
  const TestType blank;
  CHECK(type.equal(place, &blank));
  type.assign(place, &original);
  CHECK(type.equal(place, &original));
  CHECK_FALSE(type.equal(place, &blank));
  CHECK(&type.header(place) ==
        static_cast<orca::idl::OrcaObject*>(std::launder(reinterpret_cast<TestType*>(place))));
  type.destroy(place);
}
