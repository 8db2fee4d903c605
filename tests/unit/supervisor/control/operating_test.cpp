// SPDX-License-Identifier: GPL-3.0-or-later
// What an operator orders, as far as it is refused before a process hears of it.
#include "control/operating.hpp"

#include <catch2/catch.hpp>

#include "control/peer_desk.hpp"
#include "orca/supervisor/own_process.hpp"

using namespace orca;
using namespace orca::supervisor;
using Words = std::vector<std::string>;
using Catch::Contains;

namespace {

constexpr Duration kLimit = 2s;

graph::ComponentNode component(const std::string& name, const std::string& process, graph::Params params) {
  graph::ComponentNode node;
  node.name = name;
  node.process = process;
  node.params = std::move(params);
  return node;
}

graph::Graph graph_of_two() {
  graph::Graph graph;
  graph.name = "two";
  graph.components = {
      component("avoid", "p", {{"margin", 0.1}, {"mode", std::string("turn")}, {"size", 0.3}}),
      component("goto", "q", {{"speed", 0.5}})};
  graph.groups = {{"driving", {"avoid", "goto"}, {}}};
  return graph;
}

ParamContract length(const std::string& name, double most) {
  ParamContract param;
  param.name = name;
  param.unit = "m";
  param.min = 0.0;
  param.max = most;
  param.default_value = 0.1;
  return param;
}

SystemFacts facts_of_two() {
  ParamContract mode;
  mode.name = "mode";
  mode.type = ParamType::text;
  mode.choices = {"turn", "stop"};
  mode.default_value = std::string("turn");
  ParamContract size = length("size", 1.0);
  size.fixed = true;
  ParamContract speed = length("speed", 1.0);
  speed.unit = "m/s";
  SystemFacts facts;
  facts.contracts["avoid"].params = {length("margin", 1.0), mode, size};
  facts.contracts["goto"].params = {speed};
  return facts;
}

// An operator's desk in a system whose two processes do not run.
class Desk {
 public:
  using Action = std::function<void(Operating&, const ReplyPtr&)>;

  // Returns the error that an order ends with; "" if it has not been refused.
  std::string refusal_of(const Action& action) {
    SocketPair pair = std::move(make_socket_pair()).value();
    const auto there = std::make_shared<Channel>(std::move(pair.supervisor));
    Channel here(std::move(pair.host));
    const auto order = [&] { action(operating_, std::make_shared<Reply>(there, 1, false)); };
    conductor_.run([&] {
      conductor_.begin("order", order);
      conductor_.go_on(Moment{});
    });
    ControlAnswer answer = std::move(decode_answer(std::move(here.wait_for_message(kLimit)).value())).value();
    const Status outcome = std::get<EndAnswer>(answer).outcome;
    return outcome.ok() ? "" : outcome.error().text();
  }
  std::string refusal_of_set(const Words& words) {
    return refusal_of([&](Operating& desk, const ReplyPtr& reply) { desk.set(words, reply); });
  }
  // Orders to set something while another joint order is under way, which then changes the graph.
  std::string refusal_of_set_before(const Words& words, const std::function<void(graph::Graph&)>& change) {
    return refusal_of([&](Operating& desk, const ReplyPtr& reply) {
      const auto make = [&]() -> std::optional<ThereAndBack> {
        conductor_.begin("set", [&, reply] { desk.set(words, reply); });
        change(graph_);
        return std::nullopt;
      };
      CHECK(desk.carry_out({{"goto", make, [](bool) {}}}).ok());
    });
  }
  std::string refusal_of_suspend(const std::string& name) {
    return refusal_of([&](Operating& desk, const ReplyPtr& reply) { desk.suspend(name, reply); });
  }

  // Lets a process say that a component orders another one to be set.
  Status order_of(const std::string& by, const std::string& process) {
    Status taken = ok();
    conductor_.run([&] {
      taken = peers_.take(
          {.by = by, .number = 1, .act = {}, .component = "goto", .param = "speed", .value = "1"}, process);
      conductor_.go_on(Moment{});
    });
    return taken;
  }

  // Makes both processes look as if they worked, although nobody answers in them.
  void bring_up() {
    for (Member* const member : members_) member->enter(Member::Phase::up);
  }
  graph::Params params_of(std::size_t component) {
    return operating_.params_of(graph_.components.at(component));
  }

 private:
  graph::Graph graph_ = graph_of_two();
  const SystemFacts facts_ = facts_of_two();
  Member p_{graph::ProcessNode{.name = "p"}, 0, 0};
  Member q_{graph::ProcessNode{.name = "q"}, 1, 1};
  const Members members_{&p_, &q_};
  const SystemNames names_{graph_, graph_, facts_.ports, members_};
  Conductor conductor_{[] {}};
  Operating operating_{
      conductor_, graph_, facts_, names_, [](const std::string&) { return host::ComponentReport{}; }, {}};
  PeerDesk peers_{conductor_, graph_, names_, operating_,
                  [](const std::string&) { return host::ComponentReport{}; }};
};

}  // namespace

TEST_CASE("everything that is wrong with several values is said at once", "[supervisor][operating]") {
  Desk desk;
  desk.bring_up();
  const std::string said =
      desk.refusal_of_set({"avoid.margin", "3 m", "avoid.mode", "trn", "avoid.size", "1 m", "goto.speed",
                           "1 kg", "goto.sped", "1", "avid.margin", "0.1"});
  CHECK(std::ranges::count(said, '\n') == 5);
  CHECK_THAT(said, Contains("goto has no parameter \"sped\"; did you mean \"speed\"?"));
  CHECK_THAT(said, Contains("there is no component \"avid\"; did you mean \"avoid\"?"));
  CHECK_THAT(said, Contains("avoid: parameter \"margin\""));
  CHECK_THAT(said, Contains("avoid: parameter \"mode\"") && Contains("did you mean \"turn\"?"));
  CHECK_THAT(said, Contains("avoid: parameter \"size\" cannot change while the component runs"));
  CHECK_THAT(said, Contains("goto: parameter \"speed\"") && Contains("kg"));
  CHECK(std::get<double>(desk.params_of(0).at("margin")) == 0.1);
}

TEST_CASE("one wrong value is said without the component, which the command line names",
          "[supervisor][operating]") {
  Desk desk;
  CHECK_THAT(desk.refusal_of_set({"avoid.margin", "3 m"}), Catch::StartsWith("parameter \"margin\""));
}

TEST_CASE("a parameter is set once, and has a value", "[supervisor][operating]") {
  Desk desk;
  CHECK_THAT(desk.refusal_of_set({"avoid.margin", "0.2", "avoid.margin", "0.3"}),
             Contains("avoid.margin is given twice"));
  CHECK_THAT(desk.refusal_of_set({"avoid.margin", "0.2", "goto.speed"}),
             Contains("which value? for goto.speed"));
  CHECK_THAT(desk.refusal_of_set({"avoid", "0.2"}), Contains("name one parameter: avoid.PARAM"));
}

TEST_CASE("nothing is ordered while a process of it does not work", "[supervisor][operating]") {
  Desk desk;
  const std::string both =
      "process p does not work at present; try again later\nprocess q does not work at present; try again "
      "later";
  CHECK(desk.refusal_of_suspend("driving") == both);
  CHECK(desk.refusal_of_set({"avoid.margin", "0.2", "goto.speed", "1"}) == both);
}

TEST_CASE("a process that ends before it answers has refused", "[supervisor][operating]") {
  Desk desk;
  desk.bring_up();
  CHECK(desk.refusal_of_set({"avoid.margin", "0.2", "goto.speed", "1"}) ==
        "avoid: process p has ended before it answered; all others are as before the order");
  CHECK(desk.refusal_of_suspend("goto") == "goto: process q has ended before it answered");
  CHECK(std::get<double>(desk.params_of(0).at("margin")) == 0.1);
}

TEST_CASE("nothing is set if a component has gone, or has another type, when its turn comes",
          "[supervisor][operating]") {
  Desk desk;
  desk.bring_up();
  std::function<void(graph::Graph&)> change;
  std::string why;
  SECTION("gone") {
    change = [](graph::Graph& graph) { graph.components.erase(graph.components.begin()); };
    why = "the system does not have it any more";
  }
  SECTION("another type") {
    change = [](graph::Graph& graph) { graph.components[0].params = {{"room", 0.1}}; };
    why =
        "it is of another type now, without a parameter \"margin\"; orcactl get avoid shows those that it "
        "has";
  }
  CHECK(desk.refusal_of_set_before({"avoid.margin", "0.2", "goto.speed", "1"}, change) ==
        "avoid: " + why + "; all others are as before the order");
}

TEST_CASE("a name that is neither a component nor a group is answered by the nearest one",
          "[supervisor][operating]") {
  Desk desk;
  CHECK(desk.refusal_of_suspend("drivin") ==
        "there is no component or group \"drivin\"; did you mean \"driving\"?");
}

TEST_CASE("a process gives no orders of components that it does not have", "[supervisor][operating]") {
  Desk desk;
  CHECK(desk.order_of("avoid", "p").ok());
  const Status taken = desk.order_of("avoid", "q");
  REQUIRE_FALSE(taken.ok());
  CHECK(taken.error().code == Code::data_loss);
  CHECK(taken.error().message == "it gives an order of avoid, which it does not have");
  CHECK_FALSE(desk.order_of("nobody", "q").ok());
}
