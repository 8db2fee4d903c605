// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/activity.hpp"

#include <catch2/catch.hpp>

#include <string>

#include "orca/base/executive.hpp"

using namespace orca;

namespace {

std::string now_doing() { return Activity::current() == nullptr ? "" : Activity::current()->who(); }

}  // namespace

TEST_CASE("the innermost activity is the current one, and the outer one comes back", "[base][activity]") {
  CHECK(now_doing().empty());
  {
    const Activity outer("avoid", Hook::work, nullptr);
    {
      const Activity inner("avoid's sonar", Hook::handler, &outer, "sonar");
      CHECK(now_doing() == "avoid's sonar");
      CHECK(Activity::current()->hook() == Hook::handler);
      CHECK(std::string(Activity::current()->port()) == "sonar");
      CHECK(Activity::current()->code() == &outer);
    }
    CHECK(now_doing() == "avoid");
  }
  CHECK(now_doing().empty());
}

TEST_CASE("each task has its own activity, also while another one runs, with every executive",
          "[base][activity]") {
  const auto options = GENERATE(ExecutiveOptions{ClockKind::virtual_time, Backend::fiber},
                                ExecutiveOptions{ClockKind::virtual_time, Backend::baton},
                                ExecutiveOptions{ClockKind::steady, Backend::thread});
  const auto executive = std::move(make_executive(options)).value();
  std::string first, second, after;
  executive->run([&] {
    const TimePoint start = executive->now();
    const auto a = executive->spawn({"a", 0}, [&] {
      const Activity activity("a", Hook::work, nullptr);
      executive->sleep_until(start + 20ms);
      first = now_doing();
    });
    const auto b = executive->spawn({"b", 0}, [&] {
      const Activity activity("b", Hook::work, nullptr);
      executive->sleep_until(start + 10ms);
      second = now_doing();
      executive->sleep_until(start + 30ms);
    });
    CHECK(a->join_until(kForever));
    CHECK(b->join_until(kForever));
    after = now_doing();
  });
  CHECK(first == "a");
  CHECK(second == "b");
  CHECK(after.empty());
}
