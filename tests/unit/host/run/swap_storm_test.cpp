// SPDX-License-Identifier: GPL-3.0-or-later
// Swap after swap under traffic: nothing is lost, doubled or out of order, and nothing is left behind.
#include <malloc.h>

#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <fstream>
#include <vector>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "swap_order.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;

namespace {

// What the gauge has seen, in memory that is there before.
struct Seen {
  std::atomic<std::int64_t> faults{0};
  std::vector<TimePoint> laps;
};
Seen g_seen;

// Takes what the teller says, a thousand times a second. The count must go up by one each time.
class Gauge final : public Component {
 public:
  explicit Gauge(ComponentHost& host) : Component(host) { lap_on(in_); }

 private:
  Status configure() override {
    stay_active(true);
    return ok();
  }
  Outcome work() override {
    while (in_.new_data_arrived()) {
      const std::string word(in_.get_update()->name());
      const std::int64_t count = std::stoll(word.substr(word.find(':') + 1));
      if (last_ != 0 && count != last_ + 1) ++g_seen.faults;
      last_ = count;
      if (g_seen.laps.size() < g_seen.laps.capacity()) g_seen.laps.push_back(now());
    }
    return again();
  }

  PushProxy<idl::GoalPoint> in_{*this, "in"};
  std::int64_t last_ = 0;
};

constexpr TypeEntry kGauge{PluginKind::component, "test.Gauge",
                           detail::create<Gauge, Component, ComponentHost>, detail::destroy<Component>};

const std::string kTraffic = R"(<component name="teller" type="test.Teller"/>
  <component name="talker" type="test.Talker"><param name="period" value="1 ms"/>
    <param name="tells" value="false"/></component>
  <component name="gauge" type="test.Gauge"/>
  <connect from="talker.out" to="teller.in" queue="10000"/>
  <connect from="talker.poke" to="teller.poke" queue="10000"/>
  <connect from="teller.out" to="talker.back" queue="latest"/>
  <connect from="teller.out" to="gauge.in" queue="10000"/>)";

std::size_t orca_images() {
  std::ifstream maps("/proc/self/maps");
  std::size_t count = 0;
  for (std::string line; std::getline(maps, line);)
    count +=
        line.find("/memfd:orca:") != std::string::npos && line.find(" r-xp ") != std::string::npos ? 1 : 0;
  return count;
}

std::size_t heap_in_use() { return mallinfo2().uordblks; }

// Large blocks are not in the heap. The test itself has one that grows, its diary.
std::size_t large_blocks() { return mallinfo2().hblks; }

// Returns the gap between two laps that a fraction of the gaps does not exceed.
Duration gap_at(const std::vector<TimePoint>& laps, double fraction) {
  std::vector<Duration> gaps;
  for (std::size_t i = 1; i < laps.size(); ++i) gaps.push_back(laps[i] - laps[i - 1]);
  std::ranges::sort(gaps);
  return gaps.at(static_cast<std::size_t>(fraction * static_cast<double>(gaps.size() - 1)));
}

struct Storm {
  std::vector<Duration> pauses;
  std::vector<TimePoint> laps;
  double growth = 0.0;  // [bytes] of the heap, per swap
  std::vector<std::string> said;
};

Storm swap_again_and_again(int times, Duration quiet) {
  g_seen.laps.clear();
  g_seen.laps.reserve(2'000'000);
  Storm storm;
  storm.pauses.reserve(20'000);
  const std::size_t images_before = orca_images();  // those that other cases have pinned
  LiveSystem live(kTraffic);
  live.add(kGauge);
  live.run({ClockKind::steady, Backend::thread}, [&](LiveSystem& run) {
    run.sleep(200ms);
    const auto exchange = [&](int i) {
      SwapOrder order = next_teller(i % 2 == 0 ? "test_teller_2" : "test_teller_again");
      order.probation = 1ms;
      order.trial = plugin::Trial::done;  // the deployer tries it in a process of its own, before
      const Result<SwapReport> report = test::swap(run, std::move(order));
      REQUIRE(report);
      CHECK(report->state == "test.Teller/1");
      storm.pauses.push_back(report->pause);
    };
    const int warm_up = std::min(times, 20);
    for (int i = 0; i < warm_up; ++i) exchange(i);
    const std::size_t before = heap_in_use();
    const std::size_t large_before = large_blocks();
    for (int i = 0; i < times; ++i) exchange(i);
    storm.growth = (static_cast<double>(heap_in_use()) - static_cast<double>(before)) / std::max(times, 1);
    CHECK(large_blocks() <= large_before + 1);
    if (times > 0) CHECK(orca_images() == images_before + 1);
    run.sleep(quiet);
  });
  CHECK(orca_images() == images_before);
  storm.laps = g_seen.laps;
  for (const std::string& word : live.news())
    if (word.starts_with("gap") || word.starts_with("poke") || word.starts_with("not sent"))
      storm.said.push_back(word);
  return storm;
}

}  // namespace

TEST_CASE("two hundred swaps under a thousand objects a second lose nothing and leave nothing behind",
          "[host][swap]") {
  const Storm storm = swap_again_and_again(200, 100ms);
  CHECK(g_seen.faults == 0);
  CHECK(storm.said.empty());
}

TEST_CASE("ten thousand swaps: nothing is lost, and the rhythm of the laps stays", "[.][slow][swap]") {
  const Storm calm = swap_again_and_again(0, 60s);
  Storm storm = swap_again_and_again(10'000, 100ms);
  CHECK(g_seen.faults == 0);
  CHECK(storm.said.empty());
  std::ranges::sort(storm.pauses);
  const double median = to_seconds(storm.pauses[storm.pauses.size() / 2]);
  WARN("exchange: median " << median * 1e6 << " us, longest " << to_seconds(storm.pauses.back()) * 1e6
                           << " us; gap of laps at 99.9 %: " << to_seconds(gap_at(storm.laps, 0.999)) * 1e3
                           << " ms, without swaps " << to_seconds(gap_at(calm.laps, 0.999)) * 1e3
                           << " ms; heap grows by " << storm.growth << " bytes per swap");
  CHECK(storm.growth < 64.0);
}
