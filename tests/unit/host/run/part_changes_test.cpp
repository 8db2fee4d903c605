// SPDX-License-Identifier: GPL-3.0-or-later
// Connections that change in one process while its components run.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "diary.hpp"
#include "executives.hpp"
#include "orca/graph/loader.hpp"
#include "orca/host/hosted_part.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;
using Kind = PartOrder::Kind;

namespace {

// Keeps what the components log with level debug, and calls a function at a line.
class NapListener final : public PartListener {
 public:
  void logged(log::Level level, std::string_view who, std::string_view text) override {
    if (level != log::Level::debug) return;
    const std::string line = std::string(who) + " " + std::string(text);
    diary.note(line);
    if (line == awaited) at_line();
  }
  void component_changed(const std::string& /*component*/, const ComponentReport& /*report*/) override {}
  void rest_changed(bool /*at_rest*/) override {}
  void counted(const RunCounters& /*counters*/, const std::vector<RunResult::Way>& /*ways*/) override {}
  void state_kept(const std::string& /*component*/, const KeptState& /*state*/) override {}
  void peer_called(const PeerCall& /*call*/) override {}
  void edge_damaged(const std::string& /*edge*/) override {}
  void output_failed(const Error& error) override { FAIL(error.text()); }
  [[noreturn]] void abandon(const RunResult& /*result*/) override { std::abort(); }

  Diary diary;
  std::string awaited;
  std::function<void()> at_line;
};

// Nappers that run in this process, and obey orders one after the other.
class Nappers {
 public:
  Nappers(Executive& executive, HostedPart& part, const graph::Graph& graph, NapListener& listener)
      : executive_(executive), part_(part), graph_(graph), listener_(listener) {}

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
  Status ask(Kind kind, const std::string& component = "") { return ask(PartOrder{kind, component}); }

  // Lets a napper begin a long lap.
  void let_nap(const std::string& name, const std::string& time) {
    REQUIRE(ask(PartOrder{Kind::set_params, name, {{"nap", time}}}).ok());
    sleep(100ms);
    REQUIRE(hears(name + " naps"));
  }
  // Makes (true) or removes connections between nappers.
  Status rewire(const std::vector<std::pair<bool, std::string>>& changes) {
    PartOrder order{Kind::rewire};
    order.connections = std::make_shared<std::vector<ConnectionChange>>();
    for (const auto& [makes, ends] : changes) order.connections->push_back({edge(ends), makes});
    return ask(std::move(order));
  }
  // Makes a connection to a component of another process.
  Status connect_outside(const std::string& ends) {
    PartOrder order{Kind::rewire};
    order.connections = std::make_shared<std::vector<ConnectionChange>>();
    order.connections->push_back({edge(ends), true});
    order.connections->back().edge.link = graph::Link::shm;
    return ask(std::move(order));
  }
  void add(const std::string& name) {
    PartOrder order{Kind::add, name, {{"nap", "0 s"}}};
    order.node = std::make_shared<graph::ComponentNode>(*graph_.find_component("client"));
    order.node->name = name;
    REQUIRE(ask(std::move(order)).ok());
    REQUIRE(ask(Kind::configure, name).ok());
    REQUIRE(ask(Kind::open_gate, name).ok());
  }

  void sleep(Duration time) { orca::test::sleep(executive_, time); }
  [[nodiscard]] TimePoint now() const { return executive_.now(); }
  [[nodiscard]] bool hears(const std::string& line) const { return listener_.diary.has(line); }
  [[nodiscard]] std::size_t hears_of(const std::string& who) const {
    return static_cast<std::size_t>(std::ranges::count_if(
        listener_.diary.lines(), [&](const std::string& line) { return line.starts_with(who + " heard"); }));
  }
  // Orders the end as soon as somebody logs a line.
  void end_at(const std::string& line) {
    listener_.awaited = line;
    listener_.at_line = [this] { part_.order(PartOrder{Kind::take_down}); };
  }

 private:
  // "server > client"
  [[nodiscard]] static graph::Edge edge(const std::string& ends) {
    const std::size_t sign = ends.find(" > ");
    graph::Edge edge;
    edge.from = {ends.substr(0, sign), "out"};
    edge.to = {ends.substr(sign + 3), "back"};
    edge.queue.depth = 10000;
    return edge;
  }

  Executive& executive_;
  HostedPart& part_;
  const graph::Graph& graph_;
  NapListener& listener_;
};

// Runs a client and two servers, unconnected but for one connection, and gives them orders as a task of its own.
void with_nappers(const std::function<void(Nappers&)>& operate) {
  PluginCatalogue catalogue{plugin::PluginIndex({ORCA_BINARY_DIR "/tests/host_plugins"})};
  xml::Diagnostics diagnostics;
  const auto graph = graph::load_text(
      R"(<graph name="nappers" version="1"><component name="client" type="test.Napper" autonomous="true"/>
        <component name="server" type="test.Napper" autonomous="true"/><component name="other" type="test.Napper" autonomous="true"/>
        <component name="idler" type="test.Napper" autonomous="true"/>
        <connect from="server.out" to="other.back" queue="10000"/></graph>)",
      "nappers.xml", {}, catalogue, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(graph);
  const auto executive = make_executive(virtual_executives().front()).value();
  NapListener listener;
  HostedPart part(*graph, "main", {catalogue, *executive, listener}, {});
  REQUIRE(part.build({}).ok());
  Nappers nappers(*executive, part, *graph, listener);
  std::unique_ptr<Task> operation;
  std::exception_ptr thrown;  // a task must not throw
  PartOrder begin{Kind::open_hardware};
  begin.done = [&](const Status&) {
    operation = executive->spawn({"operator"}, [&] {
      for (const graph::ComponentNode& node : graph->components)
        CHECK(nappers.ask(Kind::configure, node.name).ok());
      CHECK(nappers.ask(Kind::open_gates).ok());
      try {
        operate(nappers);
      } catch (...) {
        thrown = std::current_exception();
      }
      PartOrder end{Kind::take_down};
      end.done = [&](const Status&) { operation.reset(); };
      part.order(std::move(end));
    });
  };
  part.order(std::move(begin));
  part.run();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace

TEST_CASE("a connection that could not change in time stays as it is, and does not change later",
          "[host][changes]") {
  with_nappers([](Nappers& run) {
    run.let_nap("client", "20 s");
    const Status late = run.rewire({{true, "server > client"}});
    REQUIRE_FALSE(late.ok());
    CHECK(late.error().code == Code::deadline_exceeded);
    CHECK_THAT(late.error().text(), Contains("client: ") && Contains("its connections stay as they are"));
    run.sleep(20s);
    CHECK(run.hears("client wakes up"));
    CHECK_FALSE(run.hears("client connected"));
    CHECK(run.rewire({{true, "server > client"}}).ok());
    run.sleep(100ms);
    CHECK(run.hears_of("client") > 0);
  });
}

TEST_CASE("a component that a late change would have connected can be removed at once", "[host][changes]") {
  with_nappers([](Nappers& run) {
    run.add("guest");
    run.let_nap("client", "20 s");
    CHECK_FALSE(run.rewire({{true, "guest > client"}}).ok());
    CHECK(run.ask(Kind::remove, "guest").ok());
    run.sleep(20s);
    CHECK(run.hears("client wakes up"));
    CHECK_FALSE(run.hears("client connected"));
  });
}

TEST_CASE("a component is not removed while others are connected to it", "[host][changes]") {
  with_nappers([](Nappers& run) {
    run.add("guest");
    REQUIRE(run.rewire({{true, "guest > client"}}).ok());
    const Status refused = run.ask(Kind::remove, "guest");
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().code == Code::failed_precondition);
    CHECK_THAT(refused.error().text(), Contains("guest: ") && Contains("guest.out to client.back"));
    run.sleep(1s);
    CHECK(run.hears_of("client") > 90);
    CHECK(run.rewire({{false, "guest > client"}}).ok());
    CHECK(run.ask(Kind::remove, "guest").ok());
  });
}

TEST_CASE("the connections of a component change all together or not at all", "[host][changes]") {
  with_nappers([](Nappers& run) {
    run.let_nap("other", "20 s");
    CHECK_FALSE(run.rewire({{true, "client > other"}, {false, "server > other"}}).ok());
    const Status mixed = run.rewire({{true, "server > idler"}, {false, "server > other"}});
    REQUIRE_FALSE(mixed.ok());
    CHECK_THAT(mixed.error().text(), Contains("idler") && Contains("other"));
    run.sleep(20s);
    const std::size_t before = run.hears_of("other");
    run.sleep(1s);
    CHECK(run.hears_of("other") > before + 90);
    CHECK_FALSE(run.hears("idler connected"));
  });
}

TEST_CASE("a connection to a component that the process has not heard of is refused", "[host][changes]") {
  with_nappers([](Nappers& run) {
    const Status refused = run.connect_outside("stranger > client");
    REQUIRE_FALSE(refused.ok());
    CHECK(refused.error().text() ==
          "process main does not know component \"stranger\"; orcactl restart main lets it begin with the "
          "present "
          "graph");
  });
}

TEST_CASE("the end is heard while a change waits for the end of a lap", "[host][changes]") {
  with_nappers([](Nappers& run) {
    run.let_nap("client", "20 s");
    run.let_nap("other", "1 s");
    run.end_at("other wakes up");
    const TimePoint before = run.now();
    const Status ended = run.rewire({{true, "server > client"}});
    REQUIRE_FALSE(ended.ok());
    CHECK(ended.error().code == Code::failed_precondition);
    CHECK_THAT(ended.error().text(), Contains("is being taken down"));
    CHECK(run.now() - before < 1100ms);
  });
}
