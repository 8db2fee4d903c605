// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl diff and apply, and deployer --watch on the graph: a running system becomes what another graph says, or stays
// exactly as it is.
#include <signal.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <memory>
#include <regex>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

// What a graph of the tellers says.
struct Wish {
  std::string first = "test.Teller";  // types
  std::string second = "test.Teller";
  int step = 1;
  std::string more{};   // elements
  std::string rules{};  // attributes of the graph
  bool is_reordered = false;
  bool has_second = true;
};

// Graphs of two tellers, the first of which tells a talker its version a hundred times a second, and their plugins.
class Tellers {
 public:
  /// @param broken  the plugin of test.BrokenTeller.
  explicit Tellers(const std::string& broken = "test_teller_throwing") {
    const fs::path plugins = folder_.file("plugins");
    fs::create_directory(plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/host_plugins/test_talker.so", plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/host_plugins/test_teller.so", plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/next_plugins/test_teller_other.so", plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/next_plugins/" + broken + ".so", plugins);
  }

  // Writes a graph, and returns its file.
  std::string write(const std::string& name, const Wish& wish) const {
    const std::string first = "<component name=\"a\" type=\"" + wish.first +
                              "\"><param name=\"step\" value=\"" + std::to_string(wish.step) +
                              "\"/></component>";
    std::string second;
    if (wish.has_second)
      second = "<component name=\"b\" type=\"" + wish.second +
               "\" autonomous=\"true\"/><connect from=\"talker.out\" to=\"b.in\" queue=\"1000\"/>";
    return folder_.write(name, "<graph name=\"applied\" version=\"1\" " + wish.rules +
                                   " on_supervisor_loss=\"continue\" plugins=\"" + folder_.file("plugins") +
                                   "\">" + (wish.is_reordered ? second + first : first + second) +
                                   "<component name=\"talker\" type=\"test.Talker\"/>"
                                   "<connect from=\"talker.out\" to=\"a.in\" queue=\"1000\"/>"
                                   "<connect from=\"talker.poke\" to=\"a.poke\" queue=\"1000\"/>"
                                   "<connect from=\"a.out\" to=\"talker.back\" queue=\"1000\"/>" +
                                   wish.more + "</graph>");
  }

 private:
  TempFolder folder_;
};

// A system of the tellers, and what it may become.
class Applied {
 public:
  explicit Applied(const Words& options = {}) : file_(write("now.xml", {})) { start(options); }

  std::string write(const std::string& name, const Wish& wish) const { return tellers_.write(name, wish); }

  void start(const Words& options = {}) {
    program_ = std::make_unique<Subprocess>(deployer(Words{file_, "--log", "debug"} + options));
    REQUIRE(hears("heard 1:10"));
  }
  // Kills the deployer, and starts another one with this graph.
  void start_anew(const std::string& file) {
    program_->send(SIGKILL);
    REQUIRE(program_->wait(Seconds(2)));
    killed_ = std::move(program_);  // with its object, what it has started would end
    program_ = std::make_unique<Subprocess>(deployer({file, "--log", "debug"}));
  }

  [[nodiscard]] Run apply(const Wish& wish) const {
    return run_orcactl(Words{"apply", write("new.xml", wish)} + kBriefly, Seconds(40));
  }
  [[nodiscard]] Run diff(const Wish& wish) const {
    return run_orcactl({"diff", write("new.xml", wish)}, Seconds(20));
  }
  [[nodiscard]] std::size_t mark() const { return program_->err().size(); }
  [[nodiscard]] pid_t host() const { return children_of(program_->pid()).at("main"); }
  [[nodiscard]] std::string log() const { return program_->err(); }
  bool hears_after(const std::string& text, std::size_t mark) {
    return comes_true([&] { return program_->err().find(text, mark) != std::string::npos; }, Seconds(20));
  }
  bool hears(const std::string& text) { return program_->wait_for_output(text, Seconds(20) * kSlowdown); }

  std::string end() { return stop_without_gaps(*program_); }

 private:
  const Tellers tellers_{"test_teller_broken"};
  std::string file_;
  std::unique_ptr<Subprocess> killed_;
  std::unique_ptr<Subprocess> program_;
};

// What a program can see of the running system, without what changes by itself.
std::string all_that_is_seen() {
  const std::regex figures(R"re("(memory_mb|log_per_s)": [^,}\n]*)re");
  return run_orcactl({"graph", "--json"}).out +
         std::regex_replace(run_orcactl({"ps", "--json"}).out, figures, "\"$1\"") +
         run_orcactl({"get", "a", "--json"}).out + run_orcactl({"get", "b", "--json"}).out;
}

// Puts VFH+ into the place of LaserAvoid in the Pioneer's graph, which then may lie in any folder.
std::string with_vfh_plus(std::string graph) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    std::size_t at = graph.find(from);
    REQUIRE(at != std::string::npos);
    for (; at != std::string::npos; at = graph.find(from, at + to.size())) graph.replace(at, from.size(), to);
  };
  replace("\"../sim/", "\"" + source_file("sim/"));
  replace("name=\"avoid\" default=\"orca.LaserAvoid\"", "name=\"avoid\" default=\"orca.VfhPlus\"");
  return graph;
}

}  // namespace

TEST_CASE("what runs is printed as a graph, and applying that goes back to it", "[system][apply]") {
  Applied system;
  REQUIRE(system.apply({.first = "test.OtherTeller", .step = 2}).exit_code() == 0);
  REQUIRE(run_orcactl({"set", "b.step", "3"}).exit_code() == 0);
  const Run graph = run_orcactl({"graph", "--running"});
  REQUIRE(graph.exit_code() == 0);
  const TempFolder elsewhere;
  const std::string file = elsewhere.write("before.xml", graph.out);
  CHECK_THAT(run_orcactl({"diff", file}).out, Contains("runs like that already"));
  const Run away = system.apply({});
  INFO(away.err << system.log());
  REQUIRE(away.exit_code() == 0);
  CHECK(run_orcactl({"graph", "--running"}).out != graph.out);
  const Run back = run_orcactl(Words{"apply", file} + kBriefly, Seconds(40));
  INFO(back.err);
  REQUIRE(back.exit_code() == 0);
  CHECK(run_orcactl({"graph", "--running"}).out == graph.out);
  CHECK_THAT(run_orcactl({"ps"}).out, Contains("test.OtherTeller"));
  CHECK_THAT(run_orcactl({"get", "b.step"}).out, Contains(" 3"));
  system.end();
}

TEST_CASE("the difference to what runs is shown with its cost, and nothing changes", "[system][apply]") {
  Applied system;
  const std::string before = all_that_is_seen();
  const Run same = system.diff({});
  CHECK(same.exit_code() == 0);
  CHECK_THAT(same.out, Contains("runs like that already"));
  const Run run = system.diff({.first = "test.OtherTeller", .step = 2, .rules = "restarts=\"7\""});
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 0);
  CHECK_THAT(run.out, Contains("~ component a") && Contains("test.OtherTeller") && Contains("param step"));
  CHECK_THAT(run.out, Contains("exchanged between two laps"));
  CHECK_THAT(run.out, Contains("restarts") && Contains("only when the system is started again"));
  CHECK(all_that_is_seen() == before);
  system.end();
}

TEST_CASE("types and parameters change while the system runs, and a process that starts again has them",
          "[system][apply]") {
  Applied system;
  REQUIRE(run_orcactl({"set", "a.step", "3"}).exit_code() == 0);
  const Run run = system.apply({.first = "test.OtherTeller", .step = 2});
  INFO(run.out << run.err);
  REQUIRE(run.exit_code() == 0);
  CHECK(system.hears("heard 7:"));
  CHECK_THAT(run_orcactl({"ps"}).out, Contains("test.OtherTeller"));
  CHECK_THAT(run_orcactl({"get", "a.step"}).out, Contains(" 2 "));
  CHECK_THAT(run_orcactl({"graph"}).out, Contains("test.OtherTeller"));
  CHECK_THAT(system.diff({.first = "test.OtherTeller", .step = 2}).out, Contains("runs like that already"));
  REQUIRE(system.apply({.first = "test.OtherTeller", .step = 5}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"get", "a.step"}).out, Contains(" 5 "));
  REQUIRE(run_orcactl({"restart", "a"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"ps"}).out, Contains("test.OtherTeller"));
  CHECK_THAT(run_orcactl({"get", "a.step"}).out, Contains(" 5 "));
  const std::size_t mark = system.mark();
  CHECK(system.hears_after("heard 7:", mark));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE(
    "a process is not ended for an operator while a plugin is missing without which it would not come back",
    "[system][apply]") {
  Applied system;
  const fs::path plugin = fs::path(system.write("x.xml", {})).parent_path() / "plugins/test_talker.so";
  fs::rename(plugin, plugin.string() + ".away");
  const pid_t host = system.host();
  const Run refused = run_orcactl({"restart", "a"});
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err,
             Contains("test_talker.so") && Contains("is not there any more") && Contains("put it back"));
  CHECK(system.host() == host);
  fs::rename(plugin.string() + ".away", plugin);
  CHECK(run_orcactl({"restart", "a"}).exit_code() == 0);
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("if a later step fails, what was exchanged is exchanged back", "[system][apply]") {
  if (!kTriesInShadow) return;
  Applied system;
  const std::string before = all_that_is_seen();
  const Run run = system.apply({.first = "test.OtherTeller", .second = "test.BrokenTeller", .step = 2});
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.err, Contains("b: ") && Contains("its laps, in the shadow of the present one"));
  CHECK(system.hears("heard 7:"));  // the first step had been made
  const std::size_t mark = system.mark();
  CHECK(system.hears_after("heard 1:", mark));
  CHECK(all_that_is_seen() == before);
  system.end();
}

TEST_CASE("a graph that is wrong, or asks for more, is refused before anything changes", "[system][apply]") {
  Applied system;
  const std::string before = all_that_is_seen();
  const Run wrong = system.apply({.first = "test.Nobody", .second = "test.Nothing"});
  CHECK(wrong.exit_code() == 1);
  CHECK_THAT(wrong.err, Contains("\"test.Nobody\"") && Contains("\"test.Nothing\""));
  const Run more = system.apply({.step = 2, .rules = "restarts=\"7\""});
  CHECK(more.exit_code() == 1);
  CHECK_THAT(more.err, Contains("started again for ~ graph: restarts"));
  CHECK(run_orcactl({"apply", "/nowhere/at_all.xml"}).exit_code() == 1);
  const Run longer = run_orcactl({"apply", system.write("new.xml", {.step = 2}), "--tryout", "2 min"});
  CHECK(longer.exit_code() == 1);
  CHECK_THAT(longer.err, Contains("--tryout can be 60 s at most"));
  CHECK(all_that_is_seen() == before);
  CHECK_THAT(system.end(), !Contains("heard 7:"));
}

TEST_CASE("while one graph is applied another is refused", "[system][apply]") {
  Applied system;
  Subprocess first(
      orcactl(Words{"apply", system.write("first.xml", {.first = "test.OtherTeller"})} + kBriefly));
  REQUIRE(system.hears("is to be exchanged"));
  const Run second = system.apply({.step = 2});
  CHECK(second.exit_code() == 1);
  CHECK_THAT(second.err, Contains("try again when that is done"));
  CHECK(finish(first, Seconds(20)).exit_code() == 0);
  CHECK_THAT(run_orcactl({"get", "a.step"}).out, Contains(" 1 "));
  system.end();
}

TEST_CASE("if a process ends in the middle, everything is as before", "[system][apply]") {
  Applied system;
  const std::string before = run_orcactl({"graph", "--json"}).out;
  Subprocess order(orcactl(
      {"apply", system.write("new.xml", {.first = "test.OtherTeller", .second = "test.OtherTeller"})}));
  REQUIRE(system.hears("heard 7:"));  // the first exchange is made, and on probation
  REQUIRE(kill(system.host(), SIGKILL) == 0);
  const Run run = finish(order, Seconds(20));
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  REQUIRE(system.hears("process main is back"));
  const std::size_t mark = system.mark();
  CHECK(system.hears_after("heard 1:", mark));
  CHECK(run_orcactl({"graph", "--json"}).out == before);
  CHECK_THAT(run_orcactl({"ps"}).out, !Contains("OtherTeller"));
  CHECK_THAT(system.diff({}).out, Contains("runs like that already"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("another deployer that goes on with the run needs the graph that was applied", "[system][apply]") {
  Applied system;
  const bool is_restarted = GENERATE(false, true);
  CAPTURE(is_restarted);
  const std::string applied = system.write("new.xml", {.step = 4, .is_reordered = true});
  REQUIRE(run_orcactl(Words{"apply", applied} + kBriefly).exit_code() == 0);
  if (is_restarted) REQUIRE(run_orcactl({"restart", "a"}).exit_code() == 0);
  system.start_anew(applied);
  const bool is_adopted = system.hears("process main is adopted");
  INFO(system.log());
  CHECK(is_adopted);
  CHECK(comes_true(
      [] {
        return run_orcactl({"get", "a.step"}).out.find(" 4 ") != std::string::npos;
      },
      Seconds(5)));
  system.end();
}

TEST_CASE("with --watch a graph that is saved is carried out, and one that is wrong is not",
          "[system][apply]") {
  Applied system({"--watch"});
  system.write("now.xml", {.step = 2});
  REQUIRE(system.hears("saved: ~ component a, param step: 1 -> 2"));
  std::size_t mark = system.mark();
  system.write("now.xml", {.first = "test.Nobody"});
  REQUIRE(system.hears_after("all goes on as before", mark));
  CHECK_THAT(run_orcactl({"get", "a.step"}).out, Contains(" 2 "));
  mark = system.mark();
  system.write("now.xml", {.first = "test.OtherTeller", .step = 3});
  REQUIRE(system.hears_after("heard 7:", mark));
  CHECK(comes_true(
      [] {
        return run_orcactl({"get", "a.step"}).out.find(" 3 ") != std::string::npos;
      },
      Seconds(10)));
  system.end();
}

TEST_CASE("a change at a time known before is part of a run that repeats bit for bit", "[system][apply]") {
  const TempFolder folder;
  const std::string now = source_file("graphs/pioneer_laser_goto.xml");
  const std::string other = folder.write("vfh.xml", with_vfh_plus(read_text(now)));
  const auto hash_after = [&](const Words& more) {
    const Run run = run_deployer(Words{now, "--until", "25 s"} + virtual_clock() + more, Seconds(60));
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.says("changes to ") == !more.empty());
    return run.trace_hash();
  };
  const auto plain = hash_after({});
  REQUIRE(plain);
  const auto changed = hash_after({"--change", other + "@10s"});
  CHECK(changed != plain);
  CHECK(hash_after({"--change", other + "@10s"}) == changed);
  CHECK(hash_after({"--change", other + "@20s"}) != changed);
  CHECK(hash_after({"--change", now + "@10s"}) == plain);  // nothing differs
  CHECK(hash_after({"--change", now + "@20s", "--change", other + "@10s"}) != changed);
}

TEST_CASE("a change that the graph names is carried out as one of the command line", "[system][apply]") {
  const std::string graph = source_file("sim/experiments/vfh_on_the_way.xml");
  const std::string other = source_file("sim/experiments/vfh_on_the_way/vfh.xml");
  const Run run = run_deployer(Words{graph} + virtual_clock(), Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 3);
  CHECK(run_deployer(Words{graph} + virtual_clock(), Seconds(60)).trace_hash() == run.trace_hash());
  const TempFolder folder;
  const std::string trace = folder.file("trace");
  CHECK(run_deployer(Words{graph, "--trace", trace} + virtual_clock(), Seconds(60)).trace_hash() ==
        run.trace_hash());
  CHECK_THAT(read_text(trace), Contains("20.000000 exchange avoid orca.LaserAvoid orca.VfhPlus 0.000000"));
  Subprocess drawing(
      {"/usr/bin/env", "python3", source_file("docs/pictures/swap_timeline.py"), trace, "avoid"});
  const Run drawn = finish(drawing, Seconds(20));
  CHECK(drawn.exit_code() == 0);
  CHECK_THAT(drawn.out, Contains("orca.LaserAvoid gives way to orca.VfhPlus") &&
                            Contains("avoid.laser: LaserRangeReadings"));
  std::string plain = read_text(graph);
  plain.replace(plain.find("../../graphs/", plain.find("<graph")), 13, source_file("graphs/"));
  plain.erase(plain.find("<change "), plain.find("/>", plain.find("<change ")) + 2 - plain.find("<change "));
  const std::string without = folder.write("without.xml", plain);
  const Run ordered = run_deployer(Words{without, "--change", other + "@20s"} + virtual_clock(), Seconds(60));
  CHECK(ordered.trace_hash() == run.trace_hash());
  const Run slower = run_deployer(Words{without} + virtual_clock(), Seconds(60));
  REQUIRE(slower.arrivals().size() == 3);
  CHECK(slower.trace_hash() != run.trace_hash());  // it is a change
  CHECK(slower.arrivals()[2].t > run.arrivals()[2].t);
}

TEST_CASE("a change that the graph names and that cannot be made is refused at its place",
          "[system][apply]") {
  const TempFolder folder;
  const auto refusal = [&](const std::string& change, const Words& words) {
    const Run run = run_deployer(
        Words{folder.write(
            "now.xml",
            "<graph name=\"vfh_on_the_way\" version=\"1\" default_profile=\"sim\">\n<include file=\"" +
                source_file("graphs/pioneer_laser_goto.xml") + "\"/>\n" + change + "</graph>")} +
        words);
    CHECK(run.exit_code() == 2);
    return run.err;
  };
  const std::string other = source_file("graphs/scout_goto.xml");
  for (const Words& words : {Words{"--check"}, virtual_clock()})
    CHECK_THAT(refusal("<change at=\"1 s\" graph=\"" + other + "\"/>", words),
               Contains("now.xml:3:1: error G074") && Contains("has to be started again for"));
  CHECK_THAT(refusal("<change at=\"1 s\" graph=\"none.xml\"/>", {"--check"}), Contains("none.xml"));
  const Run as_json = run_deployer({folder.file("now.xml"), "--check", "--json"});
  CHECK(as_json.exit_code() == 2);
  CHECK_THAT(as_json.out, Contains("\"errors\": 1") && Contains("none.xml"));
}

TEST_CASE("a component does not go while its new code is on probation", "[system][apply]") {
  const Tellers tellers;
  const std::string without = tellers.write("without.xml", {.has_second = false});
  const Run run = run_deployer(Words{tellers.write("now.xml", {}), "--until", "6 s", "--change",
                                     tellers.write("new.xml", {.second = "test.OtherTeller"}) + "@1s",
                                     "--change", without + "@2s"} +
                               virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.err, Contains("still being exchanged"));
}

TEST_CASE("a change that fails makes the run a failure, and one that never came is reported",
          "[system][apply]") {
  const Tellers tellers;
  const auto run_with = [&](const Wish& wish, const std::string& at) {
    return run_deployer(Words{tellers.write("now.xml", {}), "--until", "3 s", "--change",
                              tellers.write("new.xml", wish) + "@" + at} +
                        virtual_clock());
  };
  const Run fails = run_with({.first = "test.BrokenTeller"}, "1s");
  INFO(fails.err);
  CHECK(fails.exit_code() == 1);
  CHECK_THAT(fails.err, Contains("the change to ") && Contains("no lap today"));
  const Run late = run_with({.step = 2}, "10s");
  CHECK(late.exit_code() == 0);
  CHECK_THAT(late.err, Contains("the run ended before its change to ") && !Contains("changes to "));
}

TEST_CASE("a change that cannot be made is refused before the run", "[system][apply]") {
  const std::string scout = source_file("graphs/scout_goto.xml");
  const std::string other = source_file("graphs/pioneer_laser_goto.xml");
  const auto refusal = [&](const Words& words) {
    const Run run = run_deployer(Words{scout} + words);
    CHECK(run.exit_code() == 2);
    CHECK_FALSE(run.says("arrived"));
    return run.err;
  };
  CHECK_THAT(refusal(virtual_clock() + Words{"--change", other + "@10s"}),
             Contains("has to be started again for"));
  CHECK_THAT(refusal(virtual_clock() + Words{"--change", "/nowhere.xml@10s"}), Contains("/nowhere.xml"));
  CHECK_THAT(refusal({"--change", scout + "@10s"}), Contains("orcactl apply"));
  CHECK_THAT(refusal({"--change", scout}), Contains("GRAPH@TIME"));
  CHECK_THAT(refusal({"--change", scout + "@soon"}), Contains("--change: "));
}
