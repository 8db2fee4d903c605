// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"

namespace {

/// Sends goals in one lap without end, however full the receiver is, and gives up when it is refused for good. It
/// reports that as Command does: in the log and as a failed goal.
class Insister final : public orca::Component {
 public:
  explicit Insister(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    log_info("begins");
    for (;;) {
      if (*pause_ > 0.0) sleep(orca::from_seconds(*pause_));
      const orca::Status sent = goal_.send(goal_.loan());
      if (sent.ok() || sent.error().text().find("is full") != std::string::npos) continue;
      log_warning("refused: " + sent.error().text());
      auto failed = failed_.loan();
      failed->name() = "home";
      failed->reason() = "refused";
      failed_.push(std::move(failed));
      return orca::failed(sent.error().text());
    }
  }

  void stop() override {
    const orca::Status sent = goal_.send(goal_.loan());
    log_info(sent.ok() ? "stops" : "stops, though refused");
  }

  orca::SendProxy<orca::idl::GoalPoint> goal_{*this, "goal"};
  orca::PushServer<orca::idl::GoalFailed> failed_{*this, "failed"};
  orca::Param<double> pause_{*this, "pause", 0.0, {.unit = "s", .text = "Between two goals."}};
};

}  // namespace

ORCA_COMPONENT(Insister, "test.Insister")
