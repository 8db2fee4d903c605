// SPDX-License-Identifier: GPL-3.0-or-later
// The services of the base class to an author, seen through a host that does nothing else.
#include "orca/component.hpp"

#include <catch2/catch.hpp>

#include <cmath>

#include "executives.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "peer.hpp"

using namespace orca;
using namespace orca::test;
using idl::MotionCommand;

namespace {

// A host that keeps the trigger.
class Host final : public ComponentHost {
 public:
  ~Host() noexcept override {}  // the destructors of these components do not throw
  Host(Executive& executive, std::string name) : peer_(executive, std::move(name)) {}

  [[nodiscard]] Peer& peer() { return peer_; }
  [[nodiscard]] const Trigger& trigger() const { return trigger_; }

  void declare_port(PortDeclaration declaration) override { peer_.declare_port(std::move(declaration)); }
  void declare_param(ParamDeclaration /*declaration*/) override {}
  void set_default_trigger(const Trigger& trigger) override { trigger_ = trigger; }
  [[nodiscard]] Duration lap_period() const override { return trigger_.period; }
  [[nodiscard]] const std::string& name() const override { return peer_.strand().name(); }
  [[nodiscard]] TimePoint now() const override { return peer_.executive().now(); }
  [[nodiscard]] RandomStream random(std::string_view stream) const override { return {1, name(), stream}; }
  void write_log(log::Level /*level*/, std::string_view text) const override { log.emplace_back(text); }
  [[nodiscard]] Device* hardware() override { return nullptr; }
  void stay_active(bool /*active*/) override {}
  [[nodiscard]] Strand& strand() override { return peer_.strand(); }
  std::uint64_t begin_mission() override { return 1; }
  void end_mission() override {}
  void note_cause(const idl::OrcaObject& /*object*/) override {}

  mutable std::vector<std::string> log;

 private:
  mutable Peer peer_;
  Trigger trigger_;
};

struct Both final : Component {
  explicit Both(ComponentHost& host) : Component(host) { lap_on(right); }
  Outcome work() override { return done(); }
  using Component::wait_until;

  PushProxy<MotionCommand> left{*this, "left"};
  PushProxy<MotionCommand> right{*this, "right"};
};

struct Source : Peer {
  explicit Source(Executive& executive) : Peer(executive, "source") {}
  PushServer<MotionCommand> out{*this, "out"};
};

}  // namespace

TEST_CASE("a component may give the port itself, instead of its name, as the port that starts its laps",
          "[component]") {
  run_on({}, [](Executive& executive) {
    Host host(executive, "both");
    const Both both(host);
    CHECK(both.right.name() == "right");
    CHECK(host.trigger() == Trigger{Trigger::Kind::on_any, Duration{0}, {"right"}});
  });
}

EXECUTIVE_CASE("wait_until ends as soon as an arrival makes its condition true", "[component]") {
  Host host(executive, "both");
  Both both(host);
  Source source(executive);
  REQUIRE(LocalLinks().connect(source.endpoint("out"), host.peer().endpoint("left")).ok());
  both.left.subscribe();
  bool holds = false;
  Script script(host.peer(),
                [&] { holds = both.wait_until([&] { return both.left.new_data_arrived(); }, 1h); });
  CHECK_FALSE(script.ends_within(10ms));
  source.out.push(full_stop());
  REQUIRE(script.ends_within(5s));
  CHECK(holds);
}

EXECUTIVE_CASE("wait_until gives up at its limit", "[component]") {
  Host host(executive, "both");
  Both both(host);
  const TimePoint before = executive.now();
  CHECK_FALSE(both.wait_until([] { return false; }, 20ms));
  const Duration waited = executive.now() - before;
  CHECK(waited >= 20ms);
  if (executive.is_virtual()) CHECK(waited == 20ms);
}

EXECUTIVE_CASE("wait_until does not hold a component that must leave its lap", "[component]") {
  Host host(executive, "both");
  Both both(host);
  Script script(host.peer(), [&] { both.wait_until([] { return false; }, 1h); });
  host.peer().leave();
  REQUIRE(script.ends_within(5s));
  CHECK(script.interrupted());
}

TEST_CASE("the sender of readings that say nothing valid is named once in ten seconds", "[component]") {
  run_on_each(virtual_executives(), [](Executive& executive) {
    const Host host(executive, "avoid");
    SenderWatch senders(host);
    idl::Odometry odometry;
    odometry.origin() = "base";
    CHECK(senders.accepts(odometry));
    CHECK(host.log.empty());
    odometry.x(std::nan(""));
    for (int i = 0; i < 210; ++i) {
      CHECK_FALSE(senders.accepts(odometry));
      sleep(executive, 50ms);
    }
    const std::string line = "the Odometry of \"base\" counts as none: its x is nan; expected at most 1e7";
    CHECK(host.log == std::vector<std::string>{line, line});
    odometry.origin() = "other";
    CHECK_FALSE(senders.accepts(odometry));
    CHECK(host.log.size() == 3);
  });
}

TEST_CASE(
    "a sender whose numbers go back has begun anew; one whose object comes twice, or another one, has not",
    "[component]") {
  SenderLife life;
  idl::Odometry odometry;
  const auto begins_anew = [&](const char* sender, std::uint64_t number) {
    odometry.origin() = sender;
    odometry.seq(number);
    return life.begins_anew(odometry);
  };
  CHECK_FALSE(begins_anew("base", 7));
  CHECK_FALSE(begins_anew("base", 7));
  CHECK_FALSE(begins_anew("base", 9));
  CHECK(begins_anew("base", 1));
  CHECK_FALSE(begins_anew("base", 2));
  CHECK_FALSE(begins_anew("other", 1));
}
