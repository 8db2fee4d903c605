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

// The answers of all processes to one order. Whoever waits is told when the last one is there, or its process has ended.
class Answers {
 public:
  Answers(MotorHold::Done done, Status otherwise) : done_(std::move(done)), outcome_(std::move(otherwise)) {}
  ~Answers() { done_(outcome_); }
  Answers(const Answers&) = delete;
  Answers& operator=(const Answers&) = delete;
  // A process that held nothing has nothing to release.
  void hear(const Status& answer) {
    const bool has_failed = !outcome_.ok() && outcome_.error().code != Code::failed_precondition;
    const bool says_nothing = !answer.ok() && answer.error().code == Code::failed_precondition;
    if (!has_failed && !says_nothing) outcome_ = answer;
  }

 private:
  const MotorHold::Done done_;
  Status outcome_;
};

}  // namespace

void MotorHold::stop(Done done) {
  holds_ = true;
  const auto answers = std::make_shared<Answers>(std::move(done), ok());
  for (Member* const member : members_)
    if (member->is_built())
      member->ask(StopMotors{kReason}, [answers](const Status& outcome) { answers->hear(outcome); });
  ledger_.raise(idl::ESTOP, "", "all motors are held until orcactl estop --release");
}

// A base may also be held because its device had failed.
void MotorHold::release(Done done) {
  const Status idle = fail(Code::failed_precondition, "there is no emergency stop to be released");
  const bool was_stopped = std::exchange(holds_, false);
  const auto answers = std::make_shared<Answers>(std::move(done), was_stopped ? ok() : idle);
  for (Member* const member : members_) {
    if (!member->is_built()) continue;
    lost_.erase(member->name());
    member->ask(ReleaseMotors{}, [answers](const Status& outcome) { answers->hear(outcome); });
  }
  const std::string text = "the emergency stop is released; motors obey commands again";
  if (ledger_.settle_all(idl::ESTOP, text)) log::warning(kLogName, text);
}

void MotorHold::recall() {
  if (holds_) return;
  holds_ = true;
  for (Member* const member : members_)
    if (member->is_built()) member->tell(StopMotors{kReason});
  log::warning(kLogName, "the emergency stop holds all motors until orcactl estop --release");
}

void MotorHold::take_in(Member& member) {
  if (holds_) return member.tell(StopMotors{kReason});
  const std::string& process = member.name();
  const bool was_held = ledger_.is_active(idl::ESTOP, process);  // under an earlier supervisor, too
  if (!lost_.contains(process) && !was_held) return;
  lost_.insert(process);
  member.ask(StopMotors{kLost, true}, [this, process](const Status& held) {
    if (!held.ok()) lost_.erase(process);
    if (!held.ok() || !lost_.contains(process)) return;  // it moves nothing, or was released meanwhile
    ledger_.raise(
        idl::ESTOP, "",
        "the motors of process " + process +
            " are held, because it has ended while they may have run, and odometry begins anew; see "
            "where the robot stands, then orcactl estop --release",
        process);
  });
}

}  // namespace orca::supervisor
