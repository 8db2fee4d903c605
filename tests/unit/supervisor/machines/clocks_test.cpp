// SPDX-License-Identifier: GPL-3.0-or-later
// The clocks of machines, compared over a network that delays what is said, and not equally both ways.
#include "machines/clocks.hpp"

#include <catch2/catch.hpp>

#include <memory>
#include <random>
#include <vector>

using namespace orca;
using supervisor::Clocks;

namespace {

// A clock that is ahead of the true time, and runs too fast.
struct WrongClock {
  Duration ahead{0};
  double drift = 0.0;  // of 1
  [[nodiscard]] TimePoint at(Duration true_time) const {
    constexpr auto kZero = TimePoint(std::chrono::hours(500'000));
    return kZero + true_time + ahead +
           Duration(static_cast<std::int64_t>(drift * static_cast<double>(true_time.count())));
  }
};

// The way from one machine to the other.
struct Way {
  Duration shortest = 100us;
  Duration jitter = 1ms;  // more than that takes one of twenty, up to ten times as much
  double loss = 0.0;
};

struct Speaker {
  Speaker(std::string called, std::string of_other, std::uint64_t number, WrongClock of)
      : name(std::move(called)), other(std::move(of_other)), run(number), clock(of), clocks(name, number) {}
  idl::MachineState says(Duration time, std::uint64_t other_run) const {
    idl::MachineState state;
    state.origin(name);
    state.run(run);
    idl::MachineRun heard;
    heard.machine(other);
    heard.run(other_run);
    state.heard().push_back(heard);
    clocks.fill(state, clock.at(time));
    return state;
  }
  std::string name, other;
  std::uint64_t run;
  WrongClock clock;
  Clocks clocks;
};

// Two machines that repeat their states as supervisors do.
class Two {
 public:
  Two(WrongClock of_base, WrongClock of_brain, unsigned seed = 1)
      : base("base", "brain", 17, of_base), brain("brain", "base", 18, of_brain), random_(seed) {}

  // Lets time pass. Each state is judged on its arrival.
  template <class Judge>
  void pass(Duration time, const Judge& judge) {
    for (const Duration end = now + time; now < end; now += 1ms) {
      if (now % 200ms == 0ms) say(base, brain, there);
      if (now % 200ms == 70ms) say(brain, base, back);
      std::erase_if(under_way_, [&](const Letter& letter) {
        if (letter.at > now) return false;
        letter.to->clocks.hear(letter.state, letter.to->clock.at(letter.at));
        judge(*letter.to, letter.at);
        return true;
      });
    }
  }
  void pass(Duration time) {
    pass(time, [](const Speaker&, Duration) {});
  }
  [[nodiscard]] Duration truth(const Speaker& at, Duration time) const {
    const Speaker& other = &at == &base ? brain : base;
    return other.clock.at(time) - at.clock.at(time);
  }
  [[nodiscard]] std::optional<Clocks::Offset> measured(const Speaker& at, Duration time) const {
    return at.clocks.offset(at.other, at.clock.at(time));
  }

  Speaker base, brain;
  Way there, back;
  Duration now{0};

 private:
  struct Letter {
    Speaker* to;
    idl::MachineState state;
    Duration at;
  };
  double dice() { return std::uniform_real_distribution(0.0, 1.0)(random_); }
  void say(Speaker& from, Speaker& to, const Way& way) {
    const double factor = dice() < 0.05 ? 10.0 : 1.0;
    const auto jitter = std::chrono::duration_cast<Duration>(way.jitter * dice() * factor);
    if (dice() >= way.loss) under_way_.push_back({&to, from.says(now, to.run), now + way.shortest + jitter});
  }

  std::mt19937 random_;
  std::vector<Letter> under_way_;
};

}  // namespace

TEST_CASE("the true difference of two clocks is never farther away than the error that is said",
          "[supervisor][machines][clocks]") {
  std::mt19937 random(5);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution(low, high)(random);
  };
  std::size_t judged = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    CAPTURE(seed);
    constexpr double kCrystal = 50e-6;  // two of them drift apart by at most 100 ppm
    Two two({from_seconds(between(-1e4, 1e4)), between(-kCrystal, kCrystal)},
            {from_seconds(between(-1e4, 1e4)), between(-kCrystal, kCrystal)}, seed);
    two.there = {from_seconds(between(0.0, 0.05)), from_seconds(between(0.0, 0.02)), between(0.0, 0.5)};
    two.back = {from_seconds(between(0.0, 0.05)), from_seconds(between(0.0, 0.02)), between(0.0, 0.5)};
    two.pass(100s, [&](const Speaker& at, Duration time) {
      const auto offset = two.measured(at, time);
      if (!offset) return;
      ++judged;
      INFO(time.count() << " " << offset->ahead.count() << " " << offset->error.count());
      const Duration slip = 1us;  // of a clock between two of its readings
      REQUIRE(abs(offset->ahead - two.truth(at, time)) <= offset->error + slip);
    });
  }
  CHECK(judged > 40'000);
}

TEST_CASE("on a quick network the difference is known to a fraction of a millisecond",
          "[supervisor][machines][clocks]") {
  Two two({}, {3s, 20e-6});
  two.there = two.back = {150us, 2ms, 0.1};
  two.pass(30s);
  const auto offset = two.measured(two.base, two.now);
  REQUIRE(offset);
  CHECK(offset->error < 1ms);
  CHECK(offset->round_trip < 2ms);
  CHECK(abs(offset->ahead - two.truth(two.base, two.now)) <= offset->error);
}

TEST_CASE("unequal ways deceive by half their difference, and the error says so",
          "[supervisor][machines][clocks]") {
  Two two({}, {});
  two.there = {1ms, 0ms, 0.0};
  two.back = {81ms, 0ms, 0.0};
  two.pass(10s);
  const auto offset = two.measured(two.base, two.now);
  REQUIRE(offset);
  CHECK(abs(offset->ahead + 40ms) < 1ms);
  CHECK(offset->error >= 40ms);
  CHECK(two.base.clocks.take_news().empty());  // so it is no reason for an alarm
  CHECK(two.base.clocks.correction("brain") == 0ms);
}

TEST_CASE("clocks that agree within what is tolerated are left alone", "[supervisor][machines][clocks]") {
  Two two({}, {15ms, 0.0});
  two.pass(10s);
  CHECK(two.base.clocks.take_news().empty());
  CHECK(two.base.clocks.correction("brain") == 0ms);
}

TEST_CASE("a clock that differs is reported once on both sides, and corrected to and fro",
          "[supervisor][machines][clocks]") {
  Two two({}, {-2s, 0.0});
  two.pass(10s);
  for (Speaker* const at : {&two.base, &two.brain}) {
    const auto news = at->clocks.take_news();
    REQUIRE(news.size() == 1);
    CHECK(news[0].differs);
    CHECK(news[0].machine == at->other);
    const auto offset = two.measured(*at, two.now);
    REQUIRE(offset);
    CHECK(abs(at->clocks.correction(at->other) - two.truth(*at, two.now)) <= 2 * offset->error);
  }
}

TEST_CASE("a correction stays as it is while it may be true, so that instants keep their order",
          "[supervisor][machines][clocks]") {
  Two two({}, {1s, 0.0});
  two.there = two.back = {1ms, 10ms, 0.2};
  two.pass(2s);
  const Duration first = two.base.clocks.correction("brain");
  std::size_t changes = 0;
  Duration last = first;
  two.pass(300s, [&](const Speaker& at, Duration) {
    if (at.name != "base") return;
    const Duration present = at.clocks.correction("brain");
    changes += present != last ? 1 : 0;
    last = present;
  });
  CHECK(changes <= 3);
  CHECK(abs(last - 1s) < 5ms);
}

TEST_CASE("a clock that a time service pulls along is followed, and the report is settled in the end",
          "[supervisor][machines][clocks]") {
  Two two({}, {500ms, 0.0});
  two.pass(5s);
  REQUIRE(two.base.clocks.take_news().size() == 1);
  two.brain.clock.ahead = 2ms;  // set by its service
  two.pass(5s);
  const auto news = two.base.clocks.take_news();
  REQUIRE(news.size() == 1);
  CHECK_FALSE(news[0].differs);
  CHECK(two.base.clocks.correction("brain") == 0ms);
  const auto offset = two.measured(two.base, two.now);
  REQUIRE(offset);
  CHECK(abs(offset->ahead - 2ms) <= offset->error);
}

TEST_CASE("what was measured is forgotten after a minute of silence", "[supervisor][machines][clocks]") {
  Two two({}, {});
  two.pass(5s);
  REQUIRE(two.measured(two.base, two.now));
  CHECK(two.measured(two.base, two.now + 50s));
  CHECK(two.measured(two.base, two.now + 50s)->error > two.measured(two.base, two.now)->error + 4ms);
  CHECK_FALSE(two.measured(two.base, two.now + 70s));
}

TEST_CASE("a later run has a clock of its own", "[supervisor][machines][clocks]") {
  Two two({}, {1s, 0.0});
  two.pass(5s);
  std::destroy_at(&two.brain.clocks);
  std::construct_at(&two.brain.clocks, "brain", std::uint64_t{19});
  two.brain.run = 19;
  two.brain.clock.ahead = 0s;
  two.pass(5s);
  const auto offset = two.measured(two.base, two.now);
  REQUIRE(offset);
  CHECK(abs(offset->ahead) <= offset->error);
}

TEST_CASE("times that cannot be are not measured by", "[supervisor][machines][clocks]") {
  Clocks clocks("base", 17);
  const WrongClock clock;
  const auto hear = [&](std::int64_t made, std::int64_t said, std::int64_t waited) {
    idl::MachineState state;
    state.origin("brain");
    state.run(18);
    state.creation_time().ns(made);
    idl::MachineRun heard;
    heard.machine("base");
    heard.run(17);
    heard.said().ns(said);
    heard.waited(waited);
    state.heard().push_back(heard);
    clocks.hear(state, clock.at(10s));
  };
  const std::int64_t now = clock.at(10s).time_since_epoch().count();
  for (const std::int64_t made : {INT64_MIN, std::int64_t{-1}, std::int64_t{0}, INT64_MAX})
    hear(made, now - 1000, 500);
  for (const std::int64_t said : {INT64_MIN, std::int64_t{0}, now + 1000, now - 61'000'000'000, INT64_MAX})
    hear(now, said, 0);
  for (const std::int64_t waited : {INT64_MIN, std::int64_t{-1}, std::int64_t{2000}, INT64_MAX})
    hear(now, now - 1000, waited);
  CHECK_FALSE(clocks.offset("brain", clock.at(10s)));
  hear(now, now - 1000, 500);
  CHECK(clocks.offset("brain", clock.at(10s)));
}
