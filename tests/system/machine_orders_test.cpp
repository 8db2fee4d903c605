// SPDX-License-Identifier: GPL-3.0-or-later
// What an operator may order on one of two machines: network namespaces that the test makes, joined by a cable that it can pull.
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "deployer.hpp"
#include "pair_of_machines.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using Clock = std::chrono::steady_clock;

namespace {

constexpr int kBase = 0;
constexpr int kBrain = 1;

// A command of orcactl as its help shows it: "set", and "COMPONENT.PARAM", "VALUE".
struct Usage {
  std::string name;
  Words arguments;
  std::string more;  // an argument that may be left out; empty: none of a single word
};

// Returns all commands that orcactl has, whatever they are.
std::vector<Usage> all_commands() {
  std::istringstream help(run_orcactl({"--help"}).out);
  std::vector<Usage> commands;
  bool is_table = false;
  for (std::string line; std::getline(help, line);) {
    if (line == "Options") break;
    const std::size_t end = line.find("  ", 2);  // of the usage, before its explanation
    if (is_table && line.starts_with("  ") && end != std::string::npos) {
      std::istringstream words(line.substr(2, end - 2));
      Usage usage;
      words >> usage.name;
      if (line.starts_with("   ")) continue;  // the end of a long line
      bool is_optional = false;               // within [ and ]
      for (std::string word; words >> word;) {
        is_optional = is_optional || word.starts_with("[");
        if (!is_optional) usage.arguments.push_back(word);
        if (word.starts_with("[") && word.ends_with("]"))
          usage.more = word.substr(1, word.find_first_of(".]") - 1);
        if (word.ends_with("]")) is_optional = false;
      }
      commands.push_back(usage);
    }
    is_table = is_table || line == "Commands";
  }
  return commands;
}

// What each word of a command may stand for on the other machine: of the base, or of the brain.
using Meanings = std::map<std::string, Words>;
const Meanings kOfBase{
    {"PORT", {"base.OdometryPush", "base.RobotQuery", "base.MotionCommandSend"}},
    {"SERVER_PORT", {"base.OdometryPush"}},
    {"XML", {"<Ask/>"}},
    {"COMPONENT", {"base", "scout"}},
    {"COMPONENT|GROUP", {"base"}},
    {"COMPONENT[.PARAM]", {"localizer", "localizer.period"}},
    {"COMPONENT.PARAM", {"localizer.period"}},
    {"VALUE", {"1"}},
    {"NAME", {"base", "localizer"}},
};
const Meanings kOfBrain{
    {"PORT", {"goto.MotionCmdPush", "fuser.ClientListQuery", "goto.GotoCoordinateSend"}},
    {"SERVER_PORT", {"fuser.ClientListQuery"}},
    {"XML", {"<Ask/>"}},
    {"COMPONENT", {"goto"}},
    {"COMPONENT|GROUP", {"goto"}},
    {"COMPONENT[.PARAM]", {"goto", "goto.max_speed"}},
    {"COMPONENT.PARAM", {"goto.max_speed"}},
    {"VALUE", {"1"}},
    {"NAME", {"behaviours", "goto"}},
};
// Words that have nothing to do with machines.
const Meanings kAnywhere{
    {"PLUGIN.so[:TYPE]", {ORCA_BINARY_DIR "/plugins/goto.so"}},
    {"GRAPH.xml", {source_file("graphs/two_machines.xml")}},
    {"DURATION", {"100ms"}},
    {"FACTOR|fast", {"2"}},
    {"KIND", {"component", "group", "port", "param", "process", "system"}},
    {"SHELL", {"bash", "zsh"}},
};

// The answer of every machine to who would pause real time.
constexpr const char* kNoPace = "this run is in real time, which has no pace";

// Returns all that a command can be given about another machine. A word that means nothing here fails the test: say what it
// stands for.
std::vector<Words> calls_of(const Usage& usage, const Meanings& there) {
  std::vector<Words> calls{{usage.name}};
  for (const std::string& argument : usage.arguments) {
    const Meanings& meanings = there.contains(argument) ? there : kAnywhere;
    INFO("the word " << argument << " of orcactl " << usage.name);
    REQUIRE(meanings.contains(argument));
    std::vector<Words> longer;
    for (const Words& call : calls)
      for (const std::string& meaning : meanings.at(argument)) longer.push_back(call + Words{meaning});
    calls = longer;
  }
  if (there.contains(usage.more))
    for (const std::string& meaning : there.at(usage.more)) calls.push_back(calls.front() + Words{meaning});
  return calls;
}

std::string text_of(const Words& words) {
  std::string text = "orcactl";
  for (const std::string& word : words) text += " " + word;
  return text;
}

// Gives a command on one machine, and checks that it is answered, or refused with the reason that it is for the other, or that a
// word is missing.
void check_call(const Pair& pair, int machine, const Words& call) {
  const Run run = pair.orcactl(machine, call, Seconds(10));
  INFO("on machine " << kMachines[machine] << ": " << text_of(call) << "\n" << run.out << run.err);
  CHECK(run.ended);
  if (run.exit_code() == 2) {
    CHECK_THAT(run.err, Contains(call.front() + " needs "));
    return;
  }
  CHECK((run.exit_code() == 0 || run.exit_code() == 1));
  const bool is_of_time = call.front() == "pace" || call.front() == "pause" || call.front() == "step";
  if (is_of_time) CHECK(run.exit_code() == 1);
  if (run.exit_code() == 1) CHECK(run.says(is_of_time ? kNoPace : kMachines[1 - machine]));
}

// Two machines that drive a robot to goals far away.
void start_driving(Pair& pair, const Words& options_of_brain = {}) {
  pair.start(kBase);
  pair.start(kBrain, {"interface=orca0"}, options_of_brain);
  pair.says(kBase, "machine brain is there", 0, Seconds(10));
  pair.says(kBrain, "machine base is there", 0, Seconds(10));
  const auto end = Clock::now() + Seconds(10) * kSlowdown;
  while (pair.orcactl(kBase, {"echo", "base.OdometryPush", "--count", "1"}).exit_code() != 0)
    REQUIRE(Clock::now() < end);
}

// The speed of the robot as its odometry tells it, followed on the base's machine.
class Speed {
 public:
  explicit Speed(const Pair& pair)
      : echo_(pair.network().on(kBase, orcactl({"echo", "base.OdometryPush", "--json"}))) {}

  // Waits until the robot moves, or stands.
  bool reaches(bool moves, Seconds limit) {
    const auto end = Clock::now() + limit * kSlowdown;
    while ((std::abs(last()) > 0.02) != moves) {
      if (Clock::now() > end) return false;
      std::this_thread::sleep_for(Seconds(0.01));
    }
    return true;
  }

 private:
  // Returns the last speed [m/s]; 0 before the first.
  [[nodiscard]] double last() const {
    const std::string out = echo_.out();
    const std::string mark = "translational_velocity=\\\"";
    const std::size_t line = out.rfind("\"passed\"", out.rfind('\n'));
    const std::size_t at = line == std::string::npos ? line : out.find(mark, line);
    return at == std::string::npos ? 0.0 : std::atof(out.c_str() + at + mark.size());
  }

  Subprocess echo_;
};

void check_both_confirm(const Run& run, const std::string& how) {
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 0);
  for (const std::string& machine : kMachines) CHECK_THAT(run.out, Contains(machine));
  CHECK_THAT(run.out, Contains(how));
}

}  // namespace

TEST_CASE("every command of orcactl is answered on each of two machines, whatever of the other one it names",
          "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0"}, kDrive);
  start_driving(pair);
  const std::vector<Usage> commands = all_commands();
  CHECK(commands.size() > 25);
  for (const int machine : {kBase, kBrain})
    for (const Usage& command : commands) {
      // A recording of all goes on until the system ends, a file of one has no machine, and neither has that of a map or an import.
      // Tasks are those of the machine that is asked.
      static const std::set<std::string> others{"stop", "record", "bag",  "calibrate", "map",
                                                "new",  "import", "keys", "tasks"};
      if (others.contains(command.name)) continue;
      for (const Words& call : calls_of(command, machine == kBase ? kOfBrain : kOfBase))
        check_call(pair, machine, call);
    }
  for (const int machine : {kBase, kBrain}) CHECK(pair.orcactl(machine, {"ps"}).exit_code() == 0);
  CHECK(pair.orcactl(kBrain, {"stop"}).exit_code() == 0);
  for (const int machine : {kBase, kBrain}) CHECK(pair.finish(machine, Seconds(10)).exit_code() == 0);
}

TEST_CASE("an order about something on another machine is refused with the name of that machine",
          "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0"}, kDrive);
  start_driving(pair);
  const Run echo = pair.orcactl(kBrain, {"echo", "base.OdometryPush", "--count", "1"});
  CHECK(echo.exit_code() == 1);
  CHECK(echo.says("component base runs on machine base; give this command there"));
  const TempFolder folder;
  const Run record = pair.orcactl(kBrain, {"record", folder.file("a.mcap"), "base.OdometryPush"});
  CHECK(record.exit_code() == 1);
  CHECK(record.says("runs on machine base"));
  const Run swap = pair.orcactl(kBrain, {"swap", "scout", ORCA_BINARY_DIR "/plugins/sim.so"});
  CHECK(swap.exit_code() == 1);
  CHECK(swap.says("hardware scout runs on machine base"));
  const Run restart = pair.orcactl(kBase, {"restart", "behaviours"});
  CHECK(restart.exit_code() == 1);
  CHECK(restart.says("process behaviours runs on machine brain"));
  CHECK_THAT(pair.orcactl(kBrain, {"graph"}).out, Contains("orca.RobotBaseServer") && Contains("orca.Goto"));
  CHECK(pair.orcactl(kBrain, {"ps"}).says("this is what machine brain knows; for the rest ask on base"));
  pair.stop(kBase);
}

TEST_CASE("a behaviour whose sensors are on another machine is exchanged while it runs",
          "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0"}, kDrive);
  start_driving(pair);
  CHECK_THAT(pair.orcactl(kBrain, {"fits", "avoid"}).out, Contains("orca.SonarAvoid"));
  const Run swap =
      pair.orcactl(kBrain, Words{"swap", "avoid", ORCA_BINARY_DIR "/plugins/sonar_avoid.so"} + kBriefly);
  INFO(swap.out << swap.err);
  CHECK(swap.exit_code() == 0);
  CHECK_THAT(pair.at(kBrain).err(), Contains("the new code was tried out: it got "));
  CHECK_THAT(pair.at(kBrain).err(), !Contains("the new code was tried out: it got 0 objects"));
  pair.stop(kBrain);
}

TEST_CASE("an emergency stop on either of two machines rests the robot, and says who has confirmed it",
          "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0"}, kDrive);
  start_driving(pair);
  Speed speed(pair);
  for (const int machine : {kBrain, kBase}) {
    REQUIRE(speed.reaches(true, Seconds(10)));
    Subprocess stop(pair.network().on(machine, orcactl({"estop"})));
    const auto ordered = Clock::now();
    REQUIRE(speed.reaches(false, Seconds(5)));
    const Seconds took = Clock::now() - ordered;
    WARN("from the start of orcactl on " << kMachines[machine] << " to rest: " << took.count() << " s");
    CHECK(took < Seconds(0.5) * kSlowdown);
    check_both_confirm(finish(stop, Seconds(5)), "held");
    CHECK_FALSE(speed.reaches(true, Seconds(0.5)));
    check_both_confirm(pair.orcactl(1 - machine, {"estop", "--release"}), "released");
  }
  REQUIRE(speed.reaches(true, Seconds(10)));
  const Run again = pair.orcactl(kBrain, {"estop", "--release"});
  CHECK(again.exit_code() == 1);
  CHECK(again.says("there is no emergency stop to be released"));
  pair.stop(kBase);
}

TEST_CASE("a machine that is cut off is named by an emergency stop, and obeys when it is heard again",
          "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0"}, kDrive);
  start_driving(pair);
  Speed speed(pair);
  REQUIRE(speed.reaches(true, Seconds(10)));
  pair.network().connect(false);
  const Run run = pair.orcactl(kBrain, {"estop"});
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says(
      "machine base has not confirmed the emergency stop: what it moves may go on; confirmed by machine "
      "brain"));
  const std::size_t mark = pair.mark(kBase);
  pair.network().connect(true);
  pair.says(kBase, "alarm ESTOP: all motors are held", mark, Seconds(10));
  CHECK_FALSE(speed.reaches(true, Seconds(0.5)));
  check_both_confirm(pair.orcactl(kBase, {"estop", "--release"}), "released");
  CHECK(speed.reaches(true, Seconds(10)));
  pair.stop(kBase);
}

TEST_CASE("motors that are held when one of two machines starts are held on both",
          "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0"}, kDrive);
  start_driving(pair, {"--hold"});
  Speed speed(pair);
  pair.says(kBase, "alarm ESTOP: all motors are held", 0, Seconds(10));
  CHECK_FALSE(speed.reaches(true, Seconds(1)));
  check_both_confirm(pair.orcactl(kBase, {"estop", "--release"}), "released");
  CHECK(speed.reaches(true, Seconds(10)));
  pair.stop(kBrain);
}
