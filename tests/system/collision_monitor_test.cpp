// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that nobody keeps off what stands in its way, with a CollisionMonitor before its wheels and without.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <sstream>

#include "batches.hpp"
#include "orca/base/random.hpp"
#include "orca/geometry/vec2.hpp"
#include "shipped_graph.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::test;

namespace {

constexpr double kStart = 1.5;      // [m] x of the place at which the robot begins
constexpr double kY = 3.0;          // [m]
constexpr double kAppears = 5.0;    // [s]
constexpr double kReaction = 0.3;   // [s] of the gate 0.15, and of the base: lag and dead time
constexpr double kEmergency = 3.0;  // [m/s2] of the Pioneer's emergency stop
constexpr double kHarmless = 0.1;   // [m/s]
const Words kSpeeds{"0.2", "0.3", "0.4", "0.5", "0.6", "0.7", "0.8", "0.9", "1.0"};

// A solid of a robot as its file has it, seen from above: a rectangle, or a circle around the origin.
struct Plan {
  double front;  // [m]
  double side;   // [m]
  bool is_round = false;
  // Returns how far it reaches ahead beside its middle [m]. @pre  it reaches that far aside.
  [[nodiscard]] double ahead(double aside) const {
    return is_round ? std::sqrt(front * front - aside * aside) : front;
  }
};

// A robot that is driven, and the period of the sensors of its gate.
struct Driven {
  std::string file;
  std::string profile;
  double period;  // [s]
  std::vector<Plan> body;
};
const Driven kPioneer{
    "pioneer_2dx.urdf", "gate", 0.1, {{0.211, 0.07}, {0.187, 0.1}, {0.143, 0.153}, {0.0825, 0.2125}}};
const Driven kScout{"nomad_scout.urdf", "sonars", 0.2, {{0.205, 0.205, true}}};

std::string hall(const std::string& content) {
  return "<world name='hall' version='1' text='A hall'><room name='hall' from='0 0' to='17 6'/>"
         "<place name='start' x='1.5' y='3'/>" +
         content + "</world>";
}

std::string world_element(const std::string& name, const std::string& file, const std::string& speed) {
  return "<world name='" + name + "'><set arg='world' file='" + file + "'/><set arg='speed' value='" + speed +
         " m/s'/></world>";
}

std::string variant(const std::string& profile, const Driven& robot) {
  return "<variant name='" + profile + "' profile='" + profile + "'><set arg='robot' file='" +
         source_file("sim/robots/" + robot.file) + "'/></variant>";
}

std::string experiment(const std::string& variants, const std::string& until, const std::string& worlds) {
  return "<experiment name='sudden' seeds='1' until='" + until + "' graph='" + system_graph("sudden.xml") +
         "'>" + variants + worlds + "</experiment>";
}

using Row = std::map<std::string, std::string>;

std::vector<std::string> split(const std::string& line, char mark) {
  std::vector<std::string> words;
  std::istringstream in(line + mark);
  for (std::string word; std::getline(in, word, mark);) words.push_back(word);
  return words;
}

std::vector<Row> rows_of(const std::string& csv) {
  std::vector<Row> rows;
  const std::vector<std::string> lines = split_lines(csv);
  const std::vector<std::string> names = split(lines.at(0), ',');
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const std::vector<std::string> values = split(lines[i], ',');
    Row row;
    for (std::size_t k = 0; k < std::min(names.size(), values.size()); ++k) row[names[k]] = values[k];
    rows.push_back(std::move(row));
  }
  return rows;
}

double number(const Row& row, const std::string& column) {
  return row.at(column).empty() ? 0.0 : std::stod(row.at(column));
}

// A box or a cylinder that appears in front of the robot.
struct Surprise {
  std::string speed;
  bool is_round;
  double x, y, length, width, yaw;

  [[nodiscard]] std::string element() const {
    std::ostringstream text;
    text << (is_round ? "<cylinder" : "<box") << " name='thing' x='" << x << "' y='" << y << "' ";
    if (is_round) text << "radius='" << 0.5 * length << "'";
    if (!is_round) text << "length='" << length << "' width='" << width << "' yaw='" << yaw << "'";
    text << " height='1 m' comes='" << kAppears << " s'/>";
    return text.str();
  }
  // Returns its outline, a point each few millimetres.
  [[nodiscard]] std::vector<Vec2> outline() const {
    std::vector<Vec2> points;
    for (int i = 0; i < 720; ++i) {
      const double angle = i * std::numbers::pi / 360;
      Vec2 p = 0.5 * length * direction(angle);
      if (!is_round) {
        const Vec2 d = direction(angle);
        const double out = std::min(0.5 * length / std::max(std::abs(d.x), 1e-9),
                                    0.5 * width / std::max(std::abs(d.y), 1e-9));
        p = rotated(out * d, yaw);
      }
      points.push_back(Vec2{x, y} + p);
    }
    return points;
  }
  // Returns how far a robot at an x can drive straight on until it touches it [m]; infinity: for ever.
  [[nodiscard]] double free_way(double from, const Driven& robot) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Vec2 p : outline())
      for (const Plan& part : robot.body)
        if (std::abs(p.y - kY) < part.side) least = std::min(least, p.x - from - part.ahead(p.y - kY));
    return least;
  }
};

// Returns how far robots of each speed are from the start when things appear [m].
std::map<std::string, double> ways_until_then(const TempFolder& folder, const Driven& robot) {
  std::string worlds;
  const std::string file = folder.write("empty.xml", hall(""));
  for (std::size_t i = 0; i < kSpeeds.size(); ++i)
    worlds += world_element("v" + std::to_string(i), file, kSpeeds[i]);
  const std::string table = batch(
      folder.write("ways.xml", experiment(variant("none", robot), std::to_string(kAppears) + " s", worlds)),
      folder.file("ways.batch"));
  std::map<std::string, double> ways;
  for (const Row& row : rows_of(table))
    ways[kSpeeds[std::stoul(row.at("world").substr(1))]] = number(row, "way");
  REQUIRE(ways.size() == kSpeeds.size());
  return ways;
}

Surprise draw(RandomStream& random, const std::map<std::string, double>& ways, double front) {
  Surprise thing;
  thing.speed =
      kSpeeds[static_cast<std::size_t>(random.uniform(0.0, 0.999) * static_cast<double>(kSpeeds.size()))];
  thing.is_round = random.uniform(0.0, 1.0) < 0.4;
  thing.length = random.uniform(0.05, 0.6);
  thing.width = random.uniform(0.05, 0.6);
  thing.yaw = random.uniform(0.0, std::numbers::pi);
  thing.y = kY + random.uniform(-0.35, 0.35);
  const double reach = thing.is_round ? 0.5 * thing.length : 0.5 * norm({thing.length, thing.width});
  thing.x = kStart + ways.at(thing.speed) + front + random.uniform(0.03, 1.2) + reach;
  return thing;
}

// Things of which each appears before a robot of its own, and the runs with the gate and without.
struct Campaign {
  Campaign(const TempFolder& folder, const Driven& driven, std::size_t count)
      : robot(driven), ways(ways_until_then(folder, driven)) {
    RandomStream random(52, "test", "surprises");
    std::string worlds;
    for (std::size_t i = 0; i < count; ++i) {
      things.push_back(draw(random, ways, robot.body[0].front));
      const std::string name = "w" + std::to_string(i);
      worlds += world_element(name, folder.write(name + ".xml", hall(things.back().element())),
                              things.back().speed);
    }
    const std::string variants = variant(robot.profile, robot) + variant("none", robot);
    const std::string table =
        batch(folder.write("sudden.xml", experiment(variants, "13 s", worlds)), folder.file("sudden.batch"));
    for (const Row& row : rows_of(table))
      runs[row.at("variant")][std::stoul(row.at("world").substr(1))] = row;
    REQUIRE(runs[robot.profile].size() == count);
    REQUIRE(runs["none"].size() == count);
  }
  // Returns how far the robot could drive on when the thing appeared [m].
  [[nodiscard]] double free_way(std::size_t i) const {
    return things[i].free_way(kStart + ways.at(things[i].speed), robot);
  }
  // Returns whether a robot that does what it can comes to rest before the thing.
  [[nodiscard]] bool can_stop(std::size_t i) const {
    const double v = std::stod(things[i].speed);
    return free_way(i) >= v * (robot.period + kReaction) + 0.5 * v * v / kEmergency;
  }
  // Returns the speed at which it touches the thing [m/s]; nothing if it does not.
  [[nodiscard]] std::optional<double> impact(const std::string& variant, std::size_t i) const {
    const Row& row = runs.at(variant).at(i);
    if (number(row, "contacts") == 0.0) return std::nullopt;
    return number(row, "impact_speed");
  }

  const Driven& robot;
  std::map<std::string, double> ways;
  std::vector<Surprise> things;
  std::map<std::string, std::map<std::size_t, Row>> runs;  // by variant
};

Run drive(const TempFolder& folder, const std::string& things, const Words& more) {
  return run_deployer(Words{system_graph("sudden.xml"), "--set",
                            "world=" + folder.write("world.xml", hall(things)), "--until", "16 s"} +
                      more + virtual_clock());
}

// The account of a gate, of all the times that it worked.
struct Account {
  double way = 0.0;     // [m]
  double wanted = 0.0;  // [s] of commands
  int stops = 0;
  double changed = 0.0;  // [s] stopped or slowed

  void add(const Run& run) {
    for (const std::string& line : split_lines(run.err)) {
      const std::size_t begin = line.find("gate: in ");
      double m = 0.0, s = 0.0, stopped = 0.0, slowed = 0.0;
      int count = 0;
      if (begin == std::string::npos ||
          std::sscanf(line.c_str() + begin,
                      "gate: in %lf m and %lf s of commands: %d stops, %lf s stopped, %lf s slowed", &m, &s,
                      &count, &stopped, &slowed) != 5)
        continue;
      way += m, wanted += s, stops += count, changed += stopped + slowed;
    }
  }
};

// Returns a shipped graph without a gate, with one.
std::string with_gate(const std::string& name, const std::string& sensor) {
  ShippedGraph graph(name);
  std::string text = graph.text();
  const std::string direct = "<connect from=\"fuser.base\" to=\"base.MotionCommandSend\"/>";
  const std::size_t at = text.find(direct);
  REQUIRE(at != std::string::npos);
  text.replace(at, direct.size(),
               "<component name=\"gate\" type=\"orca.CollisionMonitor\"><param name=\"robot\" "
               "value=\"${robot}\"/></component>"
               "<connect from=\"fuser.base\" to=\"gate.MotionCommandSend\"/>"
               "<connect from=\"gate.base\" to=\"base.MotionCommandSend\"/>"
               "<connect from=\"base.OdometryPush\" to=\"gate.odometry\" queue=\"16\"/>" +
                   sensor);
  return text;
}

const std::string kLaser = "<connect from=\"laser.LaserRangeReadingsPush\" to=\"gate.lasers\"/>";
const std::string kSonars = "<connect from=\"base.SonarRangeReadingsPush\" to=\"gate.sonars\"/>";

}  // namespace

TEST_CASE(
    "a robot that others keep off things is hardly ever stopped or slowed down: once in 100 m and in 3 % of "
    "the time at most",
    "[system][gate]") {
  const std::map<std::string, std::string> sensors{
      {"pioneer_laser_goto", kLaser}, {"pioneer_planner", kLaser}, {"scout_goto", kSonars}};
  const int seeds = part_of(10);
  for (const auto& [name, sensor] : sensors) {
    CAPTURE(name);
    const TempFolder folder;
    const std::string graph = folder.write("graph.xml", with_gate(name, sensor));
    Account office, field;
    for (int seed = 1; seed <= seeds; ++seed) {
      const Words common =
          Words{graph, "--log", "debug", "--until", "150 s", "--seed", std::to_string(seed)} +
          virtual_clock();
      const Run rooms = run_deployer(common);
      CHECK(rooms.arrivals().size() == 3);
      CHECK(rooms.contacts().empty());
      office.add(rooms);
      if (sensor == kSonars) continue;
      field.add(run_deployer(
          common + Words{"--set",
                         "world=" + source_file("sim/worlds/barn_like.xml") + "#" + std::to_string(seed),
                         "--set", "goals=goal: -2.25 13"}));
    }
    std::printf(
        "%s: in the office %.0f m, %d stops, %.1f of %.0f s changed; among cylinders %.0f m, %d stops, %.1f "
        "of %.0f s\n",
        name.c_str(), office.way, office.stops, office.changed, office.wanted, field.way, field.stops,
        field.changed, field.wanted);
    CHECK(office.way > 30.0 * seeds);
    CHECK(office.stops <= office.way / 100.0);
    CHECK(office.changed <= 0.03 * office.wanted);
    CHECK(field.stops <= field.way / 100.0);
    CHECK(field.changed <= 0.03 * field.wanted);
  }
}

namespace {

// How a campaign went.
struct Outcome {
  explicit Outcome(const Campaign& campaign) {
    for (std::size_t i = 0; i < campaign.things.size(); ++i) {
      const bool is_stopped = campaign.can_stop(i), is_there = std::isfinite(campaign.free_way(i));
      const auto with = campaign.impact(campaign.robot.profile, i), without = campaign.impact("none", i);
      in_the_way += is_there ? 1 : 0;
      stoppable += is_there && is_stopped ? 1 : 0;
      hit += with >= kHarmless ? 1 : 0;
      hit_without += without >= kHarmless ? 1 : 0;
      if (is_there && is_stopped && with >= kHarmless) needless.push_back(campaign.things[i].element());
    }
    std::printf(
        "of %zu things %zu were in the way, %zu of them could be stopped for; touched at 0.1 m/s or more: "
        "%zu, of "
        "these needlessly %zu; without the gate %zu\n",
        campaign.things.size(), in_the_way, stoppable, hit, needless.size(), hit_without);
  }
  std::size_t in_the_way = 0, stoppable = 0, hit = 0, hit_without = 0;
  Words needless;  // things that were touched although the robot could have stopped
};

}  // namespace

TEST_CASE(
    "what appears before a robot with a laser is never run into where stopping was possible, and without the "
    "gate it is",
    "[system][gate]") {
  const TempFolder folder;
  const std::size_t count = part_of<std::size_t>(1000);
  const Outcome outcome{Campaign(folder, kPioneer, count)};
  CHECK(outcome.needless == Words{});
  CHECK(outcome.stoppable > count / 2);
  CHECK(outcome.hit_without > outcome.stoppable);
}

TEST_CASE("sonars miss some things, and a gate that hears by them stops for most others", "[system][gate]") {
  const TempFolder folder;
  const std::size_t count = part_of<std::size_t>(500);
  const Outcome outcome{Campaign(folder, kScout, count)};
  CHECK(outcome.stoppable > count / 2);
  CHECK(5 * outcome.needless.size() < outcome.stoppable);
  CHECK_FALSE(outcome.needless.empty());  // a limit that its README names
  CHECK(outcome.hit_without > outcome.stoppable);
}

TEST_CASE("a robot whose laser falls silent stands 0.7 s later, and says which one is silent",
          "[system][gate]") {
  const TempFolder folder;
  const Run run =
      drive(folder, "",
            {"--fail", "laser=throw@5s", "--record", folder.file("odometry.csv") + "=base.OdometryPush"});
  CHECK(run.says(
      "alarm SENSOR_SILENT: the robot stands: nothing valid comes from laser.LaserRangeReadingsPush"));
  std::vector<double> late;  // [m/s] speeds after 0.3 s of silence, a lap, and 0.3 s of braking
  for (const Row& row : rows_of(text_in(folder.file("odometry.csv"))))
    if (number(row, "stamp") > 5.7) late.push_back(number(row, "translational_velocity"));
  REQUIRE(late.size() > 100);
  CHECK(std::ranges::all_of(late, [](double speed) { return speed == 0.0; }));
}

TEST_CASE("a gate that is told by a clock ahead who moves lets the robot stand, and says so",
          "[system][gate]") {
  const TempFolder folder;
  const std::string gate = "<component name=\"gate\"";
  std::string text = text_in(system_graph("sudden.xml"));
  text.insert(text.find(gate),
              "<component name=\"people\" type=\"test.Foreteller\"><param name=\"ahead\" "
              "value=\"${ahead}\"/></component>"
              "<connect from=\"people.MovingThingsPush\" to=\"gate.moving\"/>");
  text.insert(text.find("<arg "), "<arg name=\"ahead\" text=\"Of the clock\"/>");
  const auto drive_by = [&](const std::string& ahead) {
    return run_deployer(Words{folder.write("graph.xml", text), "--until", "8 s", "--set", "ahead=" + ahead,
                              "--set", "goals=near: 3 3", "--set",
                              "robot=" + source_file("sim/robots/pioneer_2dx.urdf"), "--set",
                              "world=" + folder.write("world.xml", hall(""))} +
                        Words{"--plugins", ORCA_BINARY_DIR "/tests/plugins"} + virtual_clock());
  };
  const Run right = drive_by("0 s");
  INFO(right.err);
  CHECK(right.arrivals().size() == 1);
  const Run ahead = drive_by("86400 s");
  CHECK(ahead.arrivals().empty());
  CHECK(ahead.says("the robot stands: nothing valid comes at its port \"moving\""));
}

TEST_CASE("low and overhanging things that one of two lasers sees stop a robot before it touches them",
          "[system][gate]") {
  const std::map<std::string, std::string> things{
      {"a pallet below the high laser",
       "<box name='thing' x='4' y='3' length='1' width='1' height='0.14 m'/>"},
      {"a table top above the low laser",
       "<box name='thing' x='4' y='3' length='1' width='1' bottom='0.25 m' height='0.4 m'/>"}};
  const Words courier{"--set", "robot=" + source_file("sim/robots/courier.urdf"), "--set", "speed=0.8 m/s"};
  for (const auto& [name, element] : things) {
    CAPTURE(name);
    const TempFolder folder;
    const Run with = drive(folder, element, courier + Words{"--profile", "two_lasers"});
    INFO(with.err);
    CHECK(with.contacts().empty());
    CHECK(with.says("gate: stops the robot: "));
    CHECK_FALSE(drive(folder, element, courier + Words{"--profile", "none"}).contacts().empty());
  }
}

TEST_CASE("a gate without the robot's file, or with nothing to see with, is refused before anything starts",
          "[system][gate]") {
  const TempFolder folder;
  const auto errors_without = [&](const std::string& element) {
    std::string text = text_in(system_graph("sudden.xml"));
    const std::size_t at = text.find(element, text.find("<profile name=\"gate\">"));
    REQUIRE(at != std::string::npos);
    text.erase(at, element.size());
    const Run run = run_deployer(Words{folder.write("graph.xml", text), "--check", "--set",
                                       "robot=" + source_file("sim/robots/pioneer_2dx.urdf"), "--set",
                                       "world=" + folder.write("world.xml", hall(""))});
    CHECK(run.exit_code() == 2);
    return run.err;
  };
  const std::string file = errors_without("<param name=\"robot\" value=\"${robot}\"/>");
  CHECK(file.find("parameter \"robot\": it knows no body without the robot's file") != std::string::npos);
  const std::string laser =
      errors_without("<connect from=\"laser.LaserRangeReadingsPush\" to=\"gate.lasers\"/>");
  CHECK(laser.find("connect its port lasers or its port sonars") != std::string::npos);
}
