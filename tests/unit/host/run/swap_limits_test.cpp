// SPDX-License-Identifier: GPL-3.0-or-later
// What is refused in an exchange stays refused, and what cannot give its state gives way.
#include <catch2/catch.hpp>
#include <string>
#include <variant>

#include "orca/plugin/library.hpp"
#include "swap_order.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;

namespace {

// The order to exchange the napper for another one like it.
SwapOrder next_napper() {
  Result<plugin::PluginImage> image = plugin::PluginImage::copy(host_plugin("test_napper"));
  if (!image) throw std::runtime_error(image.error().text());
  return {"napper", std::move(image).value()};
}

}  // namespace

TEST_CASE("what is refused because a component is in a long lap is never carried out", "[host][swap]") {
  for (const ExecutiveOptions& kind : virtual_executives()) {
    LiveSystem live(R"(<component name="napper" type="test.Napper"/>)");
    live.run(kind, [](LiveSystem& run) {
      run.sleep(100ms);
      REQUIRE(run.set("napper", {{"nap", "20"}}).ok());
      run.sleep(1s);
      SwapOrder order = next_napper();
      const std::string name = order.plugin.mapped_name();
      CHECK_THAT(refusal(run, std::move(order)),
                 Contains("has not come to the end of a lap within 5 s; it is in work()") &&
                     Contains("orcactl restart begins its process anew"));
      CHECK_FALSE(plugin::is_mapped(name));
      const Status set = run.set("napper", {{"mood", "fine"}});
      REQUIRE_FALSE(set.ok());
      CHECK_THAT(set.error().text(), Contains("has not come to the end of a lap in time; it is in work()"));
      run.sleep(30s);
      CHECK(std::get<std::string>(run.system().component("napper")->parts().params.values().at("mood")) ==
            "good");
      CHECK(swap(run, next_napper()));
    });
  }
}

TEST_CASE("with --fresh the old object is not asked for its state, and the new one begins without it",
          "[host][swap]") {
  LiveSystem live(kPair);
  live.run(virtual_executives().front(), [](LiveSystem& run) {
    run.sleep(100ms);
    REQUIRE(swap(run, next_teller("test_teller_save")));
    CHECK_THAT(refusal(run, next_teller("test_teller_again")),
               Contains("no state today") && Contains("--fresh lets the new one begin"));
    SwapOrder fresh = next_teller("test_teller_again");
    fresh.fresh = true;
    const Result<SwapReport> done = swap(run, std::move(fresh));
    REQUIRE(done);
    CHECK(done->state.empty());
  });
}
