// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/joint_orders.hpp"

#include <utility>

#include "orca/base/text.hpp"

namespace orca::supervisor {
namespace {

// The turn of a joint order, after which comes that of the next one.
struct Turn {
  std::uint64_t& ended;
  ~Turn() { ++ended; }
};

}  // namespace

// One joint order while it is carried out.
class JointOrders::Joint {
 public:
  Joint(const Sender& sender, const std::vector<JointStep>& steps) : sender_(sender), steps_(steps) {}

  Status carry_out() {
    for (const JointStep& step : steps_)
      if (Status done = change(step); !done.ok()) return go_back(by_name(done.error(), step));
    return ok();
  }

 private:
  // A component that has changed, or may still do so.
  struct Change {
    const JointStep& step;
    Order back;
    bool is_late = false;  // it did not answer in time
  };

  Status change(const JointStep& step) {
    Result<std::optional<ThereAndBack>> orders = step.make();
    if (!orders) return orders.error();
    if (!orders->has_value()) return ok();
    const Status outcome = sender_(step.component, std::move((*orders)->go));
    const bool is_late =
        step.may_obey_late && !outcome.ok() && outcome.error().code == Code::deadline_exceeded;
    if (outcome.ok() || is_late) changes_.push_back({step, std::move((*orders)->back), is_late});
    if (outcome.ok()) step.obeyed(true);
    return outcome;
  }

  // Returns why the order was not obeyed, and who could not go back.
  Error go_back(const Error& refusal) {
    bool is_late = false;
    std::vector<std::string> stuck;
    for (; !changes_.empty(); changes_.pop_back()) {
      Change& change = changes_.back();
      const Status outcome = sender_(change.step.component, std::move(change.back));
      if (outcome.ok()) {
        change.step.obeyed(false);
      } else if (change.is_late && outcome.error().code == Code::deadline_exceeded) {
        is_late = true;
      } else {
        stuck.push_back(by_name(outcome.error(), change.step).text());
      }
    }
    std::string text = refusal.text();
    if (is_late) text += "; it obeys once its lap has ended, and goes back at once";
    if (!stuck.empty()) {
      text += "; not all could go back: " + joined(stuck, "; ");
    } else if (steps_.size() > 1) {
      text += "; all others are as before the order";
    }
    return fail(refusal.code, text);
  }

  static Error by_name(Error error, const JointStep& step) {
    if (error.where.empty()) error.where = step.component;
    return error;
  }

  const Sender& sender_;
  const std::vector<JointStep>& steps_;
  std::vector<Change> changes_;  // in order
};

Status JointOrders::carry_out(const std::vector<JointStep>& steps) {
  const std::uint64_t turn = begun_++;
  const Turn until_its_end{ended_};
  (void)conductor_.wait([&] { return ended_ == turn; });  // false: all processes have ended, so nobody obeys
  return Joint(sender_, steps).carry_out();
}

}  // namespace orca::supervisor
