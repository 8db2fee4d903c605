// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of the Synchronizer for objects that were sensed at one moment, for every link.
#include "link_kits.hpp"
#include "orca/idl/time.hpp"

using namespace orca;
using namespace orca::test;
using idl::LaserRangeReadings;
using idl::Odometry;

namespace {

constexpr Duration kWithin = 10ms;

// A device that says itself when it has sensed.
template <class T>
struct Sensor : Peer {
  using Peer::Peer;
  void push(Duration stamp) {
    Loan<T> object = out.loan();
    object->stamp(to_time_value(TimePoint(stamp)));
    out.push(std::move(object));
  }
  PushServer<T> out{*this, "out"};
};

// Receives scans of two lasers, of which the second has a port array, and odometry.
struct Mapper : Peer {
  explicit Mapper(Executive& executive) : Peer(executive, "mapper") {
    both.add(laser);
    both.add(odometry);
  }
  PushProxy<LaserRangeReadings> laser{*this, "laser"};
  PushProxy<Odometry> odometry{*this, "odometry"};
  PushProxyArray<LaserRangeReadings> others{*this, "others"};
  Synchronizer both;
};

template <class T>
Duration stamp_of(const ObjectPtr<T>& object) {
  return object ? to_time_point(object->stamp()).time_since_epoch() : Duration{-1};
}

template <class Kit>
struct MappingRobot {
  explicit MappingRobot(Kit& kit) : executive(kit.executive), mapper(kit.executive) {
    const QueuePolicy policy{.depth = 8};
    kit.connect(laser.endpoint("out"), mapper.endpoint("laser"), policy);
    kit.connect(base.endpoint("out"), mapper.endpoint("odometry"), policy);
    kit.connect(left.endpoint("out"), mapper.endpoint("others"), policy);
    kit.connect(right.endpoint("out"), mapper.endpoint("others"), policy);
    mapper.laser.subscribe();
    mapper.odometry.subscribe();
    CHECK(eventually(executive,
                     [&] { return laser.out.subscriber_count() == 1 && base.out.subscriber_count() == 1; }));
  }

  // These push and wait until the objects have arrived.
  void scan(std::initializer_list<Duration> stamps) { push(laser, "laser", stamps); }
  void move(std::initializer_list<Duration> stamps) { push(base, "odometry", stamps); }

  // Takes one object of each, as a component does once they match.
  void take(Duration scanned, Duration moved) {
    CHECK(stamp_of(mapper.laser.get_update()) == scanned);
    CHECK(stamp_of(mapper.odometry.get_update()) == moved);
  }

  Executive& executive;
  Sensor<LaserRangeReadings> laser{executive, "laser"};
  Sensor<Odometry> base{executive, "base"};
  Sensor<LaserRangeReadings> left{executive, "left"};
  Sensor<LaserRangeReadings> right{executive, "right"};
  Mapper mapper;

 private:
  template <class T>
  void push(Sensor<T>& sensor, const char* port, std::initializer_list<Duration> stamps) {
    const PushEdge& edge = *mapper.edges(port).front();
    for (const Duration stamp : stamps) {
      const std::uint64_t before = edge.counters().delivered;
      sensor.push(stamp);
      CHECK(eventually(executive, [&] { return edge.counters().delivered == before + 1; }));
    }
  }
};

}  // namespace

CONTRACT_CASE("objects belong together by their stamps, whenever they arrive", "[contract][synchronizer]") {
  MappingRobot robot(kit);
  Script script(robot.mapper, [&] { robot.mapper.both.wait_matching(kWithin); });
  robot.move({100ms, 150ms, 200ms});
  CHECK_FALSE(script.ends_within(10ms));
  robot.scan({155ms});
  REQUIRE(script.ends_within(5s));
  robot.take(155ms, 150ms);
  CHECK(stamp_of(robot.mapper.odometry.get_update()) == 200ms);  // it may match the next scan
}

CONTRACT_CASE("objects that match nothing are dropped and counted, until two belong together",
              "[contract][synchronizer]") {
  MappingRobot robot(kit);
  Mapper& mapper = robot.mapper;
  robot.move({100ms, 200ms});
  robot.scan({120ms, 180ms});
  CHECK_FALSE(mapper.both.wait_matching(kWithin, 5ms));
  CHECK_FALSE(mapper.laser.new_data_arrived());
  CHECK(mapper.odometry.new_data_arrived());
  robot.scan({195ms});
  CHECK(mapper.both.wait_matching(kWithin, 5s));
  CHECK(mapper.laser.counters().unmatched == 2);
  CHECK(mapper.laser.counters().dropped == 2);
  CHECK(mapper.laser.counters().over_limit == 0);
  CHECK(mapper.odometry.counters().unmatched == 1);
  robot.take(195ms, 200ms);
}

CONTRACT_CASE("stamps may differ by the tolerance and no more", "[contract][synchronizer]") {
  MappingRobot robot(kit);
  robot.scan({100ms, 200ms});
  robot.move({110ms});
  CHECK(robot.mapper.both.wait_matching(kWithin, 5s));
  robot.take(100ms, 110ms);
  robot.move({200ms + kWithin + 1ns});
  CHECK_FALSE(robot.mapper.both.wait_matching(kWithin, 1ms));
  robot.scan({200ms + kWithin});
  CHECK(robot.mapper.both.wait_matching(Duration{1}, 5s));
  CHECK_FALSE(robot.mapper.both.wait_matching(Duration{0}, 1ms));
}

CONTRACT_CASE("of all that match, the earliest come first; none is taken by waiting",
              "[contract][synchronizer]") {
  MappingRobot robot(kit);
  robot.scan({100ms, 200ms, 300ms});
  robot.move({95ms, 205ms, 300ms});
  for (const auto& [scanned, moved] : {std::pair{100ms, 95ms}, {200ms, 205ms}, {300ms, 300ms}}) {
    robot.mapper.both.wait_to_fuse(Fusing::stamps, kWithin);
    robot.mapper.both.wait_to_fuse(Fusing::stamps, kWithin);
    robot.take(scanned, moved);
  }
  CHECK_FALSE(robot.mapper.both.wait_matching(kWithin, 1ms));
}

CONTRACT_CASE("the servers of a port array match too, those that it is subscribed to",
              "[contract][synchronizer]") {
  MappingRobot robot(kit);
  Mapper& mapper = robot.mapper;
  mapper.both.add(mapper.others);
  robot.scan({100ms});
  robot.move({100ms});
  CHECK_FALSE(mapper.both.wait_matching(kWithin, 1ms));
  mapper.others.sources().front().subscribe();
  CHECK(eventually(kit.executive, [&] { return robot.left.out.subscriber_count() == 1; }));
  robot.left.push(90ms);
  CHECK(mapper.both.wait_matching(kWithin, 5s));
  robot.left.push(80ms);
  mapper.others.sources().back().subscribe();
  CHECK(eventually(kit.executive, [&] { return robot.right.out.subscriber_count() == 1; }));
  robot.right.push(101ms);
  CHECK_FALSE(mapper.both.wait_matching(kWithin, 20ms));
  CHECK(mapper.laser.new_data_arrived());
  robot.left.push(102ms);
  CHECK(mapper.both.wait_matching(kWithin, 5s));
}

CONTRACT_CASE("a stamp that is out of all bounds holds nothing up for ever", "[contract][synchronizer]") {
  MappingRobot robot(kit);
  robot.scan({Duration::min(), Duration::max()});
  robot.move({100ms});
  CHECK_FALSE(robot.mapper.both.wait_matching(kWithin, 1ms));
  // The edge has room for eight: the wrong one makes room at last.
  robot.scan({110ms, 120ms, 130ms, 140ms, 150ms, 160ms, 170ms, 180ms});
  robot.move({160ms});
  CHECK(robot.mapper.both.wait_matching(Duration{0}, 5s));
  robot.take(160ms, 160ms);
}

CONTRACT_CASE("a lap that has only dropped what matches nothing can be abandoned without loss",
              "[contract][synchronizer]") {
  MappingRobot robot(kit);
  robot.move({100ms, 110ms});
  robot.scan({500ms});
  const std::uint64_t activity = robot.mapper.strand().activity();
  CHECK_FALSE(robot.mapper.both.wait_matching(kWithin, 1ms));
  CHECK(robot.mapper.odometry.counters().unmatched == 2);
  CHECK(robot.mapper.strand().activity() == activity);
}

CONTRACT_CASE("an object without a stamp counts from when it was made", "[contract][synchronizer]") {
  if (!kit.executive.is_virtual()) return;  // only there the times are exact
  Source source(kit.executive);
  Listener listener(kit.executive);
  Sensor<Odometry> base(kit.executive, "base");
  struct Pair : Peer {
    using Peer::Peer;
    PushProxy<MotionCommand> command{*this, "command"};
    PushProxy<Odometry> odometry{*this, "odometry"};
  } pair(kit.executive, "pair");
  kit.connect(source.endpoint("out"), pair.endpoint("command"), {.depth = 4});
  kit.connect(base.endpoint("out"), pair.endpoint("odometry"), {.depth = 4});
  pair.command.subscribe();
  pair.odometry.subscribe();
  Synchronizer both;
  both.add(pair.command);
  both.add(pair.odometry);
  sleep(kit.executive, 50ms);
  source.push_numbers(1, 1);
  const Duration made = kit.executive.now().time_since_epoch();
  base.push(made - 1ms);
  CHECK_FALSE(both.wait_matching(Duration{0}, 1ms));
  base.push(made);
  CHECK(both.wait_matching(Duration{0}, 1ms + TestType::kDelay));
}
