// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machines/system_hold.hpp"

#include <string>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

constexpr auto kConfirmLimit = 2s;  // a state that is lost on the network is repeated every 200 ms

idl::MotorsOutcome outcome_of(const Status& obeyed) {
  if (obeyed.ok()) return idl::MOTORS_OBEYED;
  return obeyed.error().code == Code::failed_precondition ? idl::MOTORS_IDLE : idl::MOTORS_REFUSED;
}

// What is said of a machine that has confirmed an order.
std::string confirmation(idl::MotorsOutcome outcome, bool holds) {
  if (outcome == idl::MOTORS_IDLE) return "nothing was held";
  return holds ? "held" : "released";
}

std::string machines(const std::vector<std::string>& names) {
  return (names.size() == 1 ? "machine " : "machines ") + listed(names);
}

// Returns the error that names the machines on which an order may not have been obeyed.
Error not_confirmed(const std::vector<std::string>& missing, const std::vector<std::string>& confirmed,
                    bool holds) {
  const std::string text =
      machines(missing) + (missing.size() == 1 ? " has" : " have") + " not confirmed the " +
      (holds ? "emergency stop: what it moves may go on" : "release: what it moves may still be held");
  return fail(Code::deadline_exceeded,
              text + "; confirmed by " + (confirmed.empty() ? "none" : machines(confirmed)));
}

}  // namespace

void SystemHold::order(bool holds, const ReplyPtr& reply) {
  if (accord_ == nullptr) {
    const auto answer = [reply](const Status& obeyed) {
      if (!obeyed.ok() && reply != nullptr) reply->refuse(obeyed.error());
    };
    return holds ? motors_.stop(answer) : motors_.release(answer);
  }
  const std::uint64_t number = accord_->order(holds);
  if (reply != nullptr) waiting_.push_back({number, Moment::clock::now() + kConfirmLimit, reply});
  carry_out();
}

void SystemHold::recall() {
  if (accord_ == nullptr) return motors_.recall();
  if (!motors_.holds()) order(true, nullptr);
}

void SystemHold::carry_out() {
  const std::optional<MotorsAccord::Order> order = accord_->take_order();
  if (!order) return;
  const auto note = [this, number = order->number](const Status& obeyed) {
    if (!obeyed.ok() && outcome_of(obeyed) == idl::MOTORS_REFUSED)
      log::error(kLogName, "the order to all motors was refused: " + obeyed.error().text());
    accord_->note(number, outcome_of(obeyed));
  };
  order->holds ? motors_.stop(note) : motors_.release(note);
}

void SystemHold::turn(Moment now) {
  if (accord_ == nullptr) return;
  carry_out();
  std::erase_if(waiting_, [&](const Waiting& waiting) { return is_answered(waiting, now); });
}

// Answers if there is an answer. The reply ends with the last pointer to it.
bool SystemHold::is_answered(const Waiting& waiting, Moment now) const {
  const MotorsAccord::Order& latest = accord_->latest();
  if (latest.number != waiting.order) {
    waiting.reply->refuse(fail(
        Code::failed_precondition,
        std::string("another order came after it: all motors are ") + (latest.holds ? "held" : "released")));
    return true;
  }
  std::vector<std::string> missing;
  std::vector<std::string> confirmed;
  bool is_pending = false;
  bool is_idle = true;
  const std::vector<MotorsAccord::Word> words = accord_->words();
  for (const MotorsAccord::Word& word : words) {
    const bool has_obeyed = word.outcome == idl::MOTORS_OBEYED || word.outcome == idl::MOTORS_IDLE;
    (has_obeyed ? confirmed : missing).push_back(word.machine);
    is_pending = is_pending || word.outcome == idl::MOTORS_PENDING;
    is_idle = is_idle && word.outcome == idl::MOTORS_IDLE;
  }
  if (is_pending && now < waiting.until) return false;
  if (!missing.empty()) return waiting.reply->refuse(not_confirmed(missing, confirmed, latest.holds)), true;
  if (is_idle)
    return waiting.reply->refuse(
               fail(Code::failed_precondition, "there is no emergency stop to be released")),
           true;
  for (const MotorsAccord::Word& word : words)
    waiting.reply->add(
        Record{{"machine", word.machine}, {"motors", confirmation(word.outcome, latest.holds)}});
  return true;
}

}  // namespace orca::supervisor
