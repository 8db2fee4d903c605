// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl apply with processes that come, go or begin anew, and with components that go to another process.
#include <signal.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <random>
#include <thread>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

// A talker in the process "main" pokes a teller in another process, and hears from it how often it has counted: "1:N". Beside
// them a pair is in "main" and "calm".
struct Layout {
  std::string processes = "<process name=\"front\"/>";
  std::string teller = "front";  // process of the teller
  std::string more{};            // components
  std::string more_connections{};
  std::string rules{};             // attributes of the graph
  std::string processes_before{};  // before "calm"
  std::string step = "1";          // parameter of the teller beside

  [[nodiscard]] std::string text(const std::string& plugins) const {
    return "<graph name=\"renewing\" version=\"1\" restarts=\"1000\" within=\"100 ms\" "
           "on_supervisor_loss=\"continue\"" +
           rules + " plugins=\"" + plugins + "\">" + processes_before + "<process name=\"calm\"/>" +
           processes + "<component name=\"calm_teller\" type=\"test.Teller\" " +
           "process=\"calm\"><param name=\"step\" value=\"" + step +
           "\"/></component><component name=\"calm_talker\" type=\"test.Talker\"/>"
           "<component name=\"teller\" type=\"test.Teller\" process=\"" +
           teller + "\"/><component name=\"talker\" type=\"test.Talker\"/>" + more +
           pair("calm_talker", "calm_teller") + pair("talker", "teller") + more_connections + "</graph>";
  }

  static std::string pair(const std::string& talker, const std::string& teller) {
    return connection(talker + ".out", teller + ".in") + connection(talker + ".poke", teller + ".poke") +
           connection(teller + ".out", talker + ".back");
  }
  static std::string connection(const std::string& from, const std::string& to) {
    return "<connect from=\"" + from + "\" to=\"" + to + "\" queue=\"1000\"/>";
  }
};

const Layout kStart;
const Layout kRear{.processes = "<process name=\"rear\"/>", .teller = "rear"};
const Layout kSpins{.processes = "<process name=\"front\" spin=\"0.1 ms\"/>"};
const Layout kFibers{.processes = "<process name=\"front\" executor=\"fiber\"/>"};
const Layout kWithThird{.processes = "<process name=\"front\"/><process name=\"third\"/>",
                        .more = "<component name=\"other\" type=\"test.OtherTeller\" process=\"third\"/>",
                        .more_connections = Layout::connection("talker.out", "other.in")};
const Layout kInMain{.processes = "", .teller = "main"};

class Renewing {
 public:
  Renewing() {
    const fs::path plugins = folder_.file("plugins");
    fs::create_directory(plugins);
    for (const char* const name : {"host_plugins/test_talker", "host_plugins/test_teller",
                                   "next_plugins/test_teller_other", "host_plugins/test_homesick"})
      copy_plugin(ORCA_BINARY_DIR "/tests/" + std::string(name) + ".so", plugins);
    start(write("start.xml", kStart));
  }

  [[nodiscard]] std::string write(const std::string& name, const Layout& layout) const {
    return folder_.write(name, layout.text(folder_.file("plugins")));
  }
  void start(const std::string& file) { program_.start(file, "talker: heard 1:"); }

  // Ends the system, and starts it with another graph.
  void start_anew(const Layout& layout) {
    end();
    program_.forget();
    start(write("start.xml", layout));
  }

  [[nodiscard]] Run apply(const Layout& layout) const {
    return run_orcactl(Words{"apply", write("new.xml", layout)} + kBriefly, Seconds(40));
  }
  [[nodiscard]] bool runs_like(const Layout& layout) const {
    return run_orcactl({"diff", write("new.xml", layout)}).out.find("the system runs like that already") !=
           std::string::npos;
  }
  [[nodiscard]] std::size_t mark() const { return program_->err().size(); }
  bool hears(const std::string& text, std::size_t mark) {
    return comes_true([&] { return program_->err().find(text, mark) != std::string::npos; }, Seconds(20));
  }
  [[nodiscard]] std::map<std::string, pid_t> hosts() const { return children_of(program_->pid()); }
  [[nodiscard]] std::string log() const { return program_->err(); }
  // Ends the system, and checks that the pair beside has missed nothing.
  void end() {
    CHECK(run_orcactl({"suspend", "calm_talker"}).exit_code() ==
          0);  // processes do not end at the same moment
    CHECK(run_orcactl({"stop"}).exit_code() == 0);
    const Run run = finish(*program_, Seconds(10));
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK_THAT(run.err, !Contains("calm_teller: gap") && !Contains("calm_talker: not sent"));
  }
  void end_anyhow() {
    CHECK(run_orcactl({"stop"}).exit_code() == 0);
    CHECK(finish(*program_, Seconds(10)).ended);
  }

 private:
  TempFolder folder_;
  Deployers program_;
};

// A component that cannot be configured in a process, although it can be where the graph is checked.
std::string homesick(const std::string& where, const std::string& how, const std::string& abroad) {
  return "<component name=\"last\" type=\"test.Homesick\" process=\"" + where +
         "\"><param name=\"abroad\" value=\"" + abroad + "\"/><param name=\"crashes\" value=\"" +
         (how == "crashes" ? "true" : "false") + "\"/></component>";
}
std::string homesick(const std::string& where, const std::string& how) { return homesick(where, how, where); }

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t place = text.find(from);
  REQUIRE(place != std::string::npos);
  return text.replace(place, from.size(), to);
}

std::string graph_that_runs() { return run_orcactl({"graph", "--json"}).out; }

}  // namespace

TEST_CASE(
    "processes come, go and begin anew, components go along with their state, and the others notice nothing",
    "[system][renew]") {
  Renewing system;
  const pid_t main = system.hosts().at("main");
  const pid_t calm = system.hosts().at("calm");
  REQUIRE(system.hears("] debug   talker: heard 1:2", 0));
  const std::size_t began = system.mark();
  for (const Layout& layout : {kRear, kSpins, kStart, kWithThird, kRear, kWithThird}) {
    const Run applied = system.apply(layout);
    CAPTURE(layout.processes, applied.out, applied.err, system.log());
    REQUIRE(applied.exit_code() == 0);
    CHECK(system.runs_like(layout));
    CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
    CHECK(system.hosts().contains(layout.teller));
    CHECK(system.hosts().contains("third") == (layout.processes == kWithThird.processes));
    CHECK(system.hosts().at("main") == main);
    CHECK(system.hosts().at("calm") == calm);
  }
  // Each teller goes on from the count of the one before.
  CHECK_THAT(system.log().substr(began), !Contains(" teller: poke 1 ") && !Contains(" after 0"));
  CHECK(system.hears("goes on from the state test.Teller/1", began));
  system.end();
}

TEST_CASE("what becomes of the processes is told before", "[system][renew]") {
  Renewing system;
  const pid_t front = system.hosts().at("front");
  const Run rear = run_orcactl({"diff", system.write("new.xml", kRear)});
  CHECK_THAT(rear.out, Contains("~ component teller") && Contains("its process is started again"));
  CHECK_THAT(rear.out, Contains("= process front") && Contains("ends") && Contains("= process rear") &&
                           Contains("begins"));
  const Run spins = run_orcactl({"diff", system.write("new.xml", kSpins)});
  CHECK_THAT(spins.out, Contains("is started again, which took 0."));
  CHECK(system.hosts().at("front") == front);
  system.end();
}

TEST_CASE("a component goes into a process that others use, which begins anew with it", "[system][renew]") {
  Renewing system;
  const std::size_t mark = system.mark();
  const Run applied = system.apply(kInMain);
  INFO(applied.err << system.log());
  REQUIRE(applied.exit_code() == 0);
  CHECK(system.runs_like(kInMain));
  CHECK_FALSE(system.hosts().contains("front"));
  CHECK(system.hears("process main is back", mark));
  CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  CHECK_THAT(system.log().substr(mark), !Contains(" after 0"));
  CHECK(system.apply(kStart).exit_code() == 0);
  CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  system.end_anyhow();
}

TEST_CASE("processes that wake each other by another executor begin anew together", "[system][renew]") {
  Renewing system;
  const auto hosts = system.hosts();
  for (const Layout& layout : {kFibers, kStart, kFibers}) {
    const Run applied = system.apply(layout);
    INFO(applied.err << system.log());
    REQUIRE(applied.exit_code() == 0);
    CHECK_THAT(applied.out, Contains("= process main"));
    CHECK(system.hosts().at("calm") == hosts.at("calm"));
    CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
    CHECK(system.hears("calm_talker: heard 1:", system.mark()));
  }
  system.end_anyhow();
}

TEST_CASE("if a process does not come up as wanted, all is as before", "[system][renew]") {
  const std::string where = GENERATE("front", "rear");
  const std::string how = GENERATE("refuses", "crashes");
  CAPTURE(where, how);
  Renewing system;
  const std::string graph = graph_that_runs();
  Layout wanted = where == "rear" ? kRear : kSpins;
  wanted.more =
      "<component name=\"beside\" type=\"test.OtherTeller\" process=\"calm\"/>" + homesick(where, how);
  wanted.more_connections = Layout::connection("talker.out", "beside.in");
  wanted.step = "5";
  const std::size_t mark = system.mark();
  const Run refused = system.apply(wanted);
  INFO(refused.out << refused.err << system.log());
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("process " + where));
  if (how == "refuses")
    CHECK_THAT(refused.err,
               Contains("could not come up and was ended: last: configure() said: this is not home"));
  CHECK(graph_that_runs() == graph);
  CHECK_THAT(run_orcactl({"get", "calm_teller.step"}).out, Contains("1"));
  CHECK(system.hosts().contains("front"));
  CHECK_FALSE(system.hosts().contains("rear"));
  CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  CHECK_THAT(system.log().substr(mark), !Contains(" after 0") && !Contains("PROCESS_ENDED"));
  wanted.more = wanted.more_connections = "";
  CHECK(system.apply(wanted).exit_code() == 0);
  CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  system.end();
}

TEST_CASE("a component whose end ends the run may fail to come up as wanted, and the run goes on",
          "[system][renew]") {
  Renewing system;
  Layout ends = kStart;
  ends.rules = " ends=\"last\"";
  ends.more = homesick("front", "refuses", "nowhere");
  system.start_anew(ends);
  for (const std::string how : {"refuses", "crashes"}) {
    Layout wanted = ends;
    wanted.processes = kSpins.processes;
    wanted.more = homesick("front", how, "front");
    const Run refused = system.apply(wanted);
    INFO(refused.err << system.log());
    CHECK(refused.exit_code() == 1);
    CHECK(system.runs_like(ends));
    CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  }
  system.end();
}

TEST_CASE("components that have come up where another one could not go back with their states",
          "[system][renew]") {
  Renewing system;
  std::this_thread::sleep_for(Seconds(0.3));
  const std::size_t mark = system.mark();
  Layout wanted{.processes = "<process name=\"front\" spin=\"0.1 ms\"/><process name=\"later\"/>"};
  wanted.more = homesick("later", "refuses");
  const Run refused = system.apply(wanted);
  INFO(refused.err << system.log());
  CHECK(refused.exit_code() == 1);
  REQUIRE(system.hears("goes on from the state test.Teller/1", mark));
  CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  CHECK_THAT(system.log().substr(mark), !Contains(" after 0") && !Contains("poke 1 "));
  system.end();
}

TEST_CASE("a process that has come before the others in the graph is seen when it hangs", "[system][renew]") {
  Renewing system;
  Layout first = kRear;
  first.processes_before = "<process name=\"early\"/>";
  first.more = "<component name=\"other\" type=\"test.OtherTeller\" process=\"early\"/>";
  first.more_connections = Layout::connection("talker.out", "other.in");
  REQUIRE(system.apply(first).exit_code() == 0);
  const std::size_t mark = system.mark();
  const auto hosts = system.hosts();
  kill(hosts.at("early"), SIGSTOP);
  CHECK(system.hears("process early hung and was killed", mark));
  CHECK(system.hears("process early is back", mark));
  CHECK(system.hosts().at("calm") == hosts.at("calm"));
  system.end();
}

TEST_CASE("a component that is suspended does not begin to work because its process begins anew",
          "[system][renew]") {
  Renewing system;
  REQUIRE(run_orcactl({"suspend", "teller"}).exit_code() == 0);
  const Run refused = system.apply(kSpins);
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err,
             Contains("teller: it is suspended, and its process has to begin anew; resume it before"));
  CHECK(run_orcactl({"resume", "teller"}).exit_code() == 0);
  CHECK(system.apply(kSpins).exit_code() == 0);
  system.end_anyhow();
}

TEST_CASE("whatever process is killed while others begin anew, the system is as before or as it was to be",
          "[system][renew]") {
  Renewing system;
  std::mt19937 random(16);  // NOLINT(cert-msc51-cpp): the same moments each time, as far as there are any
  const std::vector<Layout> layouts{kRear, kSpins, kFibers, kWithThird, kStart};
  for (int i = 0; i < 20; ++i) {
    const Layout& layout = layouts[static_cast<std::size_t>(i) % layouts.size()];
    const std::string before = graph_that_runs();
    const std::string wanted = system.write("new.xml", layout);
    const auto hosts = system.hosts();
    const auto victim = std::next(hosts.begin(), static_cast<long>(random() % hosts.size()));
    Subprocess apply(orcactl({"apply", wanted}));
    std::this_thread::sleep_for(Seconds(std::uniform_real_distribution<>(0.0, 0.1)(random)));
    kill(victim->second, SIGKILL);
    const Run ended = finish(apply, Seconds(30));
    CAPTURE(i, victim->first, ended.out, ended.err, system.log());
    if (ended.exit_code() != 0) CHECK(graph_that_runs() == before);
    CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
    const auto applies = [&] { return run_orcactl({"apply", wanted}).exit_code() == 0; };
    REQUIRE(comes_true(applies, Seconds(10)));
    CHECK(system.runs_like(layout));
    CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
    CHECK(system.hears("calm_talker: heard 1:", system.mark()));
  }
  system.end_anyhow();
}

TEST_CASE("processes that have come are started again as the others, and a new deployer adopts them",
          "[system][renew]") {
  Renewing system;
  REQUIRE(system.apply(kWithThird).exit_code() == 0);
  for (const std::string process : {"third", "front", "main"}) {
    const std::size_t mark = system.mark();
    kill(system.hosts().at(process), SIGKILL);
    CHECK(system.hears("process " + process + " is back", mark));
    CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  }
  const auto hosts = system.hosts();
  system.start(system.write("new.xml", kWithThird));
  for (const auto& [name, pid] : hosts) CHECK(kill(pid, 0) == 0);
  REQUIRE(system.apply(kRear).exit_code() == 0);
  CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  REQUIRE(system.apply(kWithThird).exit_code() == 0);
  CHECK(system.hears("] debug   talker: heard 1:", system.mark()));
  system.end_anyhow();
}

TEST_CASE("what cannot be done is refused before anything changes", "[system][renew]") {
  Renewing system;
  const auto hosts = system.hosts();
  Layout many;
  for (int i = 0; i < 17; ++i) {
    const std::string name = "p" + std::to_string(i);
    many.processes += "<process name=\"" + name + "\"/>";
    many.more +=
        "<component name=\"c" + std::to_string(i) + "\" type=\"test.OtherTeller\" process=\"" + name + "\"/>";
    many.more_connections += Layout::connection("talker.out", "c" + std::to_string(i) + ".in");
  }
  const Run too_many = system.apply(many);
  CHECK(too_many.exit_code() == 1);
  CHECK_THAT(too_many.err,
             Contains("too many processes have come and gone in this run; start the system again"));
  CHECK(system.runs_like(kStart));
  CHECK(system.hosts() == hosts);
  system.end();
}

TEST_CASE("while the robot drives, a behaviour goes to a process of its own, and the robot reaches its goals",
          "[system][renew]") {
  const TempFolder folder;
  // As a graph that somebody has written: the settings of the command line are for it, too.
  const std::string text = replaced(printed("scout_goto_processes"), " expanded=\"true\"", "");
  const std::string start = folder.write("start.xml", text);
  const std::string own =
      folder.write("own.xml", replaced(replaced(text, "type=\"orca.SonarAvoid\" process=\"behaviours\"",
                                                "type=\"orca.SonarAvoid\" process=\"avoidance\""),
                                       "<process name=\"command\"",
                                       "<process name=\"avoidance\"/><process name=\"command\""));
  Subprocess program(deployer({start, "--set", "command.goals=hall: 3.6 6; end: 4.6 6"}));
  const auto drives = [] {
    return run_orcactl({"hz", "base.MotionCommandSend", "--for", "300ms"}).exit_code() == 0;
  };
  REQUIRE(comes_true(drives, Seconds(10)));
  const pid_t base = children_of(program.pid()).at("base");
  const Run applied = run_orcactl({"apply", own});
  INFO(applied.err << program.err());
  REQUIRE(applied.exit_code() == 0);
  CHECK(children_of(program.pid()).at("base") == base);
  CHECK(children_of(program.pid()).contains("avoidance"));
  const Run run = finish(program, Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("arrived hall") && Contains("arrived end"));
  CHECK_FALSE(run.says("PROCESS_ENDED"));
}
