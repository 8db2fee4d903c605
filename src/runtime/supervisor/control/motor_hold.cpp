// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/motor_hold.hpp"

#include <memory>
#include <utility>

#include "orca/base/log.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

constexpr const char* kLost =
    "its process has ended while it may have driven, and odometry begins anew; see where it stands, then "
    "orcactl estop "
    "--release";
constexpr const char* kReason = "emergency stop; an operator releases it with: orcactl estop --release";

// Refuses to release what nobody holds, when all processes have said so. A base may also be held because its device had failed.
class Refusal {
 public:
  Refusal(ReplyPtr reply, bool holds) : reply_(std::move(reply)), holds_(holds) {}
  ~Refusal() {
    if (holds_) reply_->refuse(fail(Code::failed_precondition, "there is no emergency stop to be released"));
  }
  Refusal(const Refusal&) = delete;
  Refusal& operator=(const Refusal&) = delete;
  void hear(const Status& outcome) {
    if (outcome.ok()) holds_ = false;
    if (!outcome.ok() && outcome.error().code != Code::failed_precondition) reply_->refuse(outcome.error());
  }

 private:
  const ReplyPtr reply_;
  bool holds_;
};

}  // namespace

void MotorHold::ask_all(const ReplyPtr& reply, const std::function<Order()>& make) const {
  for (Member* const member : members_) {
    if (!member->is_built()) continue;
    member->ask(make(), [reply](const Status& outcome) {
      if (!outcome.ok() && reply != nullptr) reply->refuse(outcome.error());
    });
  }
}

void MotorHold::stop(const ReplyPtr& reply) {
  holds_ = true;
  ask_all(reply, [] { return StopMotors{kReason}; });
  ledger_.raise(host::AlarmKind::estop, "", "all motors are held until orcactl estop --release");
}

void MotorHold::release(const ReplyPtr& reply) {
  const bool was_stopped = std::exchange(holds_, false);
  const auto refusal = std::make_shared<Refusal>(reply, !was_stopped);
  for (Member* const member : members_) {
    if (!member->is_built()) continue;
    lost_.erase(member->name());
    member->ask(ReleaseMotors{}, [refusal](const Status& outcome) { refusal->hear(outcome); });
  }
  const std::string text = "the emergency stop is released; motors obey commands again";
  if (ledger_.settle_all(host::AlarmKind::estop, text)) log::warning(kLogName, text);
}

void MotorHold::recall() {
  if (holds_) return;
  holds_ = true;
  ask_all(nullptr, [] { return StopMotors{kReason}; });
  log::warning(kLogName, "the emergency stop holds all motors until orcactl estop --release");
}

void MotorHold::take_in(Member& member) {
  if (holds_) return member.tell(StopMotors{kReason});
  const std::string& process = member.name();
  const bool was_held =
      ledger_.is_active(host::AlarmKind::estop, process);  // under an earlier supervisor, too
  if (!lost_.contains(process) && !was_held) return;
  lost_.insert(process);
  member.ask(StopMotors{kLost, true}, [this, process](const Status& held) {
    if (!held.ok()) lost_.erase(process);
    if (!held.ok() || !lost_.contains(process)) return;  // it moves nothing, or was released meanwhile
    ledger_.raise(
        host::AlarmKind::estop, "",
        "the motors of process " + process +
            " are held, because it has ended while they may have run, and odometry begins anew; see "
            "where the robot stands, then orcactl estop --release",
        process);
  });
}

}  // namespace orca::supervisor
