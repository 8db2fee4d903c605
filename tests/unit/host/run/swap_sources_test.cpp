// SPDX-License-Identifier: GPL-3.0-or-later
// The exchange of a component with a port array. The new object knows the sources by the places at which it finds them when it
// is configured; so they must be those of the port that it takes over.
#include <catch2/catch.hpp>

#include <set>

#include "orca/patterns/local/local_links.hpp"
#include "swap_order.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

namespace {

const std::string kThree = R"(<component name="merger" type="test.Merger"/>
  <component name="a" type="test.Talker"/>
  <component name="b" type="test.Talker"/>
  <component name="c" type="test.Talker"/>
  <connect from="a.out" to="merger.in"/>
  <connect from="b.out" to="merger.in"/>
  <connect from="c.out" to="merger.in"/>)";

/// A system with a merger whose connections change. Tasks do not overlap, so the test may do that between two laps.
class Merging {
 public:
  explicit Merging(LiveSystem& live) : live_(live) {}

  void remove(const std::string& source) {
    std::erase_if(graph_.edges, [&](const graph::Edge& edge) { return edge.from.component == source; });
    Links::leave(merger(), source + ".out");
    Links::leave(out(source), merger().path());
  }

  void add(const std::string& source) {
    graph::Edge edge = live_.graph().edges.front();
    edge.from.component = source;
    graph_.edges.push_back(edge);
    REQUIRE(LocalLinks().connect(out(source), merger()).ok());
  }

  /// Exchanges the merger for another object of the same code.
  void swap() {
    Result<plugin::PluginImage> image = plugin::PluginImage::copy(host_plugin("test_merger"));
    REQUIRE(image);
    const Result<SwapReport> done = orca::test::swap(live_, {"merger", std::move(image).value()}, graph_);
    INFO((done ? "" : done.error().text()));
    REQUIRE(done);
  }

  /// Returns what the merger hears in a while.
  [[nodiscard]] std::set<std::string> hears() {
    (void)live_.news();
    live_.sleep(100ms);
    std::set<std::string> heard;
    for (const std::string& line : live_.news())
      if (line.find(" brings ") != std::string::npos) heard.insert(line);
    return heard;
  }

 private:
  [[nodiscard]] Endpoint& merger() const { return *live_.system().endpoint({"merger", "in"}); }
  [[nodiscard]] Endpoint& out(const std::string& source) const {
    return *live_.system().endpoint({source, "out"});
  }

  LiveSystem& live_;
  graph::Graph graph_ = live_.graph();
};

const std::set<std::string> kAll{"a.out brings a.out", "b.out brings b.out", "c.out brings c.out"};

void with_merger(const std::function<void(Merging&)>& body) {
  LiveSystem live(kThree);
  live.run(virtual_executives().front(), [&](LiveSystem& run) {
    Merging merging(run);
    REQUIRE(merging.hears() == kAll);
    body(merging);
  });
}

}  // namespace

TEST_CASE(
    "a new object finds the sources of an array in the places of the old one after one of them was connected "
    "anew",
    "[host][swap][array]") {
  with_merger([](Merging& merging) {
    merging.remove("a");
    merging.add("a");
    merging.swap();
    CHECK(merging.hears() == kAll);
    merging.swap();
    CHECK(merging.hears() == kAll);
  });
}

TEST_CASE("a new object finds the sources of an array in their places after another one was removed",
          "[host][swap][array]") {
  with_merger([](Merging& merging) {
    merging.remove("a");
    merging.swap();
    CHECK(merging.hears() == std::set<std::string>{"b.out brings b.out", "c.out brings c.out"});
    merging.add("a");
    merging.swap();
    CHECK(merging.hears() == kAll);
  });
}
