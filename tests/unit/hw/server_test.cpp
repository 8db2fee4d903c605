// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of a hardware server: the five interfaces of a Scout's base (thesis 11.1, Fig. 11.3).
#include <catch2/catch.hpp>

#include "patient_executives.hpp"
#include "scout_base.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::HardwareState;

namespace {

class OnlySonar final : public hw::HardwareServer {
 public:
  explicit OnlySonar(ComponentHost& host)
      : HardwareServer(host, hw::Source::sensor, &object_type<idl::SonarRangeReadings>()) {}
};

}  // namespace

TEST_CASE("a base with sonars, odometry and wheels has five interfaces, named after what they carry",
          "[hw][server]") {
  run_on({}, [](Executive& executive) {
    ScoutBase base(executive);
    std::vector<std::string> ports;
    for (const auto& endpoint : base.bench.peer().endpoints()) {
      const PortContract& port = endpoint->contract();
      ports.push_back(port.name + ": " + to_string(port.pattern) + to_string(port.role) + " of " +
                      (port.reply ? port.reply->name : port.type.name));
    }
    CHECK(ports == std::vector<std::string>{"SonarRangeReadingsPush: PushServer of SonarRangeReadings",
                                            "SonarRangeReadingsQuery: QueryServer of SonarRangeReadings",
                                            "OdometryPush: PushServer of Odometry",
                                            "OdometryQuery: QueryServer of Odometry",
                                            "MotionCommandSend: SendServer of MotionCommand"});
  });
}

TEST_CASE("the other source's sensors are not offered", "[hw][server]") {
  class Truth final : public hw::HardwareServer {
   public:
    explicit Truth(ComponentHost& host) : HardwareServer(host, hw::Source::truth) {}
  };
  run_on({}, [](Executive& executive) {
    RunningScout robot(executive);
    hw::HardwareSeat seat(robot.scout);
    ComponentBench bench(executive, "truth", &seat);
    const Truth truth(bench);
    CHECK(bench.peer().endpoints().empty());
  });
}

TEST_CASE("without hardware a server has no ports, and cannot be configured", "[hw][server]") {
  run_on({}, [](Executive& executive) {
    ComponentBench bench(executive, "base", nullptr);
    Base server(bench);
    CHECK(bench.peer().endpoints().empty());
    const Status configured = server.configure();
    REQUIRE_FALSE(configured.ok());
    CHECK_THAT(configured.error().text(), Contains("binds no hardware"));
  });
}

EXECUTIVE_CASE(
    "subscribing starts the hardware, readings come with the server's header, and leaving stops it",
    "[hw][server]") {
  ScoutBase base(executive);
  base.run();
  REQUIRE(base.gets(HardwareState::ready));
  base.client.sonar.subscribe();
  base.client.odometry.subscribe();
  CHECK(base.gets(HardwareState::active));
  const auto sonar = base.client.sonar.get_update_wait_max(5s);
  const auto odometry = base.client.odometry.get_update_wait_max(5s);
  REQUIRE(sonar);
  REQUIRE(odometry);
  CHECK(sonar->ranges().size() == 16);
  CHECK(odometry->origin() == "base");
  CHECK(odometry->seq() == 1);
  base.client.sonar.unsubscribe();
  sleep(executive, 20ms);
  CHECK(base.robot.scout.state() == HardwareState::active);
  base.client.odometry.unsubscribe();
  CHECK(base.gets(HardwareState::ready));
}

PATIENT_CASE("a query to idle hardware starts it, waits for its first reading, and releases it again",
             "[hw][server]") {
  ScoutBase base(executive);
  base.run();
  const auto odometry = base.client.ask_odometry.query(make_object<idl::AskReading>(), 5s);
  REQUIRE(odometry.has_value());
  CHECK((*odometry)->x() >= 1.0);
  CHECK(base.gets(HardwareState::ready));
  CHECK(base.robot.diary.has("stop"));
}

EXECUTIVE_CASE("a query to running hardware is answered with its latest reading", "[hw][server]") {
  ScoutBase base(executive);
  base.run();
  base.client.sonar.subscribe();
  REQUIRE(base.client.sonar.get_update_wait_max(5s));
  REQUIRE(base.client.sonar.get_update_wait_max(5s));
  const auto odometry = base.client.ask_odometry.query(make_object<idl::AskReading>(), 5s);
  const auto sonar = base.client.ask_sonar.query(make_object<idl::AskReading>(), 5s);
  REQUIRE(odometry.has_value());
  REQUIRE(sonar.has_value());
  CHECK((*odometry)->x() >= 2.0);
  CHECK((*sonar)->ranges().size() == 16);
  CHECK((*sonar)->cause().origin() == "client");
}

EXECUTIVE_CASE("a query for a reading since some time gets the latest one, or learns that there is none yet",
               "[hw][server]") {
  ScoutBase base(executive);
  base.run();
  base.client.odometry.subscribe();
  const auto first = base.client.odometry.get_update_wait_max(5s);
  REQUIRE(first);
  const auto ask_since = [&](TimePoint since) {
    auto ask = make_object<idl::AskReading>();
    ask->since(to_time_value(since));
    return base.client.ask_odometry.query(std::move(ask), 5s);
  };
  const TimePoint sensed = to_time_point(first->stamp());
  const auto same_or_later = ask_since(sensed);
  REQUIRE(same_or_later.has_value());
  CHECK(to_time_point((*same_or_later)->stamp()) >= sensed);

  const TimePoint before = executive.now();
  const auto too_early = ask_since(before + 10s);
  REQUIRE_FALSE(too_early.has_value());
  CHECK(too_early.error().code == Code::unavailable);
  CHECK_THAT(too_early.error().text(),
             Contains("before the time that is asked for") && Contains("every 0.05 s"));
  if (executive.is_virtual()) CHECK(executive.now() == before);  // it holds up nothing
  CHECK(eventually(executive, [&] { return ask_since(before).has_value(); }));
}

EXECUTIVE_CASE("when the hardware fails, the server fails with its reason, and a query returns it",
               "[hw][server]") {
  std::atomic<bool> cable_on{true};
  ScoutBase base(
      executive,
      {{"poll", [&] { return cable_on ? ok() : Status(fail(Code::unavailable, "the cable is off")); }}});
  base.run();
  base.client.odometry.subscribe();
  REQUIRE(base.client.odometry.get_update_wait_max(5s));
  cable_on = false;
  CHECK(eventually(executive, [&] {
    return base.bench.diary().has("failed in work: the hardware failed: the cable is off");
  }));
  const TimePoint before = executive.now();
  const auto answer = base.client.ask_odometry.query(make_object<idl::AskReading>(), 10s);
  REQUIRE_FALSE(answer.has_value());
  CHECK(answer.error().code == Code::unavailable);
  CHECK_THAT(answer.error().text(), Contains("the cable is off"));
  if (executive.is_virtual()) CHECK(executive.now() - before < 100ms);
}

EXECUTIVE_CASE("hardware that does not start fails the server with the driver's reason", "[hw][server]") {
  ScoutBase base(executive, {{"start", [] { return Status(fail(Code::unavailable, "no answer")); }}});
  base.run();
  base.client.odometry.subscribe();
  CHECK(eventually(executive, [&] {
    return base.bench.diary().has("failed in start: the hardware does not start: no answer");
  }));
}

TEST_CASE("a server of one type offers the sensors that deliver it, and no others", "[hw][server]") {
  run_on({}, [](Executive& executive) {
    RunningScout robot(executive);
    hw::HardwareSeat seat(robot.scout);
    ComponentBench bench(executive, "sonar", &seat);
    const OnlySonar server(bench);
    std::vector<std::string> ports;
    for (const auto& endpoint : bench.peer().endpoints()) ports.push_back(endpoint->contract().name);
    CHECK(ports == std::vector<std::string>{"SonarRangeReadingsPush", "SonarRangeReadingsQuery"});
  });
}

PATIENT_CASE("two servers around one sensor hand out the same readings, each an object of its own",
             "[hw][server]") {
  RunningScout robot(executive);
  hw::SensorEndpoint& odometry = *robot.scout.sensors().at(1);
  const int first = 1;
  const int second = 2;
  std::vector<ObjectRef> one;
  std::vector<ObjectRef> other;
  const auto into = [](std::vector<ObjectRef>& list) {
    return [&list](ObjectLoan reading) { return list.emplace_back(std::move(reading).seal()); };
  };
  odometry.set_sink(&first, into(one));
  odometry.set_sink(&second, into(other));
  robot.scout.acquire();
  CHECK(robot.gets(HardwareState::active));
  sleep(executive, 300ms);
  odometry.set_sink(&first, nullptr);
  odometry.set_sink(&second, nullptr);
  REQUIRE(one.size() >= 2);
  REQUIRE(other.size() == one.size());
  CHECK(one.back().get() != other.back().get());
  CHECK(object_cast<idl::Odometry>(one.back())->x() == object_cast<idl::Odometry>(other.back())->x());
}
