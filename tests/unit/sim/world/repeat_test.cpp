// SPDX-License-Identifier: GPL-3.0-or-later
// Fresh worlds repeat bit by bit: all kinds of bases and sensors, people, and an obstacle that comes and
// goes.
#include <catch2/catch.hpp>

#include <bit>

#include "orca/base/hash.hpp"
#include "orca/base/random.hpp"
#include "orca/sim/world.hpp"
#include "shipped.hpp"

using namespace orca::sim;
using orca::Pose2;
using namespace orca::sim::test;

namespace {

const std::vector<std::string> kTypes{"nomad_scout", "pioneer_2dx", "peoplebot",
                                      "barn_base",   "nomad_200",   "omni"};
const std::vector<Pose2> kStarts{{1.0, 3.0, 0.5},  {1.0, 4.5, 0.0},   {1.0, 6.0, -0.5},
                                 {13.2, 3.0, 3.0}, {13.2, 4.5, -2.5}, {13.2, 6.0, 2.5}};
constexpr int kTicksPerMinute = 6000;

// A crowd of robots that drive at random among people, into them and into each other.
class Crowd {
 public:
  explicit Crowd(std::uint64_t seed, unsigned threads = 1)
      : world_(shipped_world("crowd"), {.seed = seed, .realism = Realism::nominal, .threads = threads}) {
    for (std::size_t i = 0; i < kTypes.size(); ++i) {
      const auto id = world_.add_robot(kTypes[i], shipped(kTypes[i]), kStarts[i]);
      REQUIRE(id);
      robots_.push_back(*id);
    }
  }

  // Returns the hash of all states, contacts and readings of that many minutes.
  std::uint64_t run(int minutes) {
    for (int tick = 0; tick < minutes * kTicksPerMinute; ++tick) {
      if (tick % 200 == 0) drive();
      if (tick % 3000 == 1500) put_crate();
      if (tick % 3000 == 2500) take_crate();
      world_.step();
      see();
    }
    return seen_.value();
  }

  [[nodiscard]] std::size_t touches() const { return touches_; }

 private:
  void drive() {
    for (const RobotId id : robots_)
      REQUIRE(world_.set_velocity_command(id, commands_.uniform(-0.3, 0.7), commands_.uniform(-1.0, 1.0)));
    REQUIRE(world_.set_turret_command(robots_[4], commands_.uniform(-3.0, 3.0)));
  }
  // Puts a crate at a random place. It is refused where a robot stands, and that must repeat, too.
  void put_crate() {
    const Pose2 place{commands_.uniform(2.0, 12.0), commands_.uniform(2.0, 7.0), 0.3};
    const auto crate = world_.add_obstacle("crate", Box{{}, {0.3, 0.3}}, 0.5, place);
    if (crate) crate_ = *crate;
  }
  void take_crate() {
    if (crate_) REQUIRE(world_.remove_obstacle(*crate_));
    crate_.reset();
  }

  void see() {
    touches_ += world_.contacts().size();
    seen_.add_u64(world_.state_hash());
    for (const ContactEvent& contact : world_.contacts()) seen_.add_text(contact.robot + " " + contact.other);
    for (const RobotId id : robots_) see(id);
  }
  void see(RobotId id) {
    const RobotModel& model = world_.robot_model(id);
    if (!model.sonars.empty() && world_.sonar(id))
      for (const SonarReading& r : world_.sonar(id)->readings) add(r.stamp, {r.range, r.echo ? 1.0 : 0.0});
    if (!model.lasers.empty() && world_.laser(id)) add(world_.laser(id)->stamp, world_.laser(id)->ranges);
    if (!model.infrareds.empty() && world_.infrared(id))
      add(world_.infrared(id)->stamp, world_.infrared(id)->ranges);
    if (!model.bumpers.empty() && world_.bumper(id))
      for (const bool pressed : world_.bumper(id)->pressed)
        add(world_.bumper(id)->stamp, {pressed ? 1.0 : 0.0});
    if (const auto& turret = world_.turret(id)) add(world_.time(), {turret->angle, turret->turn_rate});
    if (const auto& odometry = world_.odometry(id))
      add(odometry->stamp, {odometry->pose.x, odometry->velocity.forward, odometry->velocity.turn_rate});
  }
  void add(orca::TimePoint stamp, const std::vector<double>& values) {
    seen_.add_u64(static_cast<std::uint64_t>(stamp.time_since_epoch().count()));
    for (const double value : values) seen_.add_u64(std::bit_cast<std::uint64_t>(value));
  }

  World world_;
  std::vector<RobotId> robots_;
  std::optional<ObstacleId> crate_;
  orca::RandomStream commands_{11, "test", "commands"};
  orca::Fnv1a seen_;
  std::size_t touches_ = 0;
};

// Checks that fresh worlds with other numbers of threads go through the same simulated minutes.
void check_repeats(int worlds, int minutes) {
  Crowd first(1);
  const std::uint64_t expected = first.run(minutes);
  CHECK(first.touches() > 10 * static_cast<std::size_t>(minutes));
  for (int world = 1; world < worlds; ++world) {
    CAPTURE(world);
    // Makes memory addresses differ from those of the run before.
    const std::vector<char> gap(static_cast<std::size_t>(1000 * world));
    Crowd again(1, static_cast<unsigned>(world % 4));
    CHECK(again.run(minutes) == expected);
  }
}

}  // namespace

TEST_CASE("fresh worlds are bit-identical through a simulated minute of six robots in a crowd",
          "[sim][repeat]") {
  check_repeats(3, 1);
}

TEST_CASE("twenty fresh worlds are bit-identical through ten such minutes", "[.][slow]") {
  check_repeats(20, 10);
}

TEST_CASE("another seed is another run", "[sim][repeat]") { CHECK(Crowd(1).run(1) != Crowd(2).run(1)); }
