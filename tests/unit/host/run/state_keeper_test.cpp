// SPDX-License-Identifier: GPL-3.0-or-later
// The state of a component is kept outside its process, for the object that begins after the process was lost.
#include <catch2/catch.hpp>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "executives.hpp"
#include "orca/graph/loader.hpp"
#include "orca/host/hosted_part.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Kind = PartOrder::Kind;

namespace {

// A state that was handed out, and when.
struct Handed {
  KeptState state;
  TimePoint time;
};

class StateListener final : public PartListener {
 public:
  explicit StateListener(Executive& executive) : executive_(executive) {}

  void logged(log::Level /*level*/, std::string_view who, std::string_view text) override {
    lines.push_back(std::string(who) + ": " + std::string(text));
  }
  void component_changed(const std::string& component, const ComponentReport& report) override {
    if (component == "talker" && !report.failure.empty()) failure = report.failure;
  }
  void rest_changed(bool /*at_rest*/) override {}
  void counted(const RunCounters& /*counters*/, const std::vector<RunResult::Way>& /*ways*/) override {}
  void state_kept(const std::string& component, const KeptState& state) override {
    if (component == "talker")
      handed.push_back({state, executive_.now()});
    else
      others[component] = state;
  }
  void peer_called(const PeerCall& /*call*/) override {}
  void edge_damaged(const std::string& /*edge*/) override {}
  void output_failed(const Error& error) override { FAIL(error.text()); }
  [[noreturn]] void abandon(const RunResult& /*result*/) override { std::abort(); }

  [[nodiscard]] bool says(const std::string& text) const {
    for (const std::string& line : lines)
      if (line.find(text) != std::string::npos) return true;
    return false;
  }

  std::vector<std::string> lines;
  std::vector<Handed> handed;               // by the talker
  std::map<std::string, KeptState> others;  // by component: its last one
  std::string failure;

 private:
  Executive& executive_;
};

// What a test.Talker saves: how often it has poked, and what it has heard last.
KeptState poked(std::int64_t times, const StateTag& tag = {"test.Talker", 1}) {
  StateWriter writer;
  writer.write(times, std::string());
  return {tag, writer.bytes()};
}

std::int64_t pokes_in(const KeptState& state) {
  StateReader reader(state.tag, state.bytes);
  std::int64_t pokes = 0;
  std::string heard;
  REQUIRE(reader.read(pokes, heard).ok());
  return pokes;
}

// A talker in this process, which does a lap each 10 ms of virtual time.
class Talking {
 public:
  Talking(const graph::Graph& graph, Executive& executive, HostedPart& part)
      : graph_(graph), executive_(executive), part_(part) {}

  Status ask(PartOrder order) {
    const std::unique_ptr<Event> answered = executive_.make_event();
    Status outcome = fail(Code::internal, "not answered");
    order.done = [&](const Status& status) {
      outcome = status;
      answered->notify();
    };
    part_.order(std::move(order));
    (void)answered->wait_until(kForever);
    return outcome;
  }
  void begin() {
    CHECK(ask({Kind::configure, "talker"}).ok());
    CHECK(ask({Kind::open_gates}).ok());
  }
  void remove() { CHECK(ask({Kind::remove, "talker"}).ok()); }
  void add_again() {
    PartOrder order{Kind::add, "talker"};
    order.node = std::make_shared<graph::ComponentNode>(*graph_.find_component("talker"));
    CHECK(ask(std::move(order)).ok());
    CHECK(ask({Kind::configure, "talker"}).ok());
    CHECK(ask({Kind::open_gate, "talker"}).ok());
  }
  void run_for(Duration time) { sleep(executive_, time); }

 private:
  const graph::Graph& graph_;
  Executive& executive_;
  HostedPart& part_;
};

// Runs a talker that begins with some state, and returns what came of it.
std::unique_ptr<StateListener> talk(const std::string& restore, const KeptStates& states,
                                    const std::function<void(Talking&)>& operate, bool keeps_last = false,
                                    const std::string& more = "") {
  PluginCatalogue catalogue{plugin::PluginIndex({ORCA_BINARY_DIR "/tests/host_plugins"})};
  xml::Diagnostics diagnostics;
  const auto graph = graph::load_text(
      "<graph name=\"talking\" version=\"1\"><component name=\"talker\" type=\"test.Talker\" restore=\"" +
          restore + "\"/><component name=\"beside\" type=\"test.Napper\"/>" + more + "</graph>",
      "talking.xml", {}, catalogue, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(graph);
  const auto executive = make_executive(virtual_executives().front()).value();
  auto listener = std::make_unique<StateListener>(*executive);
  PartOptions options;
  options.states = states;
  HostedPart part(*graph, "main", {catalogue, *executive, *listener}, options);
  REQUIRE(part.build({}).ok());
  Talking talking(*graph, *executive, part);
  std::unique_ptr<Task> operation;
  PartOrder begin{Kind::open_hardware};
  begin.done = [&](const Status&) {
    operation = executive->spawn({"operator"}, [&] {
      talking.begin();
      operate(talking);
      PartOrder end{Kind::take_down};
      end.keeps_states = keeps_last;
      end.done = [&](const Status&) { operation.reset(); };
      part.order(std::move(end));
    });
  };
  part.order(std::move(begin));
  part.run();
  return listener;
}

void for_a_second(Talking& run) { run.run_for(1s); }

}  // namespace

TEST_CASE("with restore=last a state is handed out while it changes, at most every 0.1 s", "[host][state]") {
  const auto heard = talk("last", {}, for_a_second);
  REQUIRE(heard->handed.size() >= 9);
  CHECK(heard->handed.size() <= 11);
  CHECK(heard->handed[0].state.tag.text() == "test.Talker/1");
  for (std::size_t i = 1; i < heard->handed.size(); ++i) {
    CHECK(heard->handed[i].time - heard->handed[i - 1].time >= 100ms);
    CHECK(pokes_in(heard->handed[i].state) > pokes_in(heard->handed[i - 1].state));
  }
}

TEST_CASE("without restore no state is handed out", "[host][state]") {
  CHECK(talk("none", {}, for_a_second)->handed.empty());
}

TEST_CASE("whoever takes a component down can ask for its last state, whatever the graph says",
          "[host][state]") {
  const auto heard = talk("none", {}, for_a_second, true);
  REQUIRE(heard->handed.size() == 1);
  CHECK(pokes_in(heard->handed[0].state) >= 99);
}

TEST_CASE("the last change is handed out although nothing comes after it, and once", "[host][state]") {
  const auto heard = talk("last", {}, [](Talking& run) {
    run.run_for(150ms);
    CHECK(run.ask({Kind::suspend, "talker"}).ok());
    run.run_for(2s);
  });
  REQUIRE_FALSE(heard->handed.empty());
  CHECK(pokes_in(heard->handed.back().state) >= 14);
  CHECK(heard->handed.size() <= 3);
}

TEST_CASE("an object that begins with a kept state goes on from it", "[host][state]") {
  const auto heard = talk("last", {{"talker", poked(1000)}}, for_a_second);
  CHECK(heard->says("talker: goes on from the state test.Talker/1"));
  REQUIRE_FALSE(heard->handed.empty());
  CHECK(pokes_in(heard->handed[0].state) > 1000);
  CHECK(heard->failure.empty());
}

TEST_CASE("what is sent to an object that does not work yet finds it with its kept state", "[host][state]") {
  StateWriter writer;
  writer.write(std::int64_t{1000}, std::uint64_t{0},
               std::int64_t{0});  // what a test.Teller has counted, and heard last
  const auto heard = talk(
      "none", {{"teller", {{"test.Teller", 1}, writer.bytes()}}},
      [](Talking& run) {
        CHECK(run.ask({Kind::configure, "teller"}).ok());
        run.run_for(1s);
      },
      true,
      "<component name=\"teller\" type=\"test.Teller\"/><connect from=\"talker.out\" to=\"teller.in\"/>"
      "<connect from=\"talker.poke\" to=\"teller.poke\"/>");
  CHECK(heard->says("teller: goes on from the state test.Teller/1"));
  REQUIRE(heard->others.contains("teller"));
  const KeptState& last = heard->others.at("teller");
  StateReader reader(last.tag, last.bytes);
  std::int64_t count = 0, poke = 0;
  std::uint64_t object = 0;
  REQUIRE(reader.read(count, object, poke).ok());
  CHECK(count == 1000);
  CHECK(poke > 50);
}

TEST_CASE("an object that nobody has asked for yet hands out the state that it would begin with",
          "[host][state]") {
  StateWriter writer;
  writer.write(std::int64_t{1000}, std::uint64_t{7}, std::int64_t{8});
  const KeptState kept{{"test.Teller", 1}, writer.bytes()};
  const auto heard = talk(
      "none", {{"teller", kept}},
      [](Talking& run) {
        CHECK(run.ask({Kind::configure, "teller"}).ok());
      },
      true,
      "<component name=\"teller\" type=\"test.Teller\"/><connect from=\"talker.out\" to=\"teller.in\"/>");
  REQUIRE(heard->others.contains("teller"));
  CHECK(heard->others.at("teller") == kept);
}

TEST_CASE("a state of another type or version is left unread, and the log says so", "[host][state]") {
  for (const StateTag& tag : {StateTag{"test.Stranger", 1}, StateTag{"test.Talker", 7}}) {
    CAPTURE(tag.text());
    const auto heard = talk("last", {{"talker", poked(1000, tag)}}, for_a_second);
    CHECK(heard->says("talker: begins afresh: "));
    CHECK(heard->says(tag.text()));
    REQUIRE_FALSE(heard->handed.empty());
    CHECK(pokes_in(heard->handed[0].state) < 1000);
    CHECK(heard->failure.empty());
  }
}

TEST_CASE("a state of up to 1 MiB is kept, and the log says so when one is larger", "[host][state]") {
  constexpr std::size_t kMebibyte = 1'048'576;
  const auto state_of = [](std::size_t bytes) {
    StateWriter writer;
    writer.write(std::int64_t{1000}, std::string(bytes - poked(1000).bytes.size(), 'x'));
    REQUIRE(writer.bytes().size() == bytes);
    return KeptState{{"test.Talker", 1}, writer.bytes()};
  };
  const auto kept = talk("last", {{"talker", state_of(kMebibyte)}}, for_a_second);
  REQUIRE_FALSE(kept->handed.empty());
  CHECK(pokes_in(kept->handed.back().state) > 1000);
  const auto too_large = talk("last", {{"talker", state_of(kMebibyte + 1)}}, for_a_second);
  CHECK(too_large->handed.empty());
  CHECK(too_large->says(
      "talker: its state is not kept from now on: it takes 1048577 bytes, more than 1048576"));
}

TEST_CASE("an object that was given its state early, and that start() makes anew, has it at work again",
          "[host][state]") {
  StateWriter writer;
  writer.write(std::int64_t{1000}, std::uint64_t{0}, std::int64_t{0});
  const auto heard = talk(
      "none", {{"teller", {{"test.Teller", 1}, writer.bytes()}}},
      [](Talking& run) {
        CHECK(run.ask({Kind::configure, "teller"}).ok());
        run.run_for(1s);  // it is poked, which needs its state
        CHECK(run.ask({Kind::configure, "listener"}).ok());
        run.run_for(1s);  // it works for somebody
      },
      true,
      R"(<component name="teller" type="test.Teller"><param name="forgets" value="true"/></component>
         <component name="listener" type="test.Napper"/>
         <connect from="talker.out" to="teller.in"/><connect from="talker.poke" to="teller.poke"/>
         <connect from="teller.out" to="listener.back"/>)");
  REQUIRE(heard->others.contains("teller"));
  const KeptState& last = heard->others.at("teller");
  StateReader reader(last.tag, last.bytes);
  std::int64_t count = 0, poke = 0;
  std::uint64_t object = 0;
  REQUIRE(reader.read(count, object, poke).ok());
  CHECK(count > 1050);
  CHECK(poke > 150);
}

TEST_CASE("an object that cannot read its state fails with the reason", "[host][state]") {
  KeptState torn = poked(1000);
  torn.bytes.pop_back();
  const auto heard = talk("last", {{"talker", torn}}, for_a_second);
  INFO(heard->failure);
  CHECK(heard->failure.find("cannot go on from the state that was kept") != std::string::npos);
}

TEST_CASE("a component that has gone and comes again begins afresh", "[host][state]") {
  const auto heard = talk("last", {{"talker", poked(1000)}}, [](Talking& run) {
    run.run_for(1s);
    run.remove();
    run.add_again();
    run.run_for(1s);
  });
  REQUIRE_FALSE(heard->handed.empty());
  CHECK(pokes_in(heard->handed[0].state) > 1000);
  CHECK(pokes_in(heard->handed.back().state) < 1000);
}
