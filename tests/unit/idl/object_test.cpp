// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "all_objects.hpp"
#include "random_object.hpp"

using orca::copy_value;
using orca::Loan;
using orca::make_object;
using orca::object_cast;
using orca::object_type;
using orca::ObjectLoan;
using orca::ObjectPtr;
using orca::ObjectRef;
using orca::pool_statistics;
using orca::idl::MotionCommand;
using orca::idl::Odometry;
using orca::idl::SonarRangeReadings;

namespace {

std::size_t live_commands() { return pool_statistics(object_type<MotionCommand>()).live; }

}  // namespace

TEST_CASE("a loan that is dropped returns to its pool, a sealed one with its last view", "[idl][object]") {
  const std::size_t before = live_commands();
  { const auto dropped = make_object<MotionCommand>(); }
  CHECK(live_commands() == before);
  ObjectPtr<MotionCommand> first = make_object<MotionCommand>();
  ObjectPtr<MotionCommand> second = first;
  CHECK(first.get() == second.get());
  CHECK(live_commands() == before + 1);
  first = nullptr;
  CHECK(live_commands() == before + 1);
  second = {};
  CHECK(live_commands() == before);
}

TEST_CASE("a recycled place gives a default object", "[idl][object]") {
  const void* place = nullptr;
  {
    auto loan = make_object(orca::test::random_object<SonarRangeReadings>(1));
    place = loan.get();
  }
  const auto again = make_object<SonarRangeReadings>();
  REQUIRE(again.get() == place);
  CHECK(*again == SonarRangeReadings());
}

TEST_CASE("copy_value makes an independent copy", "[idl][object]") {
  const ObjectPtr<SonarRangeReadings> original =
      make_object(orca::test::random_object<SonarRangeReadings>(2)).seal();
  const SonarRangeReadings value = *original;
  Loan<SonarRangeReadings> copy = copy_value(original);
  CHECK(*copy == *original);
  CHECK(copy.get() != original.get());
  copy->ranges().push_back(9.0);
  copy->origin("elsewhere");
  CHECK(*original == value);
}

TEST_CASE("an object of unknown type can be made, filled, copied, shown and cast", "[idl][object]") {
  ObjectLoan loan = make_object(*orca::find_object_type("MotionCommand"));
  loan.header().origin("goto");
  const ObjectRef ref = std::move(loan).seal();
  CHECK(&ref.type() == &object_type<MotionCommand>());
  CHECK(ref.header().origin() == "goto");
  CHECK_THAT(ref.dump(), Catch::Contains("origin: \"goto\""));

  ObjectLoan copy = copy_value(ref);
  copy.header().origin("fuser");
  CHECK(ref.header().origin() == "goto");

  CHECK(object_cast<MotionCommand>(ref)->origin() == "goto");
  CHECK(object_cast<Odometry>(ref) == nullptr);
  CHECK(object_cast<MotionCommand>(ObjectRef()) == nullptr);
}

TEST_CASE("a view converts to an untyped one and stays a view of the same object", "[idl][object]") {
  const ObjectPtr<MotionCommand> command = orca::full_stop();
  const ObjectRef ref = command;
  CHECK(ref.get() == command.get());
  CHECK(ref == command.ref());
  CHECK_FALSE(ref == ObjectRef());
  ObjectLoan erased = orca::dont_care();
  CHECK(static_cast<MotionCommand*>(erased.get())->kind() == orca::idl::DONTCARE);
}

TEST_CASE("null views are empty and equal", "[idl][object]") {
  const ObjectPtr<MotionCommand> nothing;
  CHECK_FALSE(nothing);
  CHECK(nothing == nullptr);
  CHECK(nothing.get() == nullptr);
  const ObjectPtr<MotionCommand> copy = nothing;
  CHECK(copy == nothing);
}

TEST_CASE("a moved view leaves nothing behind, and assigning a view to itself keeps it", "[idl][object]") {
  ObjectPtr<MotionCommand> a = orca::full_stop();
  const ObjectPtr<MotionCommand> b = std::move(a);
  CHECK(a == nullptr);  // NOLINT(bugprone-use-after-move): that is the point.
  CHECK(b->kind() == orca::idl::FULLSTOP);
  ObjectPtr<MotionCommand> c = b;
  const ObjectPtr<MotionCommand>& alias = c;
  c = alias;
  CHECK(c.get() == b.get());
}

TEST_CASE("a pool grows when all its places are taken, and objects keep their values", "[idl][object]") {
  const std::size_t enough = pool_statistics(object_type<Odometry>()).capacity + 2000;
  std::vector<ObjectPtr<Odometry>> kept;
  for (std::size_t i = 0; i < enough; ++i) {
    auto odometry = make_object<Odometry>();
    odometry->seq(i);
    kept.push_back(std::move(odometry).seal());
  }
  CHECK(pool_statistics(object_type<Odometry>()).capacity >= enough);
  CHECK(pool_statistics(object_type<Odometry>()).live == enough);
  for (std::size_t i = 0; i < enough; ++i) REQUIRE(kept[i]->seq() == i);
  const std::size_t capacity = pool_statistics(object_type<Odometry>()).capacity;
  kept.clear();
  CHECK(pool_statistics(object_type<Odometry>()).live == 0);
  CHECK(pool_statistics(object_type<Odometry>()).capacity == capacity);
}

TEST_CASE("four threads make, share and drop objects without mixing them up", "[idl][object][threads]") {
  constexpr int kThreads = 4;
  constexpr int kRounds = 5000;
  std::mutex mutex;
  std::array<ObjectPtr<SonarRangeReadings>, 8> table;
  std::atomic<int> torn = 0;
  const auto work = [&](int thread) {
    for (int round = 0; round < kRounds; ++round) {
      auto loan = make_object<SonarRangeReadings>();
      loan->ranges().assign(16, thread * kRounds + round);
      ObjectPtr<SonarRangeReadings> mine = std::move(loan).seal();
      {
        const std::lock_guard lock(mutex);
        std::swap(mine, table[static_cast<std::size_t>(round) % table.size()]);
      }
      if (mine == nullptr) continue;
      const ObjectPtr<SonarRangeReadings> theirs = mine;
      const auto& ranges = theirs->ranges();
      if (ranges.size() != 16 || ranges.front() != ranges.back()) ++torn;
    }
  };
  const std::size_t before = pool_statistics(object_type<SonarRangeReadings>()).live;
  std::vector<std::jthread> threads;
  for (int i = 0; i < kThreads; ++i) threads.emplace_back(work, i);
  threads.clear();
  CHECK(torn == 0);
  CHECK(pool_statistics(object_type<SonarRangeReadings>()).live == before + table.size());
  table = {};
  CHECK(pool_statistics(object_type<SonarRangeReadings>()).live == before);
}

TEST_CASE("range readings without a stamp of their own were sensed when the sensor had its pose",
          "[idl][object]") {
  SonarRangeReadings sonar;
  sonar.creation_time().ns(9);
  const auto stamp = [&] {
    return object_type<SonarRangeReadings>().stamp(&sonar).time_since_epoch().count();
  };
  CHECK(stamp() == 9);  // Whoever does not set the pose's stamp keeps the creation time.
  sonar.pose().stamp().ns(7);
  CHECK(stamp() == 7);
}

TEST_CASE("an object of a derived type is seen as its parent, and as() gives it back", "[idl][object]") {
  auto loan = orca::make_object<orca::idl::Door>();
  loan->name() = "kitchen";
  loan->passable(true);
  const orca::ObjectPtr<orca::idl::Door> door = std::move(loan).seal();
  const orca::ObjectPtr<orca::idl::GoalPoint> goal = door;
  CHECK(goal->name() == "kitchen");
  CHECK(goal.ref() == door.ref());
  CHECK(goal.as<orca::idl::Door>() == door);
  CHECK(object_cast<orca::idl::GoalPoint>(door.ref()) == goal);
  const orca::ObjectPtr<orca::idl::GoalPoint> plain = orca::make_object<orca::idl::GoalPoint>();
  CHECK(plain.as<orca::idl::Door>() == nullptr);
  CHECK(orca::ObjectPtr<orca::idl::GoalPoint>().as<orca::idl::Door>() == nullptr);
}

TEST_CASE("copy_value of a view as the parent copies the whole object", "[idl][object]") {
  auto loan = orca::make_object<orca::idl::Door>();
  loan->door_width().distance(0.9);
  const orca::ObjectPtr<orca::idl::GoalPoint> goal = orca::Loan<orca::idl::GoalPoint>(std::move(loan));
  Loan<orca::idl::GoalPoint> copy = copy_value(goal);
  copy->name() = "other";
  const orca::ObjectPtr<orca::idl::GoalPoint> copied = std::move(copy);
  REQUIRE(copied.as<orca::idl::Door>());
  CHECK(copied.as<orca::idl::Door>()->door_width().distance() == 0.9);
  CHECK(copied->name() == "other");
  CHECK(goal->name().empty());
}
