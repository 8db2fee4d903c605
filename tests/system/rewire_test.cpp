// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl connect, disconnect and move, and apply with other connections: within a process and between processes.
#include <signal.h>

#include <catch2/catch.hpp>
#include <filesystem>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

std::string talker_back() { return "<connect from=\"a.out\" to=\"talker.back\" queue=\"1000\"/>"; }

// Tellers a (which says "1:N") and b ("7:N") count what a talker tells them, and one of them tells it back. It logs what it
// hears. The tellers note each object that they miss.
class Talk {
 public:
  // @param process  of the tellers; the talker is in "main".
  // @param more     elements of the graph
  explicit Talk(const std::string& process, const std::string& more = "") : process_(process) {
    const fs::path plugins = folder_.file("plugins");
    fs::create_directory(plugins);
    for (const std::string name : {"test_talker", "test_napper"})
      copy_plugin(ORCA_BINARY_DIR "/tests/host_plugins/" + name + ".so", plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/host_plugins/test_teller.so", plugins);
    copy_plugin(ORCA_BINARY_DIR "/tests/next_plugins/test_teller_other.so", plugins);
    file_ = write("talk.xml", talker_back(), more);
  }

  // Writes a graph with more connections and other elements, and returns its file.
  [[nodiscard]] std::string write(const std::string& name, const std::string& connections,
                                  const std::string& more = "") const {
    const std::string place = process_ == "main" ? "" : " process=\"" + process_ + "\"";
    return folder_.write(name, "<graph name=\"talk\" version=\"1\" plugins=\"" + folder_.file("plugins") +
                                   "\">" + (place.empty() ? "" : "<process name=\"" + process_ + "\"/>") +
                                   "<component name=\"a\" type=\"test.Teller\" autonomous=\"true\"" + place +
                                   "/><component name=\"b\" type=\"test.OtherTeller\" autonomous=\"true\"" +
                                   place +
                                   "/><component name=\"talker\" type=\"test.Talker\"/>"
                                   "<connect from=\"talker.out\" to=\"a.in\" queue=\"1000\"/>"
                                   "<connect from=\"talker.out\" to=\"b.in\" queue=\"1000\"/>"
                                   "<connect from=\"talker.poke\" to=\"a.poke\" queue=\"1000\"/>" +
                                   connections + more + "</graph>");
  }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::string& process() const { return process_; }

 private:
  const std::string process_;
  TempFolder folder_;
  std::string file_;
};

// A napper that hears another one, "sleeper", which is in the tellers' process.
std::string nappers(const std::string& process) {
  return "<component name=\"sleeper\" type=\"test.Napper\" process=\"" + process +
         "\" autonomous=\"true\"/><component name=\"napper\" type=\"test.Napper\" autonomous=\"true\"/>"
         "<connect from=\"sleeper.out\" to=\"napper.back\" queue=\"1000\"/>";
}

class Talking {
 public:
  // @param more  elements of the graph
  explicit Talking(const std::string& process, const std::string& more = "")
      : talk_(process, more), program_(deployer({talk_.file(), "--log", "debug"})) {
    REQUIRE(program_.wait_for_output("heard 1:10", Seconds(20) * kSlowdown));
  }

  [[nodiscard]] const Talk& talk() const { return talk_; }
  Subprocess& program() { return program_; }
  [[nodiscard]] std::size_t mark() const { return program_.err().size(); }
  [[nodiscard]] bool has(const std::string& text) const {
    return program_.err().find(text) != std::string::npos;
  }
  // Returns whether a text comes to be in the log behind a mark.
  bool hears(const std::string& text, std::size_t mark) {
    return comes_true([&] { return program_.err().find(text, mark) != std::string::npos; }, Seconds(20));
  }
  // Returns whether a text stays out of the log for a while.
  bool is_silent_of(const std::string& text) {
    std::this_thread::sleep_for(Seconds(0.2));  // the log comes a little late
    const std::size_t before = mark();
    std::this_thread::sleep_for(Seconds(0.4));
    return program_.err().find(text, before) == std::string::npos;
  }
  std::string end() { return stop_without_gaps(program_); }

 private:
  const Talk talk_;
  Subprocess program_;
};

std::string both_places() { return GENERATE(as<std::string>{}, "main", "front"); }

std::string shown_graph() { return run_orcactl({"graph", "--json"}).out; }

}  // namespace

TEST_CASE("a connection is removed and made while the system runs, and no other one notices",
          "[system][rewire]") {
  Talking system(both_places());
  const std::string before = run_orcactl({"graph"}).out;
  const Run removed = run_orcactl({"disconnect", "a.out", "talker.back"});
  INFO(removed.out << removed.err);
  REQUIRE(removed.exit_code() == 0);
  CHECK_THAT(removed.out, Contains("- connection a.out to talker.back") && Contains("between two laps"));
  CHECK(system.is_silent_of("heard "));
  CHECK_THAT(run_orcactl({"graph"}).out, !Contains("to=\"talker.back\""));
  const std::size_t mark = system.mark();
  const Run made = run_orcactl({"connect", "a.out", "talker.back", "queue=1000"});
  INFO(made.out << made.err);
  REQUIRE(made.exit_code() == 0);
  CHECK(system.hears("heard 1:", mark));
  CHECK(run_orcactl({"graph"}).out == before);
  system.end();
}

TEST_CASE("a port is moved to another server and back, and hears each of them alone", "[system][rewire]") {
  Talking system(both_places());
  for (const auto& [server, heard, other] :
       {std::tuple("b.out", "heard 7:", "heard 1:"), std::tuple("a.out", "heard 1:", "heard 7:")}) {
    const std::size_t mark = system.mark();
    const Run moved = run_orcactl({"move", "talker.back", server});
    INFO(moved.out << moved.err);
    REQUIRE(moved.exit_code() == 0);
    CHECK(system.hears(heard, mark));
    CHECK(system.is_silent_of(other));
  }
  system.end();
}

TEST_CASE("what is sent without its connection is told to the sender, and reaches the server again with it",
          "[system][rewire]") {
  Talking system(both_places());
  REQUIRE(run_orcactl({"disconnect", "talker.poke", "a.poke"}).exit_code() == 0);
  CHECK(system.hears("not sent: port talker.poke is not connected", 0));
  const std::size_t mark = system.mark();
  REQUIRE(run_orcactl({"move", "talker.poke", "b.poke"}).exit_code() == 1);  // it has none to move
  REQUIRE(run_orcactl({"connect", "talker.poke", "b.poke", "queue=1000"}).exit_code() == 0);
  CHECK(system.hears(" after 0", mark));  // the first that b got
  CHECK(system.is_silent_of("not sent"));
  system.end();
}

TEST_CASE("a connection gets another policy, and carries on", "[system][rewire]") {
  Talking system(both_places());
  const Run changed = run_orcactl({"connect", "talker.out", "a.in", "queue=500", "deadline=2 s"});
  INFO(changed.out << changed.err);
  REQUIRE(changed.exit_code() == 0);
  CHECK_THAT(changed.out, Contains("~ connection talker.out to a.in") && Contains("queue") &&
                              Contains("1000") && Contains("500") && Contains("deadline"));
  CHECK_THAT(run_orcactl({"graph"}).out, Contains("queue=\"500\""));
  const std::size_t mark = system.mark();
  CHECK(system.hears("heard 1:", mark));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("processes that are started again have the connections that were made", "[system][rewire]") {
  Talking system("front");
  REQUIRE(run_orcactl({"move", "talker.back", "b.out"}).exit_code() == 0);
  const std::string process = GENERATE(as<std::string>{}, "front", "main");
  std::size_t mark = system.mark();
  REQUIRE(run_orcactl({"restart", process}).exit_code() == 0);
  CHECK(system.hears("heard 7:", mark));
  mark = system.mark();
  kill(children_of(system.program().pid()).at(process), SIGKILL);
  CHECK(system.hears("is back", mark));
  mark = system.mark();
  CHECK(system.hears("heard 7:", mark));
  CHECK(system.is_silent_of("heard 1:"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("what an operator has set stays so when a connection changes, and is not the graph's",
          "[system][rewire]") {
  Talking system("front");
  REQUIRE(run_orcactl({"set", "a.step", "3"}).exit_code() == 0);
  const Run removed = run_orcactl({"disconnect", "talker.poke", "a.poke"});
  REQUIRE(removed.exit_code() == 0);
  CHECK_THAT(removed.out, !Contains("step"));
  CHECK_THAT(run_orcactl({"get", "a.step"}).out, Contains(" 3 "));
  REQUIRE(run_orcactl({"restart", "front"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"get", "a.step"}).out, Contains(" 1 "));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("a connection that would not be right is refused, with the reason", "[system][rewire]") {
  Talking system(both_places());
  const std::string before = shown_graph();
  const auto refusal = [](const Words& words) {
    const Run run = run_orcactl(words);
    INFO(run.out << run.err);
    CHECK(run.exit_code() != 0);
    return run.err;
  };
  CHECK_THAT(refusal({"connect", "a.ot", "talker.back"}), Contains("a.ot") && Contains("a.out"));
  CHECK_THAT(refusal({"connect", "b.out", "talker.back"}), Contains("talker.back"));  // has one already
  CHECK_THAT(refusal({"connect", "talker.out", "talker.back"}), Contains("MotionCommand"));
  CHECK_THAT(refusal({"connect", "b.out", "a.in"}), Contains("a.in"));
  CHECK_THAT(refusal({"connect", "talker.out", "a.in", "queu=5"}), Contains("queu"));
  CHECK_THAT(refusal({"connect", "talker.out", "a.in", "5"}), Contains("ATTRIBUTE=VALUE"));
  CHECK_THAT(refusal({"disconnect", "talker.out", "a.in"}), Contains("must be connected"));
  CHECK_THAT(refusal({"disconnect", "b.out", "talker.back"}), Contains("there is no connection"));
  CHECK_THAT(refusal({"move", "talker.out", "a.in"}), Contains("serves others"));
  CHECK_THAT(refusal({"move", "b.poke", "talker.poke"}), Contains("has no connection"));
  CHECK(shown_graph() == before);
  system.end();
}

TEST_CASE("a graph with other connections is applied, and everything is as before if one cannot be made",
          "[system][rewire]") {
  Talking system("front");
  const std::string other =
      system.talk().write("other.xml", "<connect from=\"b.out\" to=\"talker.back\" queue=\"1000\"/>");
  std::size_t mark = system.mark();
  REQUIRE(run_orcactl(Words{"apply", other} + kBriefly).exit_code() == 0);
  CHECK(system.hears("heard 7:", mark));
  CHECK_THAT(run_orcactl({"diff", other}).out, Contains("runs like that already"));
  const std::string before = shown_graph();
  // The tellers' process makes its end of the connection; the talker's cannot.
  const pid_t talker = children_of(system.program().pid()).at("main");
  kill(talker, SIGSTOP);
  const Run failed = run_orcactl(Words{"apply", system.talk().file()} + kBriefly, Seconds(40));
  INFO(failed.out << failed.err);
  CHECK(failed.exit_code() == 1);
  CHECK_THAT(failed.err, Contains("main"));
  mark = system.mark();
  CHECK(system.hears("heard 7:", mark));
  CHECK(system.is_silent_of("heard 1:"));
  CHECK(shown_graph() == before);
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("a client in a long lap refuses another connection, and hears its server all the time",
          "[system][rewire]") {
  Talking system("front", nappers("front"));
  REQUIRE(system.hears("napper: heard ", 0));
  const std::string before = shown_graph();
  const Words change = GENERATE(Words{"connect", "sleeper.out", "napper.back", "queue=500"},
                                Words{"disconnect", "sleeper.out", "napper.back"});
  REQUIRE(run_orcactl({"set", "napper.nap", "9 s"}).exit_code() == 0);
  REQUIRE(system.hears("napper: naps", 0));
  const Run refused = run_orcactl(change, Seconds(20));
  INFO(refused.out << refused.err);
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("napper: it has not come to the end of a lap in time") &&
                              Contains("all others are as before"));
  CHECK(shown_graph() == before);
  CHECK_FALSE(system.has("napper: wakes up"));
  CHECK(system.hears("napper: heard ", system.mark()));
  REQUIRE(system.hears("napper: wakes up", 0));
  CHECK_FALSE(system.has("napper: missed"));
  const Run changed = run_orcactl(change);
  INFO(changed.err);
  CHECK(changed.exit_code() == 0);
  CHECK(system.is_silent_of("napper: heard ") == (change.front() == "disconnect"));
  system.end();
}

TEST_CASE("a server in a long lap refuses another connection, and its client hears it afterwards",
          "[system][rewire]") {
  Talking system("front", nappers("front"));
  REQUIRE(system.hears("napper: heard ", 0));
  const std::string before = shown_graph();
  REQUIRE(run_orcactl({"set", "sleeper.nap", "12 s"}).exit_code() == 0);
  REQUIRE(system.hears("sleeper: naps", 0));
  const Run refused = run_orcactl({"connect", "sleeper.out", "napper.back", "queue=500"}, Seconds(20));
  INFO(refused.out << refused.err);
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("sleeper: it has not come to the end of a lap in time"));
  CHECK(shown_graph() == before);
  REQUIRE(system.hears("sleeper: wakes up", 0));
  CHECK(system.hears("napper: heard ", system.mark()));
  CHECK(run_orcactl({"connect", "sleeper.out", "napper.back", "queue=500"}).exit_code() == 0);
  CHECK(system.hears("napper: heard ", system.mark()));
  system.end();
}

TEST_CASE("if one of several components in a process refuses its change, none of them has changed",
          "[system][rewire]") {
  const auto elements = [](const std::string& nap, const std::string& client) {
    return "<component name=\"sleeper\" type=\"test.Napper\" autonomous=\"true\"/>"
           "<component name=\"alert\" type=\"test.Napper\" autonomous=\"true\"/>"
           "<component name=\"napper\" type=\"test.Napper\" autonomous=\"true\"><param name=\"nap\" "
           "value=\"" +
           nap + "\"/></component><connect from=\"sleeper.out\" to=\"" + client + ".back\" queue=\"1000\"/>";
  };
  Talking system("main", elements("0 s", "napper"));
  const std::string other = system.talk().write("other.xml", talker_back(), elements("20 s", "alert"));
  REQUIRE(system.hears("napper: heard ", 0));
  REQUIRE(run_orcactl({"set", "napper.nap", "20 s"}).exit_code() == 0);
  REQUIRE(system.hears("napper: naps", 0));
  const Run refused = run_orcactl({"apply", other}, Seconds(30));
  INFO(refused.out << refused.err);
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("napper: it has not come to the end of a lap in time"));
  CHECK_FALSE(system.has("napper: wakes up"));
  CHECK(system.is_silent_of("alert: heard"));
  CHECK(system.hears("napper: heard ", system.mark()));
  system.end();
}

TEST_CASE("the run ends at once although a change waits for the end of a lap", "[system][rewire]") {
  Talking system("front", nappers("front"));
  REQUIRE(run_orcactl({"set", "napper.nap", "20 s"}).exit_code() == 0);
  REQUIRE(system.hears("napper: naps", 0));
  Subprocess change(orcactl({"disconnect", "sleeper.out", "napper.back"}));
  std::this_thread::sleep_for(Seconds(1.5));  // the graph is read and checked meanwhile
  system.program().send(SIGINT);
  const Run ended = finish(system.program(), Seconds(10));
  INFO(ended.err);
  CHECK(ended.exit_code() == 0);
  CHECK_THAT(ended.err, !Contains("has not ended in time"));
  CHECK(finish(change, Seconds(5)).exit_code() != 0);
}

TEST_CASE("connections change at a time known before, and the run repeats bit for bit", "[system][rewire]") {
  const Talk talk("main");
  const std::string other =
      talk.write("other.xml", "<connect from=\"b.out\" to=\"talker.back\" queue=\"1000\"/>");
  const auto run_with = [&](const Words& more) {
    Run run = run_deployer(Words{talk.file(), "--log", "debug", "--until", "2 s"} + virtual_clock() + more);
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    return run;
  };
  const Run changed = run_with({"--change", other + "@1s"});
  CHECK_THAT(changed.err, Contains("heard 1:") && Contains("heard 7:") && !Contains("gap "));
  CHECK(changed.err.rfind("heard 1:") < changed.err.find("heard 7:"));
  CHECK(run_with({"--change", other + "@1s"}).trace_hash() == changed.trace_hash());
  CHECK(run_with({}).trace_hash() != changed.trace_hash());
}
