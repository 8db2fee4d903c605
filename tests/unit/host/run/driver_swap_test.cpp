// SPDX-License-Identifier: GPL-3.0-or-later
// The exchange of a driver in one process: tests/unit/host/plugins/cart.cpp, which a rider keeps moving.
#include <catch2/catch.hpp>

#include <algorithm>

#include "orca/idl/navigation.hpp"
#include "orca/plugin/library.hpp"
#include "swap_order.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;
using Words = std::vector<std::string>;

namespace {

constexpr Duration kOpenLimit = 300ms;

std::string ridden(const std::string& params = "") {
  return R"(<hardware name="cart" type="test.Cart">)" + params + R"(</hardware>
    <component name="base" type="test.CartServer" hardware="cart"/>
    <component name="rider" type="test.Rider"/>
    <connect from="base.OdometryPush" to="rider.odometry" queue="100"/>
    <connect from="rider.motion" to="base.MotionCommandSend"/>)";
}

SwapOrder next_cart(const std::string& plugin, const std::string& trouble = "none") {
  Result<plugin::PluginImage> image =
      plugin::PluginImage::copy(ORCA_BINARY_DIR "/tests/next_plugins/" + plugin + ".so");
  if (!image) throw std::runtime_error(image.error().text());
  SwapOrder order{"cart", std::move(image).value()};
  if (trouble != "none") order.params["trouble"] = trouble;
  order.open_limit = kOpenLimit;
  return order;
}

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

hw::HardwareState state_of_cart(LiveSystem& live) { return live.system().hardware("cart")->seat().state(); }

// Returns whether the drivers did this, in virtual time nothing else: on a busy machine a base may stop now and then for want
// of commands.
bool did(LiveSystem& live, const Words& all, const Words& expected) {
  if (live.executive().is_virtual()) return all == expected;
  auto next = expected.begin();
  for (const std::string& one : all)
    if (next != expected.end() && one == *next) ++next;
  return next == expected.end();
}

// Checks that the users of the cart go on, and have noticed nothing but a pause, and returns what the drivers did.
Words cart_of_content_users(LiveSystem& live) {
  live.sleep(200ms);
  const auto moves = [&] { return beginning(live.diary.lines(), "cart").back().ends_with("moves"); };
  CHECK(eventually(live.executive(), moves));
  CHECK(live.state("base") == ComponentState::work);
  CHECK(live.state("rider") == ComponentState::work);
  CHECK(state_of_cart(live) == hw::HardwareState::active);
  const Words said = live.news();
  CHECK(beginning(said, "gap").empty());
  CHECK(beginning(said, "server").empty());
  CHECK_FALSE(beginning(said, "reading").empty());
  return beginning(said, "cart");
}

// Lets a rider ride for a while.
void ride(LiveSystem& live) {
  live.sleep(300ms);
  const Words said = live.news();
  REQUIRE(std::ranges::find(said, "cart 1 moves") != said.end());
}

const Words kLeavesStanding{"cart 1 stops at once", "cart 1 stop", "cart 1 close"};

}  // namespace

TEST_CASE("a new driver takes over: the base stops first, and its users notice a pause",
          "[host][swap][driver]") {
  for (const ExecutiveOptions& kind : all_executives()) {
    LiveSystem live(ridden());
    live.run(kind, [](LiveSystem& run) {
      ride(run);
      const Result<SwapReport> done = swap(run, next_cart("test_cart_2"));
      INFO((done ? "" : done.error().text()));
      REQUIRE(done);
      CHECK(done->old_type == "test.Cart");
      CHECK(done->pause < kOpenLimit);
      CHECK(did(run, cart_of_content_users(run),
                kLeavesStanding + Words{"cart 2 open", "cart 2 start", "cart 2 moves"}));
    });
  }
}

TEST_CASE("the old driver's code is out of memory afterwards, after each of many exchanges",
          "[host][swap][driver]") {
  LiveSystem live(ridden());
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    std::string before;
    for (int i = 0; i < 10; ++i) {
      SwapOrder next = next_cart("test_cart_2");
      const std::string name = next.plugin.mapped_name();
      REQUIRE(swap(run, std::move(next)));
      CHECK(plugin::is_mapped(name));
      CHECK_FALSE(plugin::is_mapped(before.empty() ? host_plugin("test_cart") : before));
      before = name;
      run.sleep(100ms);
    }
    CHECK(state_of_cart(run) == hw::HardwareState::active);
  });
}

TEST_CASE("a driver of hardware that nobody uses is exchanged without starting the device",
          "[host][swap][driver]") {
  LiveSystem live(R"(<hardware name="cart" type="test.Cart"/>
    <component name="base" type="test.CartServer" hardware="cart"/>)");
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    REQUIRE(swap(run, next_cart("test_cart_2")));
    CHECK(beginning(run.news(), "cart") == Words{"cart 1 open", "cart 1 close", "cart 2 open"});
    CHECK(state_of_cart(run) == hw::HardwareState::ready);
  });
}

TEST_CASE(
    "a driver that lacks what the present one offers is refused, with all differences, and nothing stops",
    "[host][swap][driver]") {
  LiveSystem live(ridden());
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    ride(run);
    const std::string text = refusal(run, next_cart("test_cart_odd"));
    CHECK_THAT(
        text,
        Contains("test.Cart cannot take its place: it delivers Odometry every 0.1 s, and the present one "
                 "every 0.05 s; it has no sensor of BumperReadings; its drive is holonomic, and the "
                 "present one's is differential; it has nothing that takes a GripperCommand; it describes no "
                 "drive \"wheels\""));
    CHECK(cart_of_content_users(run).empty());
  });
}

TEST_CASE("parameters keep their values, and a driver that cannot take them is refused while nothing stops",
          "[host][swap][driver]") {
  LiveSystem live(ridden(R"(<param name="speed" value="1.5 m/s"/>)"));
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    ride(run);
    CHECK_THAT(refusal(run, next_cart("test_cart_2")), Contains("\"speed\" is out of the new one's range"));
    SwapOrder wrong = next_cart("test_cart_2", "prepare");
    wrong.params["speed"] = "0.7 m/s";
    CHECK_THAT(
        refusal(run, std::move(wrong)),
        Contains("parameter \"trouble\": is not liked today; parameter \"speed\": is not liked either"));
    CHECK(cart_of_content_users(run).empty());
    SwapOrder slower = next_cart("test_cart_2");
    slower.params["speed"] = "0.7 m/s";
    REQUIRE(swap(run, std::move(slower)));
    REQUIRE(swap(run, next_cart("test_cart_2")));
    CHECK(run.system().hardware("cart")->seat().limits()->max_speed == 0.7);
  });
}

TEST_CASE("when the new driver does not work, the old one opens the device again, and its users go on",
          "[host][swap][driver]") {
  struct Case {
    std::string trouble;
    std::string text;
    Words tried;
  };
  const std::vector<Case> cases{
      {"open", "the cable is off", {"cart 2 open", "cart 2 close"}},
      {"throw", "threw std::runtime_error: no cart today", {"cart 2 open", "cart 2 close"}},
      {"start", "the motors are hot", {"cart 2 open", "cart 2 start", "cart 2 close"}},
      {"wait", "it was not ready within 0.3 s", {"cart 2 open", "cart 2 close"}}};
  for (const ExecutiveOptions& kind : all_executives()) {
    for (const Case& bad : cases) {
      INFO(bad.trouble);
      LiveSystem live(ridden());
      live.run(kind, [&](LiveSystem& run) {
        ride(run);
        const std::string text = refusal(run, next_cart("test_cart_2", bad.trouble));
        CHECK_THAT(text, Contains("the new driver failed, and the old one is back: ") && Contains(bad.text));
        CHECK_THAT(run.context().reporter.last_alarm(), Contains("SWAP_UNDONE") && Contains(bad.text));
        CHECK(did(run, cart_of_content_users(run),
                  kLeavesStanding + bad.tried + Words{"cart 1 open", "cart 1 start", "cart 1 moves"}));
      });
    }
  }
}

TEST_CASE("a new driver that hangs keeps nobody waiting, and another one can follow when it has ended",
          "[host][swap][driver]") {
  LiveSystem live(ridden());
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    ride(run);
    const TimePoint before = run.executive().now();
    CHECK_THAT(refusal(run, next_cart("test_cart_2", "hang")),
               Contains("the old one is back: it was not ready within 0.3 s, and hangs"));
    CHECK(run.executive().now() - before < 3s);
    (void)cart_of_content_users(run);
    CHECK_THAT(refusal(run, next_cart("test_cart_2")), Contains("an earlier driver of it hangs"));
    run.sleep(5s);
    CHECK(swap(run, next_cart("test_cart_2")));
    (void)cart_of_content_users(run);
  });
}

TEST_CASE(
    "when the old driver cannot open the device again either, the hardware is in Fault, and its servers fail",
    "[host][swap][driver]") {
  LiveSystem live(ridden(R"(<param name="trouble" value="reopen"/>)"));
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    ride(run);
    CHECK_THAT(refusal(run, next_cart("test_cart_2", "open")),
               Contains("the old one does not open the device again (the cable is off)"));
    run.sleep(200ms);
    CHECK(state_of_cart(run) == hw::HardwareState::fault);
    CHECK(run.system().component("base")->has_failed());
  });
}

TEST_CASE("a driver that does not close the device keeps the base held, and that is a fault",
          "[host][swap][driver]") {
  LiveSystem live(ridden(R"(<param name="trouble" value="close"/>)"));
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    ride(run);
    CHECK_THAT(refusal(run, next_cart("test_cart_2")),
               Contains("the present driver does not close the device"));
    CHECK_THAT(run.context().reporter.last_alarm(), Contains("HARDWARE_FAULT"));
    CHECK(state_of_cart(run) == hw::HardwareState::fault);
    run.sleep(3s);
    CHECK(beginning(run.news(), "cart 1").back() == "cart 1 close");
  });
}

TEST_CASE("a base that an operator has stopped stays stopped under the new driver", "[host][swap][driver]") {
  LiveSystem live(ridden());
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    ride(run);
    CHECK(run.system().hold("emergency stop", Movers::all));
    REQUIRE(swap(run, next_cart("test_cart_2")));
    run.sleep(200ms);
    CHECK(beginning(run.news(), "cart 2 moves").empty());
    run.system().let_go();
    run.sleep(200ms);
    CHECK(beginning(run.news(), "cart 2") == Words{"cart 2 moves"});
  });
}

TEST_CASE("a second exchange of a driver is refused until the first one is done", "[host][swap][driver]") {
  LiveSystem live(ridden());
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    Swaps swaps(run.graph(), run.context(), run.catalogue(), run.system());
    Words outcomes;
    const auto note = [&](const Result<SwapReport>& result) {
      outcomes.push_back(result ? "taken" : result.error().text());
    };
    swaps.begin(next_cart("test_cart_2"), note);
    swaps.begin(next_cart("test_cart_2"), note);
    while (outcomes.size() < 2) run.changed().wait_until(swaps.go_on());
    CHECK_THAT(outcomes[0], Contains("another swap of it is under way"));
    CHECK(outcomes[1] == "taken");
  });
}

TEST_CASE("a system that is taken down during an exchange ends both drivers", "[host][swap][driver]") {
  LiveSystem live(ridden());
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    ride(run);
    Swaps swaps(run.graph(), run.context(), run.catalogue(), run.system());
    std::string outcome;
    swaps.begin(next_cart("test_cart_2", "wait"), [&](const Result<SwapReport>& result) {
      outcome = result ? "taken" : result.error().text();
    });
    while (beginning(run.diary.lines(), "cart 2 open").empty()) run.changed().wait_until(swaps.go_on());
    CHECK(run.system().take_down(run.soon()).empty());
    swaps.give_up();
    CHECK_THAT(outcome, Contains("the system was stopped before the swap was done"));
    CHECK(run.diary.lines().back() == "cart 2 close");
  });
}

TEST_CASE("a simulated robot whose driver is put back stands where it was left", "[host][swap][driver]") {
  LiveSystem live(ridden());
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.catalogue().add_folders({ORCA_BINARY_DIR "/plugins"});
    Result<LoadedType> type = run.catalogue().acquire(PluginKind::hardware, "orca.hw.Sim");
    REQUIRE(type);
    auto driver = std::make_unique<HardwareInstance>(run.context(), "scout", std::move(type).value());
    REQUIRE(driver
                ->construct({{"world", std::string(ORCA_SOURCE_DIR "/sim/worlds/court.xml")},
                             {"robot", std::string(ORCA_SOURCE_DIR "/sim/robots/nomad_scout.urdf")},
                             {"place", std::string("start")}})
                .ok());
    HardwarePlace scout(std::move(driver));
    hw::HardwareSeat& seat = scout.seat();
    const auto sensors = seat.sensors();
    const auto truth = std::ranges::find(sensors, hw::Source::truth, &hw::HardwareSeat::Sensor::source);
    REQUIRE(truth != sensors.end());
    const auto where = [&] {
      CHECK(eventually(run.executive(), [&] { return static_cast<bool>(seat.latest(*truth)); }));
      return object_cast<idl::RobotPose>(seat.latest(*truth))->x();
    };
    seat.acquire();
    scout.run(scout.driver());
    const double start = where();
    idl::MotionCommand ahead;
    ahead.speed(0.4);
    for (int i = 0; i < 20; ++i) {
      REQUIRE(seat.command(ahead).ok());
      run.sleep(100ms);
    }
    seat.pause("a test");
    scout.driver().container().shut_down();
    REQUIRE(scout.join_until(run.soon()));
    scout.run(scout.driver());
    seat.resume(scout.driver().container(), scout.driver().description());
    CHECK(where() - start == Approx(0.8).margin(0.2));
    scout.shut_down();
    CHECK(scout.join_until(run.soon()));
  });
}
