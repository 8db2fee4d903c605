// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl apply from one random graph to another, first with a fault in one of its steps, then without: the system is as
// before, then as a system that was started with the other graph.
#include <signal.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <functional>
#include <memory>
#include <sstream>
#include <thread>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "random_layout.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

using Names = std::set<std::string>;

std::string next_plugin(const std::string& name) {
  return ORCA_BINARY_DIR "/tests/next_plugins/" + name + ".so";
}

// What an apply is going to do, as diff tells it.
struct Preview {
  Names renewed;  // processes that begin, end or begin anew
  Names efforts;
  Seconds reading{0};  // how long it took to read and compare the file
};

// A running system that goes over to other graphs.
class Changing {
 public:
  explicit Changing(const Layout& layout) : layout_(layout) {
    const fs::path plugins = folder_.file("plugins");
    fs::create_directory(plugins);
    for (const char* const name :
         {"host_plugins/test_talker", "host_plugins/test_napper", "host_plugins/test_homesick",
          "next_plugins/test_teller_heir", "next_plugins/test_teller_other_heir"})
      copy_plugin(ORCA_BINARY_DIR "/tests/" + std::string(name) + ".so", plugins);
    program_ = std::make_unique<Subprocess>(deployer({write(layout), "--log", "debug"}));
    const bool came = delivers(layout);
    INFO(log());
    REQUIRE(came);
  }

  // What it runs, or is to run.
  [[nodiscard]] Layout& layout() { return layout_; }
  [[nodiscard]] std::string write(const Layout& layout) const {
    return folder_.write("new.xml", text_of(layout, folder_.file("plugins")));
  }
  // Lets test.BrokenTeller be of one of its plugins.
  void put_broken_teller(const std::string& name) {
    for (const std::string& file : std::exchange(broken_, {})) fs::remove(file);
    copy_plugin(next_plugin(name), folder_.file("plugins"));
    for (const std::string kind : {".so", ".types"})
      broken_.push_back(folder_.file("plugins/" + name + kind));
  }

  [[nodiscard]] Run apply(const Layout& layout) const {
    return run_orcactl(Words{"apply", write(layout)} + kBriefly, Seconds(60));
  }
  [[nodiscard]] Preview preview(const Layout& layout) const {
    Preview preview;
    const Run run = run_orcactl({"diff", write(layout)});
    preview.reading = run.ending.wall;
    const auto note = [&](const std::string& line, const std::string& effect, const std::string& effort) {
      if (line.find(effect) != std::string::npos) preview.efforts.insert(effort);
    };
    for (const std::string& line : run.lines()) {
      if (line.starts_with("= process ")) preview.renewed.insert(line.substr(10, line.find(' ', 10) - 10));
      note(line, "then exchanged between two laps", "code is exchanged");
      note(line, "between two laps; nothing stops", "parameters change");
      note(line, "comes up beside the others", "components come");
      note(line, "ends when its connections are gone", "components go");
      note(line, "no other connection notices", "connections change");
      note(line, "its process is started again", "processes begin anew");
    }
    return preview;
  }
  [[nodiscard]] bool runs_like(const Layout& layout) const {
    return run_orcactl({"diff", write(layout)}).out.find("the system runs like that already") !=
           std::string::npos;
  }
  // Returns whether a system that was started with a graph would be told to be the same.
  [[nodiscard]] bool is_as_started_with(const Layout& layout) const {
    const TempFolder runtime;
    const Words there{"/usr/bin/env", "XDG_RUNTIME_DIR=" + runtime.path().string()};
    Subprocess started(there + deployer({write(layout), "--log", "error"}));
    std::string shown;
    const auto shows = [&] {
      Subprocess orcactl_there(there + orcactl({"graph", "--json"}));
      const Run run = finish(orcactl_there, Seconds(10));
      shown = run.out;
      return run.exit_code() == 0;
    };
    REQUIRE(comes_true(shows, Seconds(20)));
    started.send(SIGTERM);
    CHECK(finish(started, Seconds(10)).ended);
    return shown == graph();
  }

  [[nodiscard]] static std::string graph() { return run_orcactl({"graph", "--json"}).out; }
  [[nodiscard]] std::size_t mark() const { return program_->err().size(); }
  [[nodiscard]] std::string log() const { return program_->err(); }
  [[nodiscard]] std::map<std::string, pid_t> hosts() const { return children_of(program_->pid()); }
  [[nodiscard]] bool hears(const std::string& text, std::size_t mark) const {
    const auto has_come = [&] {
      std::this_thread::sleep_for(Seconds(0.01));  // each look reads the whole log
      return program_->err().find(text, mark) != std::string::npos;
    };
    return comes_true(has_come, Seconds(20));
  }
  // Returns whether each talker hears the teller that it is to hear. Then what was lost before is in the log.
  [[nodiscard]] bool delivers(const Layout& layout) const {
    std::this_thread::sleep_for(Seconds(0.1));  // the log comes a little late
    const std::size_t mark = this->mark();
    return std::ranges::all_of(layout.duos, [&](const Duo& duo) {
      return hears("] debug   " + duo.name + ": heard " + layout.heard_by(duo) + ":", mark);
    });
  }
  void end() const {
    CHECK(run_orcactl({"stop"}).exit_code() == 0);
    CHECK(finish(*program_, Seconds(10)).ended);
  }

 private:
  TempFolder folder_;
  Layout layout_;
  std::unique_ptr<Subprocess> program_;
  std::vector<std::string> broken_;
};

// Checks that no object was lost on connections that both graphs have, from and to processes that went on.
void check_losses(const std::string& log, const Layout& before, const Layout& after, const Names& disturbed) {
  for (const Duo& duo : before.duos) {
    const Duo* const then = after.find(duo.name);
    const bool stays = then != nullptr && then->talks == duo.talks && then->counts == duo.counts &&
                       !disturbed.contains(duo.talks) && !disturbed.contains(duo.counts);
    if (!stays || disturbed.contains(duo.teller())) continue;
    if (then->queue == duo.queue) CHECK_THAT(log, !Contains("] debug   " + duo.teller() + ": gap"));
    if (then->is_poked && duo.is_poked)
      CHECK_THAT(log, !Contains("] debug   " + duo.teller() + ": poke") &&
                          !Contains("] debug   " + duo.name + ": not sent"));
  }
}

// A way from one graph to another, and what is wrong with it.
struct Way {
  Changing& system;
  LayoutDice& dice;
  Layout wanted{};
  Layout broken{};        // what is wanted, with a fault
  Names disturbed{};      // processes and components that lose what is under way
  std::string awaited{};  // what the log says when the system is at rest again
};

// --- Faults

void break_teller(Way& way, const std::string& plugin) {
  way.system.put_broken_teller(plugin);
  way.broken.duo("zed").broken = "test.BrokenTeller";
}

// A component that cannot be configured in a process, although it can be where the graph is checked.
std::string homesick(const std::string& where, const std::map<std::string, std::string>& params) {
  std::map<std::string, std::string> all = params;
  all["abroad"] = where;
  return element("last", "test.Homesick", where, all);
}

bool exchanges(const Layout& before, const Layout& after) {
  return std::ranges::any_of(after.duos, [&](const Duo& duo) {
    const Duo* const now = before.find(duo.name);
    return now != nullptr && now->is_other != duo.is_other;
  });
}

// Lets a napper sleep so long that no step can wait for the end of its lap.
void fall_asleep(Way& way, const std::string& who) {
  static int naps = 0;
  Layout& now = way.system.layout();
  const double exchange = exchanges(now, way.wanted) ? 3.5 : 0.0;
  const double seconds = (7.0 + exchange) * kSlowdown / 4.0 + 0.01 * ++naps;
  const std::size_t mark = way.system.mark();
  for (Layout* const layout : {&now, &way.wanted, &way.broken})
    (who == "napper" ? layout->nap : layout->sleep) = std::to_string(seconds) + " s";
  const Run set = way.system.apply(now);
  INFO(set.err);
  REQUIRE(set.exit_code() == 0);
  REQUIRE(way.system.hears(who + ": naps", mark));
  way.awaited = who + ": wakes up";
}

void change_queue(Way& way) { way.broken.naps_queue = way.wanted.naps_queue == 1000 ? 500 : 1000; }

// Lets a process begin anew with a component that cannot be there.
void begin_anew(Way& way, const std::map<std::string, std::string>& params) {
  const std::string name = way.broken.processes.empty() ? "rear" : way.broken.processes.begin()->first;
  way.broken.processes[name] = " spin=\"0.2 ms\"";
  way.broken.more = homesick(name, params);
}

// Lets the way take some seconds, half of the times.
void exchange_now_and_then(Way& way) {
  if (way.dice.below(2) == 0) return;
  for (Layout* const layout : {&way.wanted, &way.broken}) layout->duo("zed").is_other ^= true;
}

struct Fault {
  std::string kind;
  std::function<void(Way&)> plant;
  std::string says;  // part of the error
  int signal = 0;    // for a process, at a random moment
};

const std::vector<Fault>& all_faults() {
  static const std::vector<Fault> faults{
      {"the file is wrong", [](Way& way) { way.broken.duo("zed").broken = "test.Nobody"; }, "test.Nobody"},
      {"new code fails in its trial", [](Way& way) { break_teller(way, "test_teller_broken"); },
       "in the shadow"},
      {"new code refuses the state", [](Way& way) { break_teller(way, "test_teller_refuses_state"); },
       "no state for me"},
      {"new code fails on probation",
       [](Way& way) {
         break_teller(way, "test_teller_lap_in_still");
         way.disturbed = {"zed_teller"};  // what the new object has taken is lost
       },
       "no lap in still"},
      {"a parameter is refused", [](Way& way) { way.broken.mood = "bad"; }, "spoils its sleep"},
      {"a new component's constructor fails",
       [](Way& way) {
         way.system.put_broken_teller("test_teller_constructor_in_still");
         way.broken.more = element("last", "test.BrokenTeller", "still") + connection("zed.out", "last.in");
       },
       "no teller in still"},
      {"a new component's configure() refuses", [](Way& way) { way.broken.more = homesick("still", {}); },
       "last: configure() said: this is not home"},
      {"a new component's configure() crashes",
       [](Way& way) {
         way.broken.more = homesick("still", {{"crashes", "true"}});
         way.disturbed = {"still"};
         way.awaited = "process still is back";
       },
       "process still"},
      {"a process that begins anew refuses", [](Way& way) { begin_anew(way, {}); }, "this is not home"},
      {"a process that begins anew crashes",
       [](Way& way) {
         begin_anew(way, {{"crashes", "true"}});
       },
       "SIGSEGV"},
      {"a process is killed", exchange_now_and_then, "", SIGKILL},
      {"a process hangs", exchange_now_and_then, "", SIGSTOP},
      {"a parameter comes in a long lap",
       [](Way& way) {
         fall_asleep(way, "napper");
         way.broken.mood = "fair";
       },
       "napper: it has not come to the end of a lap in time"},
      {"a client is in a long lap",
       [](Way& way) {
         fall_asleep(way, "napper");
         change_queue(way);
       },
       "napper: it has not come to the end of a lap in time"},
      {"a server is in a long lap",
       [](Way& way) {
         fall_asleep(way, "sleeper");
         change_queue(way);
       },
       "sleeper: it has not come to the end of a lap in time"}};
  return faults;
}

// Applies a graph, and sends a signal to some process meanwhile. While the file is read nothing comes of that.
Run apply_and_signal(Way& way, const Preview& preview, int signal) {
  const Seconds work(preview.efforts.contains("code is exchanged") ? 3.5 : 0.1);
  Subprocess order(orcactl({"apply", way.system.write(way.broken)}));
  std::this_thread::sleep_for(0.8 * preview.reading + way.dice.share() * (0.2 * preview.reading + work));
  const auto [name, pid] = way.dice.one_of(way.system.hosts());
  kill(pid, signal);
  way.disturbed.insert(name);
  return finish(order, Seconds(60));
}

// --- The property

// How often each kind of fault was planted, and each kind of step was planned with a fault.
struct Tally {
  std::map<std::string, int> planted;
  std::map<std::string, int> undone;
  std::map<std::string, int> steps;

  [[nodiscard]] std::string text() const {
    std::ostringstream text;
    for (const auto& [kind, times] : planted)
      text << kind << ": " << times << " times, undone " << (undone.contains(kind) ? undone.at(kind) : 0)
           << "\n";
    for (const auto& [step, times] : steps) text << step << " in " << times << " graphs that were undone\n";
    return text.str();
  }
};

// Applies the graph with the fault. Returns whether it was undone; a process may have been killed too late for that.
bool fail_to_apply(Way& way, const Fault& fault, Tally& tally) {
  const Layout before = way.system.layout();
  const Preview preview = way.system.preview(way.broken);
  const std::string graph = Changing::graph();
  const std::size_t mark = way.system.mark();
  const Run run =
      fault.signal != 0 ? apply_and_signal(way, preview, fault.signal) : way.system.apply(way.broken);
  way.disturbed.insert(preview.renewed.begin(), preview.renewed.end());
  INFO(run.out << run.err << way.system.log().substr(mark));
  ++tally.planted[fault.kind];
  if (fault.signal == 0) CHECK(run.exit_code() == 1);
  CHECK_THAT(run.err, Contains(fault.says) && !Contains("could not go back"));
  if (!way.awaited.empty()) CHECK(way.system.hears(way.awaited, mark));
  const bool is_undone = run.exit_code() != 0;
  if (!is_undone) way.system.layout() = way.wanted;
  const Layout& now = way.system.layout();
  CHECK(way.system.delivers(now));
  CHECK(way.system.runs_like(now));
  check_losses(way.system.log().substr(mark), before, way.broken, way.disturbed);
  if (!is_undone) return false;
  CHECK(Changing::graph() == graph);
  ++tally.undone[fault.kind];
  for (const std::string& step : preview.efforts) ++tally.steps[step];
  return true;
}

void apply_at_last(Way& way, bool was_signalled) {
  const Layout before = way.system.layout();
  const Preview preview = way.system.preview(way.wanted);
  const std::size_t mark = way.system.mark();
  Run run;
  const auto applies = [&] {
    run = way.system.apply(way.wanted);
    return run.exit_code() == 0;
  };
  const bool applied = was_signalled ? comes_true(applies, Seconds(10)) : applies();
  INFO(run.out << run.err << way.system.log().substr(mark));
  REQUIRE(applied);
  way.system.layout() = way.wanted;
  CHECK(way.system.delivers(way.wanted));
  CHECK(way.system.runs_like(way.wanted));
  CHECK(way.system.is_as_started_with(way.wanted));
  check_losses(way.system.log().substr(mark), before, way.wanted, preview.renewed);
}

void go_over(Changing& system, LayoutDice& dice, const Fault& fault, Tally& tally) {
  Way way{system, dice};
  way.wanted = way.broken = dice.next(system.layout());
  fault.plant(way);
  INFO("from " << text_of(system.layout(), "") << "to " << text_of(way.broken, ""));
  fail_to_apply(way, fault, tally);
  apply_at_last(way, fault.signal != 0);
}

void go_over_to_many(int pairs, double exchanges) {
  constexpr unsigned kSeed = 16;
  constexpr int kPairsOfSystem = 10;  // each look at a log reads all of it
  LayoutDice dice(kSeed, exchanges);
  Tally tally;
  std::unique_ptr<Changing> system;
  for (int i = 0; i < pairs; ++i) {
    const Fault& fault = all_faults()[static_cast<std::size_t>(i) % all_faults().size()];
    CAPTURE(kSeed, i, fault.kind);
    if (!kTriesInShadow && fault.kind == "new code fails in its trial") continue;
    if (i % kPairsOfSystem == 0) {
      Layout layout = system == nullptr ? Layout{} : system->layout();
      layout.nap = layout.sleep = "0 s";
      if (system != nullptr) system->end();
      system = std::make_unique<Changing>(layout);
    }
    go_over(*system, dice, fault, tally);
  }
  system->end();
  WARN(pairs << " pairs of graphs\n" << tally.text());
  for (const Fault& fault : all_faults()) {
    CAPTURE(fault.kind);
    const bool may_come_too_late = fault.signal != 0 && pairs < 100;
    if (!may_come_too_late && (kTriesInShadow || fault.kind != "new code fails in its trial"))
      CHECK(tally.undone[fault.kind] > 0);
  }
  for (const std::string step : {"code is exchanged", "parameters change", "components come", "components go",
                                 "connections change", "processes begin anew"})
    CHECK(tally.steps[step] > 0);
}

}  // namespace

TEST_CASE(
    "a graph that cannot be applied leaves the system as it was, and one that can makes it what the graph "
    "says",
    "[system][apply]") {
  go_over_to_many(25, 0.1);
}

TEST_CASE("an exchange goes back at its end if another process was lost during its probation",
          "[system][apply]") {
  Changing system{Layout{}};
  const Layout before = system.layout();
  Layout wanted = before;
  wanted.duo("zed").is_other = true;
  const std::string graph = Changing::graph();
  const std::size_t mark = system.mark();
  Subprocess order(orcactl({"apply", system.write(wanted)}));
  REQUIRE(system.hears("zed: heard 7:", mark));
  kill(system.hosts().at("front"), SIGKILL);
  const Run run = finish(order, Seconds(20));
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.err, Contains("process front ended") && !Contains("could not go back"));
  CHECK(system.runs_like(before));
  CHECK(system.delivers(before));
  CHECK(Changing::graph() == graph);
  system.end();
}

TEST_CASE("two hundred pairs of graphs, each first with a fault", "[.][slow][apply]") {
  go_over_to_many(200, 0.4);
}
