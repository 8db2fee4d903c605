// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/supervisor/restart_policy.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace orca;
using namespace orca::supervisor;
using graph::Restart;
using graph::Strategy;

namespace {

using Indices = std::vector<std::size_t>;

constexpr auto kPermanent = Restart::permanent, kTransient = Restart::transient,
               kTemporary = Restart::temporary;
constexpr Moment kStart{100s};

std::vector<graph::ProcessNode> nodes(const std::vector<Restart>& rules) {
  std::vector<graph::ProcessNode> processes(rules.size());
  for (std::size_t i = 0; i < rules.size(); ++i) processes[i].restart = rules[i];
  return processes;
}

graph::Supervision supervision(Strategy strategy, int restarts = 3, Duration within = 10s) {
  graph::Supervision rules;
  rules.strategy = strategy;
  rules.restarts = restarts;
  rules.within = within;
  return rules;
}

// One row: who is ended, and in what way, and what follows, when processes 0 to 3 run.
struct Row {
  Strategy strategy;
  std::vector<Restart> rules;
  std::size_t process;
  bool is_normal;
  Indices end;     // what is to be ended with it
  Indices starts;  // what is started when they have ended
};

const std::vector<Restart> kAllPermanent(4, kPermanent);
const std::vector<Restart> kMixed{kPermanent, kTransient, kTemporary, kPermanent};

}  // namespace

TEST_CASE("Rule and strategy decide who is started again", "[supervisor][restart]") {
  const auto row = GENERATE(values<Row>({
      {Strategy::one_for_one, kAllPermanent, 1, false, {}, {1}},
      {Strategy::one_for_one, kAllPermanent, 1, true, {}, {1}},
      {Strategy::one_for_one, kMixed, 1, false, {}, {1}},
      {Strategy::one_for_one, kMixed, 1, true, {}, {}},
      {Strategy::one_for_one, kMixed, 2, false, {}, {}},
      {Strategy::rest_for_one, kAllPermanent, 1, false, {3, 2}, {1, 2, 3}},
      {Strategy::rest_for_one, kAllPermanent, 3, false, {}, {3}},
      {Strategy::rest_for_one, kMixed, 0, true, {3, 2, 1}, {0, 1, 3}},
      {Strategy::rest_for_one, kMixed, 1, true, {}, {}},
      {Strategy::one_for_all, kAllPermanent, 2, false, {3, 1, 0}, {0, 1, 2, 3}},
      {Strategy::one_for_all, kMixed, 3, false, {2, 1, 0}, {0, 1, 3}},
      {Strategy::one_for_all, kMixed, 2, false, {}, {}},
  }));
  RestartPolicy policy(nodes(row.rules), supervision(row.strategy));
  const RestartDecision decision = policy.ended(row.process, row.is_normal, kStart);
  CHECK(decision.end == row.end);
  CHECK(decision.restarts == !row.starts.empty());
  CHECK_FALSE(decision.gives_up);
  for (const std::size_t process : row.end) {
    CHECK(policy.take_due(kStart + 10s).empty());  // not before all have ended
    CHECK_FALSE(policy.due());
    CHECK_FALSE(policy.ended(process, process % 2 == 0, kStart).restarts);
  }
  CHECK(policy.due().has_value() == !row.starts.empty());
  CHECK(policy.take_due(kStart) == row.starts);
  CHECK(policy.take_due(kStart + 10s).empty());  // once
}

TEST_CASE("The first restart follows at once, later ones wait longer and longer", "[supervisor][restart]") {
  RestartPolicy policy(nodes({kPermanent}), supervision(Strategy::one_for_one, 100, 60s));
  Moment now = kStart;
  std::vector<Duration> delays;
  for (int i = 0; i < 10; ++i) {
    CHECK(policy.ended(0, false, now).restarts);
    delays.push_back(*policy.due() - now);
    CHECK(policy.take_due(*policy.due() - 1ns).empty());
    now = *policy.due();
    CHECK(policy.take_due(now) == Indices{0});
  }
  CHECK(delays == std::vector<Duration>{0s, 50ms, 100ms, 200ms, 400ms, 800ms, 1600ms, 2s, 2s, 2s});
  now += 60s;
  CHECK(policy.ended(0, false, now).restarts);
  CHECK(policy.due() == now);
}

TEST_CASE("Too many restarts within the period end everything", "[supervisor][restart]") {
  RestartPolicy policy(nodes(kMixed), supervision(Strategy::one_for_one, 3, 10s));
  for (int i = 0; i < 3; ++i) {
    CHECK(policy.ended(3, false, kStart + i * 3s).restarts);
    CHECK(policy.take_due(kStart + i * 3s + 2s) == Indices{3});
  }
  const RestartDecision last = policy.ended(0, false, kStart + 9999ms);
  CHECK(last.gives_up);
  CHECK_FALSE(last.restarts);
  CHECK(last.end == Indices{3, 2, 1});
  for (const std::size_t process : last.end) CHECK(policy.ended(process, false, kStart + 10s).end.empty());
  CHECK_FALSE(policy.due());
  CHECK(policy.take_due(kStart + 100s).empty());
}

TEST_CASE("Faults that another program has caused are never too many, and wait like others",
          "[supervisor][restart]") {
  RestartPolicy policy(nodes(kAllPermanent), supervision(Strategy::one_for_one));
  Moment now = kStart;
  for (int i = 0; i < 100; ++i) {
    REQUIRE_FALSE(policy.ended(1, false, now, false).gives_up);
    now = *policy.due();
    REQUIRE(policy.take_due(now) == Indices{1});
  }
  CHECK(now - kStart > 90 * 2s);
  for (int i = 0; i < 3; ++i) {
    REQUIRE_FALSE(policy.ended(0, false, now).gives_up);
    now = *policy.due();
    REQUIRE(policy.take_due(now) == Indices{0});
  }
  CHECK(policy.ended(0, false, now).gives_up);
}

TEST_CASE("Restarts that are spread out are never too many", "[supervisor][restart]") {
  RestartPolicy policy(nodes({kPermanent}), supervision(Strategy::one_for_one, 3, 10s));
  for (int i = 0; i < 100; ++i) {
    const Moment now = kStart + i * 3400ms;
    CHECK(policy.ended(0, false, now).restarts);
    CHECK(policy.take_due(now + 3s) == Indices{0});
  }
}

TEST_CASE("No restarts at all may be allowed", "[supervisor][restart]") {
  RestartPolicy policy(nodes(kAllPermanent), supervision(Strategy::one_for_one, 0));
  CHECK(policy.ended(1, false, kStart).gives_up);
}

TEST_CASE("A process that fails while others are being ended joins them", "[supervisor][restart]") {
  RestartPolicy policy(nodes(kAllPermanent), supervision(Strategy::rest_for_one));
  CHECK(policy.ended(2, false, kStart).end == Indices{3});
  CHECK(policy.ended(0, false, kStart).end == Indices{1});  // 3 is being ended already
  CHECK(policy.ended(3, false, kStart).end.empty());
  CHECK(policy.take_due(kStart + 1s).empty());
  CHECK(policy.ended(1, false, kStart).end.empty());
  CHECK(policy.take_due(kStart + 1s) == Indices{0, 1, 2, 3});
}

TEST_CASE("A transient process that has finished is not started with the others", "[supervisor][restart]") {
  RestartPolicy policy(nodes(kMixed), supervision(Strategy::one_for_all));
  CHECK_FALSE(policy.ended(1, true, kStart).restarts);
  CHECK(policy.ended(0, false, kStart).end == Indices{3, 2});
  (void)policy.ended(2, true, kStart);
  (void)policy.ended(3, true, kStart);
  CHECK(policy.take_due(kStart) == Indices{0, 3});
}

namespace {

// A supervisor that does what a policy says, with processes that end at random. It has its own book of everything.
class RandomRun {
 public:
  explicit RandomRun(unsigned seed) : random_(seed) {
    const std::size_t count = 1 + below(6);
    for (std::size_t i = 0; i < count; ++i) rules_.push_back(static_cast<Restart>(below(3)));
    supervision_ =
        supervision(static_cast<Strategy>(below(3)), static_cast<int>(below(6)), 1s * (1 + below(20)));
    policy_.emplace(nodes(rules_), supervision_);
    lives_.assign(count, true);
    is_asked_.assign(count, false);
    has_finished_.assign(count, false);
  }

  void turn() {
    now_ += 1ms * below(3000);
    const std::size_t process = below(rules_.size());
    const bool ends_by_itself = below(3) == 0;
    if (lives_[process] && (is_asked_[process] || ends_by_itself)) end(process, below(2) == 0);
    start_due();
    check_that_none_is_lost();
  }

  // Ends what was asked to, and waits for everything that is to come.
  void settle() {
    for (std::size_t i = 0; i < rules_.size(); ++i)
      if (lives_[i] && is_asked_[i]) end(i, true);
    while (policy_->due()) {
      now_ = std::max(now_, *policy_->due());
      start_due();
    }
    for (std::size_t i = 0; i < rules_.size(); ++i) {
      if (gave_up_) CHECK_FALSE(lives_[i]);
      if (!gave_up_ && rules_[i] == kPermanent) CHECK(lives_[i]);
    }
  }

 private:
  std::size_t below(std::size_t limit) { return random_() % limit; }

  void end(std::size_t process, bool is_normal) {
    lives_[process] = false;
    const bool was_asked = is_asked_[process];
    is_asked_[process] = false;
    const RestartDecision decision = policy_->ended(process, is_normal, now_);
    if (was_asked) CHECK_FALSE((decision.restarts || decision.gives_up));
    const bool needs_restart = rules_[process] == kPermanent || (rules_[process] == kTransient && !is_normal);
    if (!was_asked) CHECK((decision.restarts || decision.gives_up) == needs_restart);
    if (!needs_restart && !was_asked) has_finished_[process] = true;
    if (decision.restarts) count_restart();
    if (decision.gives_up) gave_up_ = true;
    for (const std::size_t other : decision.end) {
      CHECK(lives_[other]);
      CHECK_FALSE(is_asked_[other]);
      is_asked_[other] = true;
      if (rules_[other] == kTemporary) has_finished_[other] = true;
    }
  }

  void count_restart() {
    CHECK_FALSE(gave_up_);
    restarts_.push_back(now_);
    const auto recent = std::ranges::count_if(
        restarts_, [&](Moment restart) { return now_ - restart < supervision_.within; });
    CHECK(recent <= supervision_.restarts);
  }

  void start_due() {
    for (const std::size_t process : policy_->take_due(now_)) {
      CHECK_FALSE(lives_[process]);
      CHECK_FALSE(gave_up_);
      CHECK(rules_[process] != kTemporary);
      CHECK_FALSE(has_finished_[process]);
      lives_[process] = true;
    }
  }

  // Each one lives, has finished, or will be started.
  void check_that_none_is_lost() {
    if (gave_up_) return;
    const bool awaits_end = std::ranges::find(is_asked_, true) != is_asked_.end();
    for (std::size_t i = 0; i < rules_.size(); ++i)
      CHECK((lives_[i] || has_finished_[i] || awaits_end || policy_->due()));
  }

  std::mt19937 random_;
  std::vector<Restart> rules_;
  graph::Supervision supervision_;
  std::optional<RestartPolicy> policy_;
  Moment now_ = kStart;
  std::vector<bool> lives_, is_asked_, has_finished_;
  std::vector<Moment> restarts_;
  bool gave_up_ = false;
};

}  // namespace

TEST_CASE("Whatever happens, limits are kept and no process is lost", "[supervisor][restart]") {
  for (unsigned seed = 0; seed < 1000; ++seed) {
    INFO("seed " << seed);
    RandomRun run(seed);
    for (int i = 0; i < 60; ++i) run.turn();
    run.settle();
  }
}

TEST_CASE(
    "A process that somebody wants restarted starts anew whatever its rule, alone, and it counts as no fault",
    "[supervisor][restart]") {
  const auto rule = GENERATE(values({kPermanent, kTransient, kTemporary}));
  RestartPolicy policy(nodes({kPermanent, rule, kPermanent}), supervision(Strategy::one_for_all, 0));
  policy.restart(1, kStart);
  CHECK(policy.take_due(kStart) == Indices{});
  const RestartDecision decision = policy.ended(1, true, kStart);
  CHECK_FALSE(decision.restarts);
  CHECK_FALSE(decision.gives_up);
  CHECK(decision.end == Indices{});
  CHECK_FALSE(policy.has_finished(1));
  CHECK(policy.take_due(kStart) == Indices{1});
}

TEST_CASE("A process that has finished can be restarted", "[supervisor][restart]") {
  RestartPolicy policy(nodes({kTemporary}), supervision(Strategy::one_for_one));
  CHECK_FALSE(policy.ended(0, false, kStart).restarts);
  CHECK(policy.has_finished(0));
  policy.restart(0, kStart);
  CHECK(policy.take_due(kStart) == Indices{0});
}

// ---- Processes on demand: of three, the one in the middle.

namespace {

std::vector<graph::ProcessNode> with_sleeper(Restart rule = kPermanent) {
  std::vector<graph::ProcessNode> processes = nodes({kPermanent, rule, kPermanent});
  processes[1].on_demand = true;
  return processes;
}

bool is_one(std::size_t process) { return process == 1; }

}  // namespace

TEST_CASE("A process on demand starts when it is needed, and not before",
          "[supervisor][restart][on_demand]") {
  RestartPolicy policy(with_sleeper(), supervision(Strategy::one_for_one));
  CHECK(policy.is_asleep(1));
  CHECK(policy.take_due(kStart, [](std::size_t) { return false; }) == Indices{});
  CHECK(policy.take_due(kStart) == Indices{});
  CHECK(policy.take_due(kStart, is_one) == Indices{1});
  CHECK(policy.take_due(kStart, is_one) == Indices{});
  CHECK_FALSE(policy.is_asleep(1));
}

TEST_CASE("The end of a process that nobody needs is no fault", "[supervisor][restart][on_demand]") {
  RestartPolicy policy(with_sleeper(), supervision(Strategy::one_for_all, 0));
  for (int i = 0; i < 10; ++i) {
    CHECK(policy.take_due(kStart, is_one) == Indices{1});
    policy.put_to_sleep(1);
    const RestartDecision decision = policy.ended(1, true, kStart);
    CHECK_FALSE(decision.restarts);
    CHECK_FALSE(decision.gives_up);
    CHECK(decision.end == Indices{});
    CHECK(policy.is_asleep(1));
  }
}

TEST_CASE("A process that goes to sleep holds up no restart of another one",
          "[supervisor][restart][on_demand]") {
  RestartPolicy policy(with_sleeper(), supervision(Strategy::one_for_one));
  CHECK(policy.take_due(kStart, is_one) == Indices{1});
  policy.put_to_sleep(1);
  CHECK(policy.ended(0, false, kStart).restarts);
  CHECK(policy.take_due(kStart) == Indices{0});
}

TEST_CASE("After a fault a process on demand waits to be needed, and for its back-off",
          "[supervisor][restart][on_demand]") {
  RestartPolicy policy(with_sleeper(), supervision(Strategy::one_for_one));
  CHECK(policy.take_due(kStart, is_one) == Indices{1});
  CHECK(policy.ended(1, false, kStart).restarts);
  CHECK(policy.take_due(kStart) == Indices{});
  CHECK_FALSE(policy.due());
  CHECK(policy.take_due(kStart, is_one) == Indices{1});
  CHECK(policy.ended(1, false, kStart).restarts);
  CHECK(policy.take_due(kStart + 49ms, is_one) == Indices{});
  CHECK(policy.take_due(kStart + 50ms, is_one) == Indices{1});
  CHECK(policy.ended(1, false, kStart + 50ms).restarts);
  CHECK(policy.take_due(kStart + 10s, is_one) == Indices{1});
  CHECK(policy.ended(1, false, kStart + 9s).gives_up);
}

TEST_CASE("A temporary process on demand sleeps as often as it likes, but has one fault at most",
          "[supervisor][restart][on_demand]") {
  RestartPolicy policy(with_sleeper(kTemporary), supervision(Strategy::one_for_one));
  for (int i = 0; i < 2; ++i) {
    CHECK(policy.take_due(kStart, is_one) == Indices{1});
    policy.put_to_sleep(1);
    CHECK_FALSE(policy.ended(1, true, kStart).restarts);
  }
  CHECK(policy.take_due(kStart, is_one) == Indices{1});
  CHECK_FALSE(policy.ended(1, false, kStart).restarts);
  CHECK(policy.has_finished(1));
  CHECK(policy.take_due(kStart, is_one) == Indices{});
}

TEST_CASE("A process on demand that is ended with another one comes back when it is needed",
          "[supervisor][restart][on_demand]") {
  RestartPolicy policy(with_sleeper(), supervision(Strategy::one_for_all));
  CHECK(policy.ended(0, false, kStart).end == Indices{2});
  CHECK_FALSE(policy.ended(2, true, kStart).restarts);
  CHECK(policy.take_due(kStart) == Indices{0, 2});
  CHECK(policy.take_due(kStart, is_one) == Indices{1});
  CHECK(policy.ended(0, false, kStart + 20s).end == Indices{2, 1});
  CHECK_FALSE(policy.ended(1, true, kStart + 20s).restarts);
  CHECK_FALSE(policy.ended(2, true, kStart + 20s).restarts);
  CHECK(policy.take_due(kStart + 20s) == Indices{0, 2});
  CHECK(policy.is_asleep(1));
}

TEST_CASE("What an operator restarts on demand still waits to be needed",
          "[supervisor][restart][on_demand]") {
  RestartPolicy policy(with_sleeper(), supervision(Strategy::one_for_one));
  policy.restart(1, kStart);
  CHECK(policy.is_asleep(1));
  CHECK(policy.take_due(kStart, is_one) == Indices{1});
  policy.restart(1, kStart);
  CHECK(policy.take_due(kStart, is_one) == Indices{});  // it must end first
  CHECK_FALSE(policy.ended(1, true, kStart).restarts);
  CHECK(policy.is_asleep(1));
}

TEST_CASE("A process that retires is no fault, stays away, and holds up every start until it has ended",
          "[supervisor][restart]") {
  RestartPolicy policy(with_sleeper(), supervision(Strategy::one_for_all));
  policy.retire(0);
  policy.restart(2, kStart);
  CHECK(policy.ended(2, true, kStart).end == Indices{});
  CHECK(policy.take_due(kStart) == Indices{});
  CHECK_FALSE(policy.ended(0, false, kStart).restarts);
  CHECK(policy.has_finished(0));
  CHECK(policy.take_due(kStart) == Indices{2});
  policy.restart(0, kStart);
  CHECK(policy.take_due(kStart) == Indices{0});
}

TEST_CASE("Processes that another graph has, too, are as they were, whatever their place in it",
          "[supervisor][restart]") {
  std::vector<graph::ProcessNode> before(2);
  before[0].name = "goes";
  before[1].name = "stays";
  RestartPolicy policy(before, supervision(Strategy::one_for_one));
  CHECK(policy.ended(1, false, kStart).restarts);
  CHECK(policy.take_due(kStart) == Indices{1});
  std::vector<graph::ProcessNode> after(2);
  after[0].name = "stays";
  after[0].restart = Restart::temporary;
  after[1].name = "comes";
  policy.go_over(after);
  CHECK_FALSE(policy.has_finished(0));
  CHECK(policy.has_finished(1));
  CHECK(policy.take_due(kStart) == Indices{});
  policy.restart(1, kStart);
  CHECK(policy.take_due(kStart) == Indices{1});
  CHECK_FALSE(policy.ended(0, false, kStart + 1ms).restarts);  // it is temporary now
}
