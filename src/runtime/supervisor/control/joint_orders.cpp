// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/joint_orders.hpp"

#include <utility>

#include "orca/base/text.hpp"

namespace orca::supervisor {

// One joint order while it is carried out.
class JointOrders::Joint : public std::enable_shared_from_this<Joint> {
 public:
  Joint(JointOrders& owner, std::vector<JointStep> steps, Done done)
      : owner_(owner), steps_(std::move(steps)), done_(std::move(done)) {}

  // Goes on as long as no answer is awaited. Returns whether it is at its end.
  bool go_on() {
    while (!awaits_answer_) {
      if (!refusal_ && next_ < steps_.size()) {
        step_forward(next_++);
      } else if (refusal_ && !changes_.empty()) {
        step_back();
      } else {
        return true;
      }
    }
    return false;
  }

  void end() const { done_(refusal_ ? Status(explained()) : ok()); }

 private:
  // A component that has changed, or may still do so.
  struct Change {
    std::size_t step;
    Order back;
    bool is_late = false;  // it did not answer in time
  };
  using Take = void (Joint::*)(const Status&);

  void step_forward(std::size_t step) {
    Result<std::optional<ThereAndBack>> orders = steps_[step].make();
    if (!orders) refusal_ = by_name(orders.error(), step);
    if (!orders || !orders->has_value()) return;
    changes_.push_back({step, std::move((*orders)->back)});
    send(step, std::move((*orders)->go), &Joint::take_change);
  }

  void take_change(const Status& outcome) {
    Change& change = changes_.back();
    if (outcome.ok()) return steps_[change.step].obeyed(true);
    refusal_ = by_name(outcome.error(), change.step);
    change.is_late = steps_[change.step].may_obey_late && outcome.error().code == Code::deadline_exceeded;
    if (!change.is_late) changes_.pop_back();
  }

  void step_back() { send(changes_.back().step, std::move(changes_.back().back), &Joint::take_return); }

  void take_return(const Status& outcome) {
    const Change change = std::move(changes_.back());
    changes_.pop_back();
    if (outcome.ok()) return steps_[change.step].obeyed(false);
    if (change.is_late && outcome.error().code == Code::deadline_exceeded) {
      is_late_ = true;
    } else {
      stuck_.push_back(by_name(outcome.error(), change.step).text());
    }
  }

  void send(std::size_t step, Order order, Take take) {
    awaits_answer_ = true;
    const Status sent = owner_.sender_(steps_[step].component, std::move(order),
                                       [self = weak_from_this(), take](const Status& outcome) {
                                         if (const auto joint = self.lock()) joint->answered(take, outcome);
                                       });
    if (sent.ok()) return;
    awaits_answer_ = false;
    (this->*take)(sent);
  }

  void answered(Take take, const Status& outcome) {
    awaits_answer_ = false;
    (this->*take)(outcome);
    owner_.go_on();
  }

  [[nodiscard]] Error by_name(Error error, std::size_t step) const {
    if (error.where.empty()) error.where = steps_[step].component;
    return error;
  }

  [[nodiscard]] Error explained() const {
    std::string text = refusal_->text();
    if (is_late_) text += "; it obeys once its lap has ended, and goes back at once";
    if (!stuck_.empty()) {
      text += "; not all could go back: " + joined(stuck_, "; ");
    } else if (steps_.size() > 1) {
      text += "; all others are as before the order";
    }
    return fail(refusal_->code, text);
  }

  JointOrders& owner_;
  const std::vector<JointStep> steps_;
  const Done done_;
  std::size_t next_ = 0;
  bool awaits_answer_ = false;
  std::vector<Change> changes_;  // in order; the last one may not be answered yet
  std::optional<Error> refusal_;
  bool is_late_ = false;
  std::vector<std::string> stuck_;  // the reasons, with their components
};

JointOrders::JointOrders(Sender sender) : sender_(std::move(sender)) {}

JointOrders::~JointOrders() = default;

void JointOrders::add(std::vector<JointStep> steps, Done done) {
  waiting_.push_back(std::make_shared<Joint>(*this, std::move(steps), std::move(done)));
  go_on();
}

void JointOrders::go_on() {
  if (std::exchange(is_going_on_, true)) return;
  while (!waiting_.empty() && waiting_.front()->go_on()) {
    const std::shared_ptr<Joint> ended = std::move(waiting_.front());
    waiting_.pop_front();
    ended->end();
  }
  is_going_on_ = false;
}

}  // namespace orca::supervisor
