// SPDX-License-Identifier: GPL-3.0-or-later
// New code is tried with what has reached a component, in a copy of the process.
#include "orca/host/shadow.hpp"

#include <catch2/catch.hpp>
#include <optional>

#include "orca/graph/loader.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/time.hpp"
#include "orca/plugin/library.hpp"
#include "swap_order.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;

#if !defined(__SANITIZE_THREAD__)  // which cannot follow a copy of a process
namespace {

#if defined(__SANITIZE_ADDRESS__)
// The sanitizer's memory fits into no limit, so the code goes on until its time is over.
constexpr const char* kEndOfMemory = "its laps, in the shadow of the present one, did not return";
constexpr Duration kTimeToEat = 1s;
#else
constexpr const char* kEndOfMemory = "bad_alloc";
constexpr Duration kTimeToEat = 60s;
#endif

constexpr TimePoint kBegin{Duration{50s}};

SeenObject seen_command(int number) {
  ObjectLoan object = make_object(object_type<idl::MotionCommand>());
  const TimePoint time = kBegin + number * 10ms;
  object.header().creation_time(to_time_value(time));
  object.header().origin() = "talker";
  object.header().seq(static_cast<std::uint64_t>(number));
  return {"in", std::move(object), time};
}

SeenObject poke(int number) {
  ObjectLoan object = make_object(object_type<idl::GoalPoint>());
  static_cast<idl::GoalPoint*>(object.get())->name() = std::to_string(number);
  return {"poke", std::move(object), kBegin + number * 10ms};
}

// A hundred commands and ten pokes in a second.
std::vector<SeenObject> a_second() {
  std::vector<SeenObject> seen;
  for (int i = 1; i <= 100; ++i) {
    seen.push_back(seen_command(i));
    if (i <= 10) seen.push_back(poke(i));
  }
  return seen;
}

// Returns the checked graph of the teller and the talker.
const graph::Graph& telling() {
  static PluginCatalogue catalogue{plugin::PluginIndex({ORCA_BINARY_DIR "/tests/host_plugins"})};
  static const std::optional<graph::Graph> graph = [] {
    xml::Diagnostics diagnostics;
    return graph::load_text("<graph name=\"telling\" version=\"1\">" + kPair + "</graph>", "telling.xml", {},
                            catalogue, diagnostics);
  }();
  return graph.value();
}

Result<ShadowReport> try_teller(const std::string& version, std::vector<SeenObject> seen = a_second(),
                                const std::map<std::string, std::string>& params = {},
                                const std::function<bool()>& give_up = {}, Duration span = 1s) {
  SwapOrder swap = next_teller(version);
  ShadowOrder order{telling(), "teller", "test.Teller", {}, telling().find_component("teller")->params,
                    params,    span};
  return run_in_shadow(order, swap.plugin, seen, give_up);
}

}  // namespace

TEST_CASE("new code that works gets all objects at their times, and what it says reaches nobody",
          "[host][shadow]") {
  const Result<ShadowReport> tried = try_teller("test_teller_2");
  REQUIRE(tried);
  INFO(tried->untried);
  CHECK(tried->untried.empty());
  CHECK(tried->given == 110);
  CHECK(tried->pushed == 100);
}

TEST_CASE("new code may get nothing at all", "[host][shadow]") {
  const Result<ShadowReport> tried = try_teller("test_teller_2", {});
  REQUIRE(tried);
  CHECK(tried->untried.empty());
  CHECK(tried->given == 0);
}

TEST_CASE("nothing of the code that was tried is in this process", "[host][shadow]") {
  SwapOrder swap = next_teller("test_teller_2");
  const std::string name = swap.plugin.mapped_name();
  std::vector<SeenObject> seen = a_second();
  REQUIRE(run_in_shadow({telling(), "teller", "test.Teller", {}, {}, {}, 1s}, swap.plugin, seen, {}));
  CHECK_FALSE(plugin::is_mapped(name));
}

TEST_CASE("code that fails, crashes, hangs or takes all memory in the shadow is refused with where and how",
          "[host][shadow]") {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"test_teller_constructor", "no teller today"},
      {"test_teller_configure", "is not liked today"},
      {"test_teller_start", "no start today"},
      {"test_teller_first_lap", "work() threw std::runtime_error: no lap today"},
      {"test_teller_third_lap", "work() threw std::runtime_error: no lap today"},
      {"test_teller_handler", "no poke today"},
      {"test_teller_constructor_crashes", "its static initialisation, its constructor or its destructor"},
      {"test_teller_destructor_crashes", "its static initialisation, its constructor or its destructor"},
      {"test_teller_lap_crashes", "its laps, in the shadow of the present one, "}};
  for (const auto& [version, text] : cases) {
    const Result<ShadowReport> tried = try_teller(version);
    INFO(version);
    REQUIRE_FALSE(tried);
    CHECK_THAT(tried.error().text(), Contains(text));
  }
  // A busy machine needs some time to fill the memory that the copy may have.
  const Result<ShadowReport> eats = try_teller("test_teller_lap_eats", a_second(), {}, {}, kTimeToEat);
  REQUIRE_FALSE(eats);
  CHECK_THAT(eats.error().text(), Contains(kEndOfMemory));
  const Result<ShadowReport> hangs = try_teller("test_teller_lap_hangs");
  REQUIRE_FALSE(hangs);
  CHECK(hangs.error().code == Code::deadline_exceeded);
  CHECK_THAT(hangs.error().text(), Contains("its laps"));
}

TEST_CASE("parameters are those of the order, and wrong ones are refused", "[host][shadow]") {
  CHECK(try_teller("test_teller_2", a_second(), {{"step", "5"}}));
  const Result<ShadowReport> wrong = try_teller("test_teller_2", a_second(), {{"step", "70"}});
  REQUIRE_FALSE(wrong);
  CHECK_THAT(wrong.error().text(), Contains("step"));
}

TEST_CASE("a trial that is given up says nothing about the code", "[host][shadow]") {
  const Result<ShadowReport> tried = try_teller("test_teller_lap_hangs", a_second(), {}, [] { return true; });
  REQUIRE(tried);
  CHECK_FALSE(tried->untried.empty());
}

TEST_CASE("what an object on trial sends counts as accepted, and reaches nobody", "[host][shadow]") {
  Result<plugin::PluginImage> image =
      plugin::PluginImage::copy(ORCA_BINARY_DIR "/tests/host_plugins/test_talker.so");
  REQUIRE(image);
  std::vector<SeenObject> none;
  const ShadowOrder order{telling(), "talker", "test.Talker", {}, {}, {{"period", "10 ms"}}, 1s};
  const Result<ShadowReport> tried = run_in_shadow(order, *image, none, {});
  INFO((tried ? tried->untried : tried.error().text()));
  REQUIRE(tried);
  CHECK(tried->untried.empty());
  CHECK(tried->pushed > 50);
}

TEST_CASE("code that could not give its state to a next version is refused", "[host][shadow]") {
  const Result<ShadowReport> throws = try_teller("test_teller_save");
  REQUIRE_FALSE(throws);
  CHECK_THAT(throws.error().text(), Contains("save_state() threw std::runtime_error: no state today"));
  const Result<ShadowReport> cannot_load = try_teller("test_teller_odd");
  REQUIRE_FALSE(cannot_load);
  CHECK_THAT(cannot_load.error().text(), Contains("value 1 of the state is a whole number"));
}
#endif
