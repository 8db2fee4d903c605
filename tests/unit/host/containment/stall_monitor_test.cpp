// SPDX-License-Identifier: GPL-3.0-or-later
#include "containment/stall_monitor.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <future>

using namespace orca;
using namespace orca::host;
using Catch::Contains;

namespace {

/// An executive that runs nothing, and reports that one task is stuck.
class StuckExecutive final : public Executive {
 public:
  explicit StuckExecutive(StuckTask task) : task_(std::move(task)) {}

  [[nodiscard]] TimePoint now() const override { return {}; }
  [[nodiscard]] bool is_virtual() const override { return task_.holds_up_others; }
  [[nodiscard]] bool tasks_overlap() const override { return !task_.holds_up_others; }
  [[nodiscard]] std::unique_ptr<Event> make_event() override { return nullptr; }
  [[nodiscard]] std::unique_ptr<Event> make_doorbell_event(DoorbellWord&) override { return nullptr; }
  [[nodiscard]] std::unique_ptr<Task> spawn(TaskOptions /*options*/,
                                            std::function<void()> /*body*/) override {
    return nullptr;
  }
  void run(std::function<void()> /*main*/) override {}
  [[nodiscard]] std::optional<StuckTask> stuck_task(Duration limit) override {
    limit_ = limit;
    if (++asked_ == 3) asked_thrice_.set_value();
    return task_;
  }
  void wait_until_asked_thrice() { asked_thrice_.get_future().wait(); }
  [[nodiscard]] Duration limit() const { return limit_; }  // asked for last

 private:
  StuckTask task_;
  int asked_ = 0;
  std::atomic<Duration> limit_{Duration{0}};
  std::promise<void> asked_thrice_;
};

const std::atomic<Duration> kNone{Duration{0}};

}  // namespace

TEST_CASE("a component that is stuck in a thread of its own raises one alarm", "[host][stall]") {
  StuckExecutive executive({"greedy", false, false});
  std::vector<idl::Alarm> alarms;
  int standstills = 0;
  {
    const StallMonitor monitor(
        executive, [&](const idl::Alarm& alarm) { alarms.push_back(alarm); },
        [&](const auto& /*component*/, const auto& /*text*/) { ++standstills; }, kNone);
    executive.wait_until_asked_thrice();
  }
  CHECK(standstills == 0);
  REQUIRE(alarms.size() == 1);
  CHECK(alarms[0].kind() == idl::STALLED);
  CHECK(alarms[0].source() == "greedy");
  CHECK(alarms[0].severity() == idl::ALARM_WARNING);
}

TEST_CASE("a component that holds up all others is a standstill, and no alarm", "[host][stall]") {
  StuckExecutive executive({"greedy", true, true});
  int alarms = 0;
  std::string said;
  {
    const StallMonitor monitor(
        executive, [&](const idl::Alarm& /*alarm*/) { ++alarms; },
        [&](const std::string& component, const std::string& text) { said = component + " " + text; }, kNone);
    executive.wait_until_asked_thrice();
  }
  CHECK(alarms == 0);
  CHECK_THAT(said, Contains("greedy has slept in the system for more than 2 s"));
}

TEST_CASE("while a hang limit is set, a component that is stuck for so long is a standstill",
          "[host][stall]") {
  StuckExecutive executive({"greedy", false, false});
  const std::atomic<Duration> limit{Duration{500ms}};
  int alarms = 0;
  std::string said;
  {
    const StallMonitor monitor(
        executive, [&](const idl::Alarm& /*alarm*/) { ++alarms; },
        [&](const std::string& component, const std::string& text) { said = component + " " + text; }, limit);
    executive.wait_until_asked_thrice();
  }
  CHECK(executive.limit() == limit.load());
  CHECK(alarms == 0);
  CHECK_THAT(said, Contains("greedy has computed or slept for more than 0.5 s"));
}
