// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "allocation_counter.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"

using orca::test::allocations;

namespace {

template <class F>
long allocations_of_hundred(F&& lap) {
  const long before = allocations();
  for (int i = 0; i < 100; ++i) lap();
  return allocations() - before;
}

void fill(orca::idl::SonarRangeReadings& sonar) {
  sonar.origin() = "Platforms/Dewey/base/sonar";  // Longer than what a string holds without the heap.
  sonar.ranges().assign(16, 2.0);
  sonar.ranges_uncertainty().assign(16, 0.01);
  sonar.poses().resize(16);
  sonar.stamps().resize(16);
}

}  // namespace

TEST_CASE("the counter sees the allocations of liborca_idl.so", "[idl][allocation]") {
  const long before = allocations();
  std::vector<orca::ObjectPtr<orca::idl::SonarRangeReadings>> kept;
  for (int i = 0; i < 100; ++i) kept.push_back(orca::make_object<orca::idl::SonarRangeReadings>());
  kept.clear();
  CHECK(allocations() > before);
}

TEST_CASE("after warm-up, making and dropping motion commands takes nothing from the heap",
          "[idl][allocation]") {
  const auto lap = [] {
    orca::Loan<orca::idl::MotionCommand> command = orca::head(0.1, 0.5);
    command->origin() = "Platforms/Dewey/components/goto";
    const orca::ObjectPtr<orca::idl::MotionCommand> view = std::move(command);
    const orca::ObjectPtr<orca::idl::MotionCommand> copy = orca::copy_value(view);
    const orca::ObjectRef shared = copy;
  };
  lap();
  CHECK(allocations_of_hundred(lap) == 0);
}

TEST_CASE("after warm-up, making, copying and dropping sonar readings takes nothing from the heap",
          "[idl][allocation]") {
  const auto lap = [] {
    orca::Loan<orca::idl::SonarRangeReadings> sonar = orca::make_object<orca::idl::SonarRangeReadings>();
    fill(*sonar);
    const orca::ObjectPtr<orca::idl::SonarRangeReadings> view = std::move(sonar);
    const orca::ObjectPtr<orca::idl::SonarRangeReadings> copy = orca::copy_value(view);
  };
  lap();
  lap();  // The free list turns the two places round once.
  CHECK(allocations_of_hundred(lap) == 0);
}

TEST_CASE("after warm-up, serializing and reading sonar readings takes nothing from the heap",
          "[idl][allocation]") {
  const orca::ObjectType& type = orca::object_type<orca::idl::SonarRangeReadings>();
  orca::idl::SonarRangeReadings sonar;
  fill(sonar);
  orca::idl::SonarRangeReadings copy;
  std::vector<std::byte> bytes;
  const auto lap = [&] {
    bytes.clear();
    type.serialize(&sonar, bytes);
    if (!type.deserialize(bytes, &copy).ok()) std::abort();
  };
  lap();
  CHECK(allocations_of_hundred(lap) == 0);
  CHECK(copy == sonar);
}
