// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give a task or errors. A task runs, whatever comes of its steps, and goes on from what is remembered of it.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "task.hpp"
#include "task_run.hpp"

namespace {

using namespace orca::tasks;

/// Whatever happens follows from numbers that depend on the text only.
class Chance final : public Actor, private Setter {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed | 1U) {}

  std::optional<Ending> begin(const Step& step) override {
    if (on(step)) std::abort();  // there is one robot, and one question at a time
    on(step) = true;
    return ending(step);
  }
  std::optional<Ending> go_on(const Step& step) override {
    if (!on(step)) std::abort();
    return ending(step);
  }
  void halt(const Step& step) override {
    if (!on(step)) std::abort();
    on(step) = false;
  }
  Setter& setter() override { return *this; }
  void say(const std::string& /*text*/) override {}
  bool holds(const Condition& /*condition*/) override { return next() % 4 == 0; }

 private:
  std::uint64_t order(const Step& /*step*/) override { return ++orders_; }
  std::optional<Ending> outcome(std::uint64_t number) override {
    if (number == 0 || number > orders_) std::abort();
    const std::uint64_t chance = next() % 4;
    if (chance < 2) return std::nullopt;
    return chance == 2 ? Ending{true, "0.5 m/s"} : Ending{false, "no right"};
  }
  void set_back(const Step& /*step*/, std::uint64_t number, const std::string& /*before*/) override {
    if (number > orders_) std::abort();
  }

  std::uint64_t next() {
    state_ = state_ * 6364136223846793005U + 1442695040888963407U;
    return state_ >> 33U;
  }
  bool& on(const Step& step) { return step.kind == Kind::drive ? drives_ : asks_; }
  std::optional<Ending> ending(const Step& step) {
    const std::uint64_t chance = next() % 4;
    if (chance < 2) return std::nullopt;
    on(step) = false;
    return chance == 2 ? Ending{true, {}} : Ending{false, next() % 2 == 0 ? "blocked: x" : "lost: y"};
  }

  std::uint64_t state_;
  bool drives_ = false;
  bool asks_ = false;
  std::uint64_t orders_ = 0;
};

void run(const Task& task, std::uint64_t seed) {
  if (task.steps.size() > 200) return;
  Chance actor(seed);
  TaskRun first(task);
  double time = 0.0;
  for (int tick = 0;
       tick < 100 && first.state() != TaskRun::State::done && first.state() != TaskRun::State::failed; ++tick)
    first.tick(actor, time += 0.1);
  if (first.memories().size() != task.steps.size()) std::abort();
  if (first.state() == TaskRun::State::failed && first.memories()[0].reason.empty()) std::abort();
  Chance other(seed);
  TaskRun second(task);
  second.go_on_from(first.memories(), first.last_failure());
  for (int tick = 0; tick < 100 && second.state() == TaskRun::State::running; ++tick)
    second.tick(other, time += 0.1);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::vector<Sight> sights{{"battery", {"charge", "charging"}},
                                         {"localization", {"state", "share"}}};
  orca::xml::Diagnostics diagnostics;
  const auto task =
      read_task_text({reinterpret_cast<const char*>(data), size}, "fuzz.xml", sights, diagnostics);
  if (!task && !diagnostics.has_errors()) std::abort();
  if (!diagnostics.has_errors()) run(*task, size);
  return 0;
}
