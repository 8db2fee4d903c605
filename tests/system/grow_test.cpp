// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl apply with components that come and go, within a process and between processes.
#include <signal.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <regex>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

// A teller that counts what a talker tells it, and tells it back; the talker logs what it hears.
struct Pair {
  std::string name;                       // of the talker; the teller is "NAME_teller"
  std::string talks;                      // process of the talker
  std::string counts;                     // and of the teller
  std::string type = "test.OtherTeller";  // which says "7:N"

  [[nodiscard]] std::string components() const {
    return "<component name=\"" + name + "_teller\" type=\"" + type + "\"" + in(counts) +
           "/><component name=\"" + name + "\" type=\"test.Talker\"" + in(talks) + "/>";
  }
  [[nodiscard]] std::string connections() const {
    const std::string teller = name + "_teller";
    return "<connect from=\"" + name + ".out\" to=\"" + teller + ".in\" queue=\"1000\"/><connect from=\"" +
           name + ".poke\" to=\"" + teller + ".poke\" queue=\"1000\"/><connect from=\"" + teller +
           ".out\" to=\"" + name + ".back\" queue=\"1000\"/>";
  }

 private:
  static std::string in(const std::string& process) {
    return process == "main" ? "" : " process=\"" + process + "\"";
  }
};
using Pairs = std::vector<Pair>;

// Graphs with a pair that is always there, whose teller says "1:N", and others.
class Graphs {
 public:
  Graphs() {
    const fs::path plugins = folder_.file("plugins");
    fs::create_directory(plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/host_plugins/test_talker.so", plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/host_plugins/test_teller.so", plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/next_plugins/test_teller_other.so", plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/host_plugins/test_homesick.so", plugins);
  }

  void add_plugin(const std::string& name) const {
    copy_plugin(ORCA_BINARY_DIR "/tests/host_plugins/" + name + ".so", folder_.file("plugins"));
  }

  // Writes a graph, and returns its file.
  [[nodiscard]] std::string write(const std::string& name, const Pairs& others,
                                  const std::string& more = "") const {
    const Pair first{"talker", "main", "front", "test.Teller"};
    std::string components = first.components();
    std::string connections = first.connections();
    for (const Pair& pair : others) {
      components += pair.components();
      connections += pair.connections();
    }
    return folder_.write(name, "<graph name=\"growing\" version=\"1\" restarts=\"1000\" within=\"" + within +
                                   "\" on_supervisor_loss=\"continue\" plugins=\"" + folder_.file("plugins") +
                                   "\"><process name=\"front\"/>" + components + connections + more +
                                   "</graph>");
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

  std::string within = "100 ms";  // a process that is lost again within this time is started later

 private:
  TempFolder folder_;
};

class Growing {
 public:
  explicit Growing(const std::string& within = "100 ms") {
    graphs_.within = within;
    start(graphs_.write("start.xml", {}));
  }

  void start(const std::string& file) { program_.start(file, "heard 1:"); }

  [[nodiscard]] const Graphs& graphs() const { return graphs_; }
  [[nodiscard]] Run apply(const Pairs& others, const std::string& more = "") const {
    return run_orcactl(Words{"apply", graphs_.write("new.xml", others, more)} + kBriefly, Seconds(40));
  }
  [[nodiscard]] std::size_t mark() const { return program_->err().size(); }
  bool hears(const std::string& text, std::size_t mark) {
    return comes_true([&] { return program_->err().find(text, mark) != std::string::npos; }, Seconds(20));
  }
  [[nodiscard]] std::map<std::string, pid_t> hosts() const { return children_of(program_->pid()); }
  [[nodiscard]] pid_t host(const std::string& process) const { return hosts().at(process); }
  [[nodiscard]] std::string log() const { return program_->err(); }
  std::string end() { return stop_without_gaps(*program_); }

 private:
  Graphs graphs_;
  Deployers program_;
};

// A component that cannot be configured in a process, although it can be where the graph is checked. It comes last.
std::string homesick(const std::string& where, const std::string& how) {
  return "<component name=\"last\" type=\"test.Homesick\" process=\"" + where +
         "\"><param name=\"abroad\" value=\"" + where + "\"/><param name=\"crashes\" value=\"" +
         (how == "crashes" ? "true" : "false") + "\"/></component>";
}

// A component whose configure() takes its time in a process.
std::string slow(const std::string& where, const std::string& time) {
  return "<component name=\"last\" type=\"test.Homesick\" process=\"" + where +
         "\"><param name=\"abroad\" value=\"" + where + "\"/><param name=\"nap\" value=\"" + time +
         "\"/></component>";
}

// Kills a process again and again, so that it will be started only some time after the last end.
void wear_out(const Growing& system, const std::string& process) {
  pid_t last = 0;
  for (int i = 0; i < 7; ++i) {
    const auto is_back = [&] {
      const auto hosts = system.hosts();
      const auto found = hosts.find(process);
      if (found == hosts.end() || found->second == last) return false;
      last = found->second;
      return true;
    };
    REQUIRE(comes_true(is_back, Seconds(5)));
    kill(last, SIGKILL);
  }
}

// What a program can see of the running system, without what changes by itself.
std::string all_that_is_seen() {
  const std::regex figures(R"re("(memory_mb|log_per_s)": [^,}\n]*)re");
  return run_orcactl({"graph", "--json"}).out +
         std::regex_replace(run_orcactl({"ps", "--json"}).out, figures, "\"$1\"");
}

bool has_in_memory(pid_t process, const std::string& plugin) {
  std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
  return std::string(std::istreambuf_iterator<char>(maps), {}).find(plugin) != std::string::npos;
}

}  // namespace

TEST_CASE("components come and go while the system runs, and those that stay notice nothing",
          "[system][grow]") {
  const Pair pair{"more", GENERATE(as<std::string>{}, "main", "front"),
                  GENERATE(as<std::string>{}, "main", "front")};
  CAPTURE(pair.talks, pair.counts);
  Growing system;
  const std::string before = all_that_is_seen();
  for (int i = 0; i < 2; ++i) {
    const std::size_t mark = system.mark();
    const Run come = system.apply({pair});
    INFO(come.out << come.err << system.log());
    REQUIRE(come.exit_code() == 0);
    CHECK_THAT(come.out, Contains("+ component more_teller") && Contains("comes up beside the others"));
    CHECK(system.hears("more: heard 7:20", mark));
    CHECK(has_in_memory(system.host(pair.counts), "test_teller_other"));
    CHECK_THAT(run_orcactl({"ps"}).out, Contains("more_teller"));
    CHECK(run_orcactl({"get", "more_teller.step"}).exit_code() == 0);
    CHECK(run_orcactl({"set", "more_teller.step", "2"}).exit_code() == 0);
    const Run gone = system.apply({});
    INFO(gone.out << gone.err);
    REQUIRE(gone.exit_code() == 0);
    CHECK_THAT(gone.out, Contains("- component more_teller") && Contains("nothing else stops"));
    CHECK_FALSE(has_in_memory(system.host(pair.counts), "test_teller_other"));
    CHECK(all_that_is_seen() == before);
  }
  system.end();
}

TEST_CASE("a component comes whose plugin was built since the start", "[system][grow]") {
  const std::string where = GENERATE("main", "front");
  Growing system;
  system.graphs().add_plugin("test_napper");
  const Run come =
      system.apply({}, "<component name=\"new\" type=\"test.Napper\" autonomous=\"true\" process=\"" +
                           std::string(where) + "\"/>");
  INFO(come.err);
  CHECK(come.exit_code() == 0);
  CHECK(run_orcactl({"echo", "new.out", "--count", "3"}).exit_code() == 0);
  system.end();
}

TEST_CASE("a component that cannot be configured where it is to run leaves all as it was", "[system][grow]") {
  const std::string where = GENERATE("main", "front");
  const std::string how = GENERATE("refuses", "crashes");
  CAPTURE(where, how);
  Growing system;
  const std::string graph = run_orcactl({"graph", "--json"}).out;
  const std::string seen = all_that_is_seen();
  const std::size_t mark = system.mark();
  const Run refused =
      system.apply({{"fine", "main", "front"}, {"more", "front", "main"}}, homesick(where, how));
  INFO(refused.out << refused.err << system.log());
  CHECK(refused.exit_code() == 1);
  CHECK(run_orcactl({"graph", "--json"}).out == graph);
  if (how == "refuses") {
    CHECK_THAT(refused.err, Contains("last: configure() said: this is not home"));
    CHECK(all_that_is_seen() == seen);
  } else {
    CHECK_THAT(refused.err, Contains("process " + where));
    REQUIRE(system.hears("process " + where + " is back", mark));
  }
  CHECK(system.hears("talker: heard 1:", system.mark()));
  const Run applied = system.apply({{"fine", "main", "front"}, {"more", "front", "main"}});
  INFO(applied.err);
  CHECK(applied.exit_code() == 0);
  CHECK(system.hears("more: heard 7:", 0));
  if (how == "refuses") return (void)system.end();
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE(
    "whatever process is killed while components come and go, the system is as before or as it was to be",
    "[system][grow]") {
  Growing system;
  std::mt19937 random(16);  // NOLINT(cert-msc51-cpp): the same moments each time, as far as there are any
  for (int i = 0; i < 8; ++i) {
    const std::string process = i % 2 == 0 ? "front" : "main";
    const Pairs pairs = i % 4 < 2 ? Pairs{{"more", "main", "front"}, {"fine", "front", "main"}} : Pairs{};
    const std::string before = run_orcactl({"graph", "--json"}).out;
    const std::string wanted = system.graphs().write("new.xml", pairs);
    const std::size_t mark = system.mark();
    Subprocess apply(orcactl({"apply", wanted}));
    std::this_thread::sleep_for(Seconds(std::uniform_real_distribution<>(0.0, 0.1)(random)));
    kill(system.host(process), SIGKILL);
    const Run ended = finish(apply, Seconds(20));
    CAPTURE(i, ended.out, ended.err, system.log());
    REQUIRE(system.hears("process " + process + " is back", mark));
    if (ended.exit_code() != 0) CHECK(run_orcactl({"graph", "--json"}).out == before);
    CHECK(system.hears("talker: heard 1:", system.mark()));
    const auto applies = [&] { return run_orcactl({"apply", wanted}).exit_code() == 0; };
    REQUIRE(comes_true(applies, Seconds(10)));
    for (const Pair& pair : pairs) CHECK(system.hears(pair.name + ": heard 7:", system.mark()));
  }
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE(
    "processes that are started again have the components that were added, and a new deployer adopts them",
    "[system][grow]") {
  Growing system;
  const Pair pair{"more", "main", "front"};
  REQUIRE(system.apply({pair}).exit_code() == 0);
  for (const std::string process : {"front", "main"}) {
    const std::size_t mark = system.mark();
    CHECK(run_orcactl({"restart", process}).exit_code() == 0);
    CHECK(system.hears("more: heard 7:", mark));
  }
  system.start(system.graphs().file("new.xml"));
  CHECK(system.hears("more: heard 7:", 0));
  CHECK(system.apply({}).exit_code() == 0);
  CHECK(system.apply({pair, {"third", "front", "main"}}).exit_code() == 0);
  CHECK(system.hears("third: heard 7:", 0));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("a system becomes each of many graphs, and what stays never misses an object", "[system][grow]") {
  Growing system;
  std::mt19937 random(16);  // NOLINT(cert-msc51-cpp): the same graphs each time
  const auto either = [&] { return random() % 2 == 0; };
  for (int i = 0; i < 30; ++i) {
    Pairs pairs;
    for (const std::string talks : {"main", "front"})
      for (const std::string counts : {"main", "front"})
        if (either()) pairs.push_back({talks + "_" + counts, talks, counts});
    const Run applied = system.apply(pairs);
    CAPTURE(i, applied.out, applied.err);
    REQUIRE(applied.exit_code() == 0);
    CHECK_THAT(run_orcactl({"diff", system.graphs().file("new.xml")}).out,
               Contains("the system runs like that already"));
    for (const Pair& pair : pairs) {
      const std::size_t mark = system.mark();
      CHECK(system.hears(pair.name + ": heard 7:", mark));
    }
  }
  system.end();
}

TEST_CASE("a component comes and goes at hardware that others use, while the robot drives",
          "[system][grow]") {
  const TempFolder folder;
  ShippedGraph graph("scout_goto_processes");
  const std::string start = folder.write("start.xml", graph.text());
  graph.add(
      "  <component name=\"second\" type=\"orca.TruthLocalizer\" process=\"base\" hardware=\"scout\" "
      "autonomous=\"true\"/>\n");
  const std::string more = folder.write("more.xml", graph.text());
  Subprocess program(deployer({start}));
  const auto drives = [] {
    return run_orcactl({"hz", "base.MotionCommandSend", "--for", "300ms"}).exit_code() == 0;
  };
  REQUIRE(comes_true(drives, Seconds(10)));
  for (int i = 0; i < 2; ++i) {
    const Run come = run_orcactl({"apply", more});
    INFO(come.err << program.err());
    REQUIRE(come.exit_code() == 0);
    CHECK(run_orcactl({"echo", "second.RobotPosePush", "--count", "3"}).exit_code() == 0);
    REQUIRE(run_orcactl({"apply", start}).exit_code() == 0);
    CHECK(run_orcactl({"echo", "localizer.RobotPosePush", "--count", "3"}).exit_code() == 0);
  }
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  const Run run = finish(program, Seconds(10));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_FALSE(run.says("alarm"));
}

TEST_CASE("in virtual time components come and go at given times, and the run repeats", "[system][grow]") {
  const Graphs graphs;
  const std::string start = graphs.write("start.xml", {});
  const std::string more = graphs.write("more.xml", {{"more", "main", "front"}});
  const auto run = [&](const Words& changes) {
    return run_deployer(Words{start, "--until", "4 s", "--log", "debug"} + changes + virtual_clock());
  };
  const Words changes{"--change", more + "@1s", "--change", start + "@2s"};
  const Run once = run(changes);
  INFO(once.err);
  REQUIRE(once.exit_code() == 0);
  CHECK_THAT(once.err, Contains("[     1.100] debug   more: heard 7:"));
  CHECK_THAT(once.err, !Contains("[     2.100] debug   more: heard 7:"));
  CHECK_THAT(once.err, Contains("[     3.100] debug   talker: heard 1:") && !Contains("gap "));
  REQUIRE(once.trace_hash());
  CHECK(run(changes).trace_hash() == once.trace_hash());
  CHECK(run({}).trace_hash() != once.trace_hash());
}

TEST_CASE("a new deployer adopts processes in which components have come and gone, and disturbs none",
          "[system][grow]") {
  Growing system;
  REQUIRE(system.apply({{"x", "main", "front"}}).exit_code() == 0);
  REQUIRE(system.apply({}).exit_code() == 0);
  const pid_t main = system.host("main");
  const pid_t front = system.host("front");
  system.start(system.graphs().write("start.xml", {}));
  const std::size_t mark = system.mark();
  REQUIRE(system.hears("heard 1:", mark));
  INFO(system.log());
  CHECK(run_orcactl({"ps", "--json"}).out.find("\"pid\": " + std::to_string(main)) != std::string::npos);
  CHECK(run_orcactl({"ps", "--json"}).out.find("\"pid\": " + std::to_string(front)) != std::string::npos);
  CHECK(system.log().find("talks nonsense") == std::string::npos);
  system.end();
}

TEST_CASE("a deployer that is killed while a component comes leaves a system that the next one adopts whole",
          "[system][grow]") {
  Growing system;
  const std::string main = "\"pid\": " + std::to_string(system.host("main"));
  const std::string front = "\"pid\": " + std::to_string(system.host("front"));
  const std::size_t mark = system.mark();
  Subprocess apply(orcactl({"apply", system.graphs().write("new.xml", {}, slow("main", "2 s"))}));
  REQUIRE(system.hears("last: naps", mark));
  system.start(system.graphs().file("start.xml"));
  CHECK(finish(apply, Seconds(5)).exit_code() != 0);
  INFO(system.log());
  CHECK_THAT(run_orcactl({"ps", "--json"}).out, Contains(main) && Contains(front) && !Contains("last"));
  const auto comes_again = [&] { return system.apply({}, slow("main", "0.01 s")).exit_code() == 0; };
  CHECK(comes_true(comes_again, Seconds(10)));
  CHECK(system.log().find("talks nonsense") == std::string::npos);
  CHECK_THAT(run_orcactl({"ps", "--json"}).out, Contains(main) && Contains(front) && Contains("last"));
  system.end();
}

TEST_CASE("a process that is started while a component comes knows it afterwards", "[system][grow]") {
  Growing system("60 s");
  wear_out(system, "front");
  const auto comes = [&] { return system.apply({{"more", "main", "main"}}, slow("main", "2.5 s")); };
  Run applied = comes();
  INFO(applied.err << system.log());
  if (applied.exit_code() != 0) {
    CHECK_THAT(applied.err, Contains("process front ended or was started meanwhile"));
    REQUIRE(comes().exit_code() == 0);
  }
  const auto works = [&] { return run_orcactl({"get", "talker_teller.step"}).exit_code() == 0; };
  REQUIRE(comes_true(works, Seconds(5)));
  const pid_t front = system.host("front");
  const std::size_t mark = system.mark();
  CHECK(run_orcactl({"move", "more.back", "talker_teller.out"}).exit_code() == 0);
  CHECK(system.hears("more: heard 1:", mark));
  CHECK(system.host("front") == front);
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}
