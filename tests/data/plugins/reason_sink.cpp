// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdio>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/time.hpp"

namespace {

const char* name_of(orca::idl::FusionVerdict verdict) {
  switch (verdict) {
    case orca::idl::FUSED: return "FUSED";
    case orca::idl::NO_WISH: return "NO_WISH";
    case orca::idl::TOLD_TO_STOP: return "TOLD_TO_STOP";
    case orca::idl::REQUIRED_SILENT: return "REQUIRED_SILENT";
  }
  return "?";
}

/// Logs a fuser's reasons, one line per change of mode, verdict, culprit, speed, turn or voices:
/// "t=2.150 vote TOLD_TO_STOP by guard speed 0.00 turn 0.00 voices 2".
class ReasonSink final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto reason = reasons_.get_update_wait();
    char what[160];
    std::snprintf(what, sizeof what, "%s %s by %s speed %.2f turn %.2f voices %zu", reason->mode().c_str(),
                  name_of(reason->verdict()), reason->decided_by().c_str(), reason->command().speed(),
                  reason->command().turn_rate(), reason->voices().size());
    if (what == last_) return orca::again();
    last_ = what;
    char line[200];
    std::snprintf(line, sizeof line, "t=%.3f %s", orca::to_seconds(now()), what);
    log_info(line);
    return orca::again();
  }

  orca::PushProxy<orca::idl::FusionReason> reasons_{*this, "reasons"};
  std::string last_;
};

}  // namespace

ORCA_COMPONENT(ReasonSink, "test.ReasonSink")
