// SPDX-License-Identifier: GPL-3.0-or-later
// A container with several sensors that deliver one type: two lasers on one robot.
#include <catch2/catch.hpp>

#include "scout_base.hpp"

using namespace orca;
using namespace orca::test;
using hw::HardwareState;

namespace {

constexpr double kFront = 1.0;
constexpr double kRear = 2.0;

// Each laser sees something at a distance of its own.
class TwoLasers final : public hw::HardwareContainer {
 public:
  TwoLasers(hw::HardwareHost& host, double front, double rear)
      : HardwareContainer(host), front_range_(front), rear_range_(rear) {
    add_sensor(front_);
    add_sensor(rear_);
  }
  std::vector<HardwareFault> prepare() override { return {}; }
  [[nodiscard]] idl::Robot description() const override { return {}; }

 private:
  Status poll() override {
    next_poll_ = host().now() + 100ms;
    if (state() != HardwareState::active) return ok();
    publish(front_, front_range_);
    publish(rear_, rear_range_);
    return ok();
  }
  [[nodiscard]] TimePoint next_poll() const override { return next_poll_; }
  Status drive(const hw::DriveSetpoint&) override { return ok(); }

  void publish(hw::SensorHW<idl::LaserRangeReadings>& laser, double range) {
    auto scan = laser.loan();
    scan->ranges().assign(3, range);
    scan->stamp(to_time_value(host().now()));
    laser.publish(std::move(scan));
  }

  const double front_range_;
  const double rear_range_;
  hw::SensorHW<idl::LaserRangeReadings> front_{100ms, hw::Source::sensor, "front"};
  hw::SensorHW<idl::LaserRangeReadings> rear_{100ms, hw::Source::sensor, "rear"};
  TimePoint next_poll_{};
};

class LaserClient final : public Peer {
 public:
  explicit LaserClient(Executive& executive) : Peer(executive, "client") {}
  PushProxy<idl::LaserRangeReadings> front{*this, "front"};
  PushProxy<idl::LaserRangeReadings> rear{*this, "rear"};
  QueryProxy<idl::AskReading, idl::LaserRangeReadings> ask_rear{*this, "ask_rear"};
};

// Two lasers, a server around them and a client of both; the lasers run.
struct Lasers {
  explicit Lasers(Executive& used, double front = kFront, double rear = kRear)
      : executive(used),
        host(used, diary),
        lasers(host, front, rear),
        seat(lasers),
        bench(used, "lasers", &seat),
        server(bench),
        client(used) {
    CHECK(LocalLinks().connect(port("front_LaserRangeReadingsPush"), client.endpoint("front")).ok());
    CHECK(LocalLinks().connect(port("rear_LaserRangeReadingsPush"), client.endpoint("rear")).ok());
    CHECK(LocalLinks().connect(client.endpoint("ask_rear"), port("rear_LaserRangeReadingsQuery")).ok());
    CHECK(server.configure().ok());
    bench.peer().open();
    lasers.run();
    service = std::make_unique<Script>(bench.peer(), [this] { bench.run(server); });
  }
  ~Lasers() {
    service.reset();
    lasers.shut_down();
    CHECK(lasers.join_until(executive.now() + 5s));
  }
  [[nodiscard]] Endpoint& port(const std::string& name) { return bench.peer().endpoint(name); }

  Executive& executive;
  Diary diary;
  FakeHardwareHost host;
  TwoLasers lasers;
  hw::HardwareSeat seat;
  ComponentBench bench;
  Base server;
  LaserClient client;
  std::unique_ptr<Script> service;
};

}  // namespace

TEST_CASE("where two devices deliver one type, the names of their ports begin with those of the devices",
          "[hw][server]") {
  run_on({}, [](Executive& executive) {
    Lasers robot(executive);
    std::vector<std::string> ports;
    for (const auto& endpoint : robot.bench.peer().endpoints()) ports.push_back(endpoint->contract().name);
    CHECK(ports == std::vector<std::string>{"front_LaserRangeReadingsPush", "front_LaserRangeReadingsQuery",
                                            "rear_LaserRangeReadingsPush", "rear_LaserRangeReadingsQuery"});
  });
}

EXECUTIVE_CASE("each port brings the readings of its own device", "[hw][server]") {
  Lasers robot(executive);
  robot.client.front.subscribe();
  robot.client.rear.subscribe();
  const auto front = robot.client.front.get_update_wait_max(5s);
  const auto rear = robot.client.rear.get_update_wait_max(5s);
  REQUIRE(front);
  REQUIRE(rear);
  CHECK(front->ranges().at(0) == kFront);
  CHECK(rear->ranges().at(0) == kRear);
  const auto asked = robot.client.ask_rear.query(make_object<idl::AskReading>(), 5s);
  REQUIRE(asked.has_value());
  CHECK((*asked)->ranges().at(0) == kRear);
}

EXECUTIVE_CASE(
    "a driver that takes the place of another one connects each of its devices with the ports of that name",
    "[hw][seat]") {
  Lasers robot(executive);
  robot.client.rear.subscribe();
  REQUIRE(robot.client.rear.get_update_wait_max(5s));
  robot.seat.pause("a test");
  robot.lasers.shut_down();
  REQUIRE(robot.lasers.join_until(executive.now() + 5s));

  TwoLasers others(robot.host, 10.0 * kFront, 10.0 * kRear);
  others.run();
  robot.seat.resume(others, {});
  CHECK(eventually(executive, [&] { return robot.client.rear.latest()->ranges().at(0) == 10.0 * kRear; }));
  robot.seat.pause("the end of the test");
  others.shut_down();
  CHECK(others.join_until(executive.now() + 5s));
  robot.seat.resume(robot.lasers, {});
}
