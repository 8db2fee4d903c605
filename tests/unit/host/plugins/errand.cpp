// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"

namespace {

/// Begins a mission, sends a list of behaviours in it, gives it up, and is done after two missions.
class Errand final : public orca::Component {
 public:
  explicit Errand(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::seconds(1)); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    begin_mission();
    log_warning("on the way");
    if (list_.connected()) {
      auto list = list_.loan();
      list->clients() = *behaviours_;
      if (const orca::Status sent = list_.send(std::move(list)); !sent.ok())
        return orca::failed(sent.error().text());
      sleep(std::chrono::milliseconds(500));
    }
    auto failed = failed_.loan();
    failed->name() = "home";
    failed->reason() = "lost";
    failed_.push(std::move(failed));
    if (*throws_) throw 1;
    end_mission();
    log_warning("at rest");
    return ++count_ < 2 ? orca::again() : orca::done();
  }

  orca::SendProxy<orca::idl::ClientList> list_{*this, "list", {.optional = true}};
  orca::PushServer<orca::idl::GoalFailed> failed_{*this, "failed"};
  orca::Param<std::vector<std::string>> behaviours_{*this, "behaviours", {}};
  orca::Param<bool> throws_{*this, "throws", false};
  int count_ = 0;
};

}  // namespace

ORCA_COMPONENT(Errand, "test.Errand")
