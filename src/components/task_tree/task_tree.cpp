// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lookout.hpp"
#include "orca/component.hpp"
#include "orca/goals/mission_proxy.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/tasks.hpp"
#include "orca/idl/time.hpp"
#include "settings.hpp"
#include "task.hpp"
#include "task_rules.hpp"
#include "task_run.hpp"

namespace {

using orca::go::MissionProxy;
using orca::tasks::Actor;
using orca::tasks::Condition;
using orca::tasks::Kind;
using orca::tasks::Step;
using orca::tasks::Task;
using orca::tasks::TaskRun;

constexpr const char* kQuestion = "QUESTION";  // kind of the alarm while it asks

// Returns the steps as texts. A kept state fits the task if they are the same as before.
std::vector<std::string> step_texts(const Task& task) {
  std::vector<std::string> texts;
  for (const Step& step : task.steps) texts.push_back(std::to_string(step.depth) + " " + step.text);
  return texts;
}

std::optional<orca::tasks::Ending> ending_of(const std::optional<MissionProxy::Ending>& ending) {
  if (!ending) return std::nullopt;
  return orca::tasks::Ending{
      ending->reached,
      ending->reached ? "" : ending->reason + " (mission " + std::to_string(ending->mission) + ")"};
}

/// A component that does a task (thesis 6.1, 11.5): it drives from place to place, waits, asks and looks, as a task file says, and
/// reacts to what the system says meanwhile. Each drive is a mission. When the task is done the component is done, and when the task
/// fails it has failed.
class TaskTree final : public orca::Component, private Actor {
 public:
  explicit TaskTree(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(100));
  }

 private:
  orca::Status configure() override {
    stay_active(true);
    lookout_.watch(battery_);
    lookout_.watch(gripper_);
    lookout_.watch(localization_);
    if (const orca::Status read = read_file(); !read.ok()) return task_file_.refuse(read.error());
    run_ = std::make_unique<TaskRun>(task_);
    return mission_.configure();
  }

  orca::Status params_changed() override { return mission_.check_behaviours(); }

  // Reports all faults of the file at once.
  orca::Status read_file() {
    orca::xml::Diagnostics diagnostics;
    std::optional<Task> task = orca::tasks::read_task(*task_file_, lookout_.sights(), diagnostics);
    if (task) look_up_places(*task, diagnostics);
    if (task) settings_.check(*task, diagnostics);
    if (task && !diagnostics.has_errors()) {
      task_ = std::move(*task);
      return orca::ok();
    }
    std::string text = diagnostics.text();
    while (text.ends_with('\n')) text.pop_back();
    return orca::fail(orca::Code::invalid_argument, text);
  }

  void look_up_places(Task& task, orca::xml::Diagnostics& diagnostics) {
    for (Step& step : task.steps) {
      if (step.kind != Kind::drive) continue;
      if (const orca::Status found = mission_.look_up(step.trip); !found.ok())
        diagnostics.error(orca::tasks::codes::kPlace, step.position, found.error().message);
    }
  }

  orca::Outcome work() override {
    lookout_.take_all();
    for (const std::string& fault : settings_.go_on()) log_warning(fault);
    alarms_ = kept_alarms();
    if (!paused_ && is_on()) run_->tick(*this, orca::to_seconds(now().time_since_epoch()));
    show();
    if (is_on()) over_since_.reset();
    if (!is_on() && !over_since_) over_since_ = now();
    if (is_on() || (settings_.awaits() && now() - *over_since_ < kSettle)) return orca::again();
    if (run_->state() == TaskRun::State::done) return orca::done();
    return orca::failed(run_->memories()[0].reason);
  }

  [[nodiscard]] bool is_on() const {
    return run_->state() == TaskRun::State::idle || run_->state() == TaskRun::State::running;
  }

  std::optional<Ending> begin(const Step& step) override {
    if (step.kind == Kind::ask) {
      asked_at_ = now();
      answer_.reset();
      raise_alarm(kQuestion, orca::idl::ALARM_NOTICE, step.words + "; answer with: orcactl tasks yes, or no");
      return std::nullopt;
    }
    return ending_of(mission_.begin(step.trip, step.time > 0.0 ? step.time : *goal_timeout_));
  }

  std::optional<Ending> go_on(const Step& step) override {
    if (step.kind == Kind::drive) return ending_of(mission_.wait(orca::Duration{0}));
    const double asked_for = orca::to_seconds(now() - asked_at_);
    if (!answer_ && *yes_after_ > 0.0 && asked_for >= *yes_after_) answer_ = true;
    if (answer_) {
      clear_alarm(kQuestion, *answer_ ? "answered: yes" : "answered: no");
      return *answer_ ? Ending{true, {}} : Ending{false, "answered: no"};
    }
    if (asked_for < step.time) return std::nullopt;
    clear_alarm(kQuestion, "nobody has answered");
    return Ending{false, "no answer: \"" + step.words + "\""};
  }

  void halt(const Step& step) override {
    if (step.kind == Kind::drive) {
      mission_.cancel("the task has something else to do");
    } else {
      clear_alarm(kQuestion, "it is not asked any more");
    }
  }

  orca::tasks::Setter& setter() override { return settings_; }
  void say(const std::string& text) override { log_info(text); }

  [[nodiscard]] bool holds(const Condition& condition) override {
    return orca::tasks::holds(
        condition,
        {[this](const std::string& kind, const std::string& source) { return has_alarm(kind, source); },
         [this](const std::string& port, const std::string& field) { return lookout_.newest(port, field); }});
  }

  [[nodiscard]] bool has_alarm(const std::string& kind, const std::string& source) const {
    return std::ranges::any_of(alarms_, [&](const orca::idl::Alarm& alarm) {
      return alarm.active() && orca::kind_text(alarm) == kind && (source.empty() || alarm.source() == source);
    });
  }

  orca::Result<orca::Loan<orca::idl::TaskState>> on_order(
      const orca::ObjectPtr<orca::idl::TaskOrder>& order) {
    if (const orca::Status obeyed = obey(*order); !obeyed.ok()) return obeyed.error();
    return state_now();
  }

  orca::Status obey(const orca::idl::TaskOrder& order) {
    if (!is_on()) return orca::fail(orca::Code::failed_precondition, "the task has ended");
    switch (order.kind()) {
      case orca::idl::TASK_ORDER_PAUSE: pause(); break;
      case orca::idl::TASK_ORDER_RESUME: return resume_task();
      case orca::idl::TASK_ORDER_SKIP: return skip();
      case orca::idl::TASK_ORDER_END: run_->end(*this, "ended: by \"" + order.origin() + "\""); break;
      case orca::idl::TASK_ORDER_BEGIN: begin_anew(); break;
      case orca::idl::TASK_ORDER_YES: return answer(true);
      case orca::idl::TASK_ORDER_NO: return answer(false);
    }
    return orca::ok();
  }

  void pause() {
    if (!paused_) paused_at_ = now();
    paused_ = true;
    run_->halt(*this);
  }

  // The time of the pause counts for no step.
  orca::Status resume_task() {
    if (!paused_) return orca::fail(orca::Code::failed_precondition, "the task is not paused");
    run_->delay(orca::to_seconds(now() - paused_at_));
    paused_ = false;
    return orca::ok();
  }

  orca::Status skip() {
    const auto skipped = run_->skip(*this);
    if (!skipped) return orca::fail(orca::Code::failed_precondition, "no step is on the way");
    log_info("skipped: " + task_.steps[*skipped].text);
    return orca::ok();
  }

  void begin_anew() {
    run_->halt(*this);
    run_ = std::make_unique<TaskRun>(task_);
    paused_ = false;
  }

  orca::Status answer(bool yes) {
    const auto active = run_->active();
    const bool asks =
        std::ranges::any_of(active, [this](std::size_t step) { return task_.steps[step].kind == Kind::ask; });
    if (!asks || paused_) return orca::fail(orca::Code::failed_precondition, "the task asks nothing now");
    answer_ = yes;
    return orca::ok();
  }

  orca::Result<orca::Loan<orca::idl::TaskState>> on_ask(const orca::ObjectPtr<orca::idl::Ask>& /*ask*/) {
    return state_now();
  }

  [[nodiscard]] orca::Loan<orca::idl::TaskState> state_now() const {
    auto state = orca::make_object<orca::idl::TaskState>();
    fill(*state);
    state->stamp(orca::to_time_value(now()));
    return state;
  }

  // Pushes the task if something of it has changed, or somebody has come who has not seen it.
  void show() {
    const bool is_new = state_.take_new_subscribers();
    if (state_.subscriber_count() == 0) return;
    auto state = state_.loan();
    fill(*state);
    std::string seen = std::to_string(state->phase()) + state->reason();
    for (const auto& step : state->steps()) seen += std::to_string(step.state()) + step.reason();
    if (!is_new && seen == shown_) return;
    shown_ = std::move(seen);
    state->stamp(orca::to_time_value(now()));
    state_.push(std::move(state));
  }

  void fill(orca::idl::TaskState& state) const {
    state.name() = task_.name;
    state.phase(phase());
    state.reason() = run_->last_failure();
    for (std::size_t i = 0; i < task_.steps.size(); ++i) {
      auto& step = state.steps().emplace_back();
      step.text() = task_.steps[i].text;
      step.depth(static_cast<std::uint32_t>(task_.steps[i].depth));
      step.state(static_cast<orca::idl::TaskStepState>(run_->memories()[i].state));
      step.reason() = run_->memories()[i].reason;
    }
  }

  [[nodiscard]] orca::idl::TaskPhase phase() const {
    if (run_->state() == TaskRun::State::done) return orca::idl::TASK_DONE;
    if (run_->state() == TaskRun::State::failed) return orca::idl::TASK_FAILED;
    return paused_ ? orca::idl::TASK_PAUSED : orca::idl::TASK_RUNNING;
  }

  void stop() override { mission_.stop(); }

  void save_state(orca::StateWriter& state) const override {
    state.write(step_texts(task_), run_->memories(), run_->last_failure(), paused_, paused_at_);
  }

  [[nodiscard]] std::uint32_t state_version() const override { return 2; }

  orca::Status load_state(orca::StateReader& state) override {
    std::vector<std::string> texts;
    std::vector<TaskRun::Memory> memories;
    std::string last_failure;
    bool paused = false;
    orca::TimePoint paused_at{};
    if (orca::Status read = state.read(texts, memories, last_failure, paused, paused_at); !read.ok())
      return read;
    if (texts != step_texts(task_) || memories.size() != texts.size()) {
      log_warning("the task is another one than before, so it begins anew");
      return orca::ok();
    }
    for (TaskRun::Memory& memory : memories) settings_.settle(memory);
    run_->go_on_from(std::move(memories), std::move(last_failure));
    paused_ = paused;
    paused_at_ = paused_at;
    return orca::ok();
  }

  orca::QueryServer<orca::idl::TaskOrder, orca::idl::TaskState> orders_{
      *this,
      "TaskOrderQuery",
      &TaskTree::on_order,
      {.text = "Orders of an operator, and answers to questions. The answer is the task as it is then."}};
  orca::PushServer<orca::idl::TaskState> state_{
      *this,
      "TaskStatePush",
      {.text = "The task, whenever something of it changes, and for a new subscriber."}};
  orca::QueryServer<orca::idl::Ask, orca::idl::TaskState> shown_now_{
      *this, "TaskStateQuery", &TaskTree::on_ask, {.text = "The task as it is now."}};
  orca::PushProxy<orca::idl::Battery> battery_{
      *this, "battery", {.text = "For conditions: the battery.", .optional = true}};
  orca::PushProxy<orca::idl::GripperState> gripper_{
      *this, "gripper", {.text = "For conditions: the gripper.", .optional = true}};
  orca::PushProxy<orca::idl::Localization> localization_{
      *this,
      "localization",
      {.text = "For conditions: how well it is known where the robot is.", .optional = true}};
  MissionProxy mission_{*this, host()};
  orca::Param<std::string> task_file_{
      *this, "task", "", {.file = true, .fixed = true, .text = "The task file (README of TaskTree)."}};
  orca::Param<double> goal_timeout_{
      *this,
      "goal_timeout",
      300.0,
      {.unit = "s", .min = 1.0, .text = "Longest time for a Drive that does not say its own."}};
  orca::Param<double> yes_after_{*this,
                                 "yes_after",
                                 0.0,
                                 {.unit = "s",
                                  .min = 0.0,
                                  .text = "Time after which each question counts as answered with yes, for "
                                          "experiments, in which there are no "
                                          "people; 0: people are asked."}};

  Task task_;
  std::unique_ptr<TaskRun> run_;
  orca::tasks::Lookout lookout_;
  static constexpr orca::Duration kSettle =
      std::chrono::seconds(20);  // for what is to be set back at the end

  orca::tasks::Settings settings_{host()};
  std::optional<orca::TimePoint> over_since_;
  std::vector<orca::idl::Alarm> alarms_;  // of this lap
  bool paused_ = false;
  orca::TimePoint paused_at_{};
  orca::TimePoint asked_at_{};
  std::optional<bool> answer_;
  std::string shown_;  // what has been pushed
};

}  // namespace

ORCA_COMPONENT(TaskTree, "orca.TaskTree")
