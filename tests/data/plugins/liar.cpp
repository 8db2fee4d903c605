// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace {

using namespace std::chrono_literals;
using orca::idl::LaserRangeReadings;
using orca::idl::MotionCommand;
using orca::idl::Odometry;
using orca::idl::RobotPose;
using orca::idl::SonarRangeReadings;

/// Stands between a robot and those who drive it, and passes on what they say to each other. Each time that the robot drives
/// it turns what one port says into nonsense for a second, drawn by the seed: scans, rounds, odometry, poses or commands. It
/// reports how fast the robot was before, and the largest speed from half a second after the first wrong object on.
///
/// With a `fault` it does not lie: the robot has one thing wrong with it from 3 s on.
class Liar final : public orca::Component {
  template <class T>
  struct Relay {
    Relay(Liar& liar, const std::string& name)
        : in(liar, name, {.optional = true}), out(liar, name + "_out") {}
    orca::PushProxy<T> in;
    orca::PushServer<T> out;
  };
  enum class About { scan, round, odometry, pose, command, nothing };

 public:
  explicit Liar(orca::ComponentHost& host) : Component(host) {}

 private:
  static constexpr double kDrives = 0.25;           // [m/s]
  static constexpr orca::Duration kLie = 1s;        // how long it lies,
  static constexpr orca::Duration kAfter = 500ms;   // and from when on the robot must stand.
  static constexpr orca::Duration kPatience = 60s;  // with a robot that does not drive again

  orca::Status configure() override {
    stay_active(true);
    random_.emplace(random("lies"));
    std::vector<std::string> ports{"truth"};
    for_each_relay([&](const auto& relay, About /*about*/) {
      if (relay.in.connected()) ports.push_back(relay.in.name());
    });
    host().set_default_trigger({orca::Trigger::Kind::on_any, orca::Duration{0}, ports});
    return orca::ok();
  }

  orca::Status start() override {
    rested_at_ = now();
    return orca::ok();
  }

  orca::Outcome work() override {
    if (!sent_ && goto_.connected()) {
      auto goal = orca::make_object<orca::idl::GoalPoint>();
      goal->name() = "round and round";
      goal->coordinate().point().x(*x_);
      goal->coordinate().point().y(*y_);
      sent_ = goto_.send(std::move(goal)).ok();
    }
    look();
    for_each_relay([this](auto& relay, About about) { pass_on(relay, about); });
    if (told_ == *lies_) return orca::done();
    if (fault_->empty() && now() - rested_at_ > kPatience)
      return orca::failed("the robot does not drive any more");
    return orca::again();
  }

  // Follows the robot, and begins and ends the lies.
  void look() {
    while (truth_.new_data_arrived()) speed_ = std::abs(truth_.get_update()->translational_velocity());
    if (about_ == About::nothing) {
      if (fault_->empty() && speed_ > kDrives && now() - rested_at_ > 1s) begin();
      return;
    }
    if (!first_) return;
    if (now() - *first_ >= kAfter) fastest_ = std::max(fastest_, speed_);
    if (now() - *first_ >= kLie) end();
  }

  void begin() {
    std::vector<About> heard;
    for_each_relay([&](const auto& relay, About about) {
      if (relay.in.connected() && relay.out.subscriber_count() > 0) heard.push_back(about);
    });
    about_ = heard[(*random_)() % heard.size()];
    kind_ = (*random_)();
    before_ = speed_;
    fastest_ = 0.0;
    first_.reset();
  }

  void end() {
    char text[160];
    std::snprintf(text, sizeof text, "lie %d %s: %.3f m/s, then %.3f m/s", ++told_, what_.c_str(), before_,
                  fastest_);
    log_info(text);
    about_ = About::nothing;
    rested_at_ = now();
  }

  template <class T>
  void pass_on(Relay<T>& relay, About about) {
    while (relay.in.new_data_arrived()) {
      auto object = copy_value(relay.in.get_update());
      if (!fault_->empty() && now() > orca::TimePoint{3s}) break_something(*object);
      if (about_ == about) {
        spoil(*object);
        if (!first_) first_ = now();
      }
      relay.out.push(std::move(object));
    }
  }

  template <class Act>
  void for_each_relay(Act act) {
    act(laser_, About::scan);
    act(sonar_, About::round);
    act(odometry_, About::odometry);
    act(pose_, About::pose);
    act(motion_, About::command);
  }

  template <class T>
  void break_something(T& /*object*/) const {}
  void break_something(LaserRangeReadings& scan) const {
    if (*fault_ == "backwards") scan.angle_start(scan.angle_start() + std::numbers::pi);
    for (std::size_t i = 0; i < 10; ++i) {
      if (*fault_ == "posts") scan.ranges()[i] = 0.1;
      if (*fault_ == "covered") scan.ranges()[i] = -std::numeric_limits<double>::infinity();
    }
  }
  void break_something(SonarRangeReadings& round) const {
    if (*fault_ == "backwards") {  // only the array at the back is left
      constexpr std::ptrdiff_t kFront = 8;
      round.ranges().erase(round.ranges().begin(), round.ranges().begin() + kFront);
      round.poses().erase(round.poses().begin(), round.poses().begin() + kFront);
      round.stamps().erase(round.stamps().begin(), round.stamps().begin() + kFront);
    }
    if (*fault_ != "sonars_off") return;
    for (orca::idl::TimeValue& stamp : round.stamps()) stamp = orca::to_time_value(orca::TimePoint{3s});
  }

  // The same for all objects of one lie.
  [[nodiscard]] double no_number() const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double numbers[] = {std::nan(""), kInfinity, -kInfinity, 1e300};
    return numbers[(kind_ >> 32) % 4];
  }

  // Does one of several things to an object, and remembers its name.
  struct Way {
    const char* name;
    std::function<void()> spoil;
  };
  void one_of(const char* object, const std::vector<Way>& ways) {
    const Way& way = ways[kind_ % ways.size()];
    what_ = std::string(object) + " with " + way.name;
    way.spoil();
  }

  void spoil(LaserRangeReadings& scan) {
    const double nan = std::nan("");
    one_of(
        "scan",
        {{"no beams", [&] { scan.ranges().clear(); }},
         {"no number", [&] { std::ranges::fill(scan.ranges(), nan); }},
         {"no number ahead", [&] { std::fill(scan.ranges().begin() + 30, scan.ranges().end() - 30, nan); }},
         {"a number on one side only",
          [&] { std::fill(scan.ranges().begin() + 1, scan.ranges().end(), nan); }},
         {"all beams in one direction", [&] { scan.angle_increment(1e-310); }},
         {"a place in millimetres", [&] { scan.pose().position().x(210.0); }},
         {"ranges in millimetres",
          [&] {
            for (double& range : scan.ranges()) range *= 1000.0;
          }},
         {"a laser that looks up", [&] { scan.pose().rotation().pitch(-1.57); }},
         {"a laser that hangs upside down", [&] { scan.pose().rotation().roll(3.1416); }},
         {"a stamp of two seconds ago", [&] { scan.stamp(orca::to_time_value(now() - 2s)); }},
         {"an impossible increment", [&] { scan.angle_increment(no_number()); }},
         {"no increment", [&] { scan.angle_increment(0.0); }},
         {"an increment in degrees", [&] { scan.angle_increment(1.0); }},
         {"an impossible first angle", [&] { scan.angle_start(no_number()); }},
         {"an impossible time increment", [&] { scan.time_increment(no_number()); }},
         {"an impossible place", [&] { scan.pose().position().x(no_number()); }},
         {"an impossible direction", [&] { scan.pose().rotation().yaw(no_number()); }},
         {"no stamp", [&] { scan.stamp(orca::idl::TimeValue()); }},
         {"a stamp of tomorrow", [&] { scan.stamp(orca::to_time_value(now() + 24h)); }}},
        scan);
  }

  void spoil(SonarRangeReadings& round) {
    const double nan = std::nan("");
    one_of(
        "round",
        {{"no ranges", [&] { round.ranges().clear(); }},
         {"no number", [&] { std::ranges::fill(round.ranges(), nan); }},
         {"no number in front", [&] { std::fill(round.ranges().begin(), round.ranges().begin() + 8, nan); }},
         {"no poses", [&] { round.poses().clear(); }},
         {"impossible places",
          [&] {
            for (auto& pose : round.poses()) pose.position().y(no_number());
          }},
         {"impossible directions",
          [&] {
            for (auto& pose : round.poses()) pose.rotation().yaw(no_number());
          }},
         {"old stamps",
          [&] {
            for (auto& stamp : round.stamps()) stamp = orca::idl::TimeValue();
          }},
         {"stamps of tomorrow",
          [&] {
            for (auto& stamp : round.stamps()) stamp = orca::to_time_value(now() + 24h);
          }}},
        round);
  }

  // Any way, or one of the limits, which scans and rounds have in common.
  template <class Readings>
  void one_of(const char* object, std::vector<Way> ways, Readings& readings) {
    ways.push_back({"an impossible least range", [&] { readings.min_range(no_number()); }});
    ways.push_back({"an impossible largest range", [&] { readings.max_range(no_number()); }});
    ways.push_back({"a largest range in millimetres", [&] { readings.max_range(8000.0); }});
    ways.push_back({"a largest range of 0", [&] { readings.max_range(0.0); }});
    ways.push_back({"a largest range of almost 0", [&] { readings.max_range(1e-310); }});
    ways.push_back({"a negative least range", [&] { readings.min_range(-1.0); }});
    one_of(object, ways);
  }

  void spoil(Odometry& odometry) {
    one_of("odometry", {{"an impossible x", [&] { odometry.x(no_number()); }},
                        {"an impossible y", [&] { odometry.y(no_number()); }},
                        {"an impossible angle", [&] { odometry.steer_angle(no_number()); }},
                        {"an impossible speed", [&] { odometry.translational_velocity(no_number()); }},
                        {"an impossible sideways speed", [&] { odometry.sideways_velocity(no_number()); }},
                        {"an impossible turn rate", [&] { odometry.steering_velocity(no_number()); }},
                        {"a speed in thousands", [&] { odometry.translational_velocity(300.0); }},
                        {"an old stamp", [&] { odometry.stamp(orca::to_time_value(now() - 10s)); }},
                        {"a stamp of tomorrow", [&] { odometry.stamp(orca::to_time_value(now() + 24h)); }},
                        {"a negative variance", [&] { odometry.covariance()[4] = -1.0; }}});
  }

  void spoil(RobotPose& pose) {
    one_of("pose", {{"an impossible x", [&] { pose.x(no_number()); }},
                    {"an impossible y", [&] { pose.y(no_number()); }},
                    {"an impossible orientation", [&] { pose.orientation(no_number()); }},
                    {"an impossible speed", [&] { pose.translational_velocity(no_number()); }},
                    {"an impossible turn rate", [&] { pose.steering_velocity(no_number()); }},
                    {"an old stamp", [&] { pose.stamp(orca::to_time_value(now() - 10s)); }},
                    {"a stamp of tomorrow", [&] { pose.stamp(orca::to_time_value(now() + 24h)); }},
                    {"a covariance without a number", [&] { pose.covariance()[0] = std::nan(""); }}});
  }

  void spoil(MotionCommand& command) {
    const double nan = std::nan("");
    const double infinity = std::numeric_limits<double>::infinity();
    one_of("command", {{"no speed", [&] { command.speed(nan); }},
                       {"an infinite speed", [&] { command.speed(infinity); }},
                       {"no direction", [&] { command.direction(nan); }},
                       {"an infinite turn rate", [&] { command.turn_rate(-infinity); }},
                       {"no weight", [&] { command.weight(nan); }},
                       {"a negative weight", [&] { command.weight(-1.0); }}});
  }

  Relay<LaserRangeReadings> laser_{*this, "laser"};
  Relay<SonarRangeReadings> sonar_{*this, "sonar"};
  Relay<Odometry> odometry_{*this, "odometry"};
  Relay<RobotPose> pose_{*this, "pose"};
  Relay<MotionCommand> motion_{*this, "motion"};
  orca::PushProxy<RobotPose> truth_{*this, "truth"};
  orca::SendProxy<orca::idl::GoalPoint> goto_{
      *this, "goto", {.text = "Who drives; it is to circle around (x, y).", .optional = true}};
  orca::Param<std::int64_t> lies_{*this, "lies", 12, {.min = 1.0}};
  orca::Param<std::string> fault_{
      *this, "fault", "", {.choices = {"", "posts", "covered", "backwards", "sonars_off"}}};
  orca::Param<double> x_{*this, "x", 7.0, {.unit = "m"}};
  orca::Param<double> y_{*this, "y", 4.5, {.unit = "m"}};

  std::optional<orca::RandomStream> random_;
  About about_ = About::nothing;
  std::uint64_t kind_ = 0;
  std::string what_;
  int told_ = 0;
  bool sent_ = false;
  double speed_ = 0.0;
  double before_ = 0.0;
  double fastest_ = 0.0;
  std::optional<orca::TimePoint> first_;
  orca::TimePoint rested_at_{};
};

}  // namespace

ORCA_COMPONENT(Liar, "test.Liar")
