// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "tally_file.hpp"

namespace {

/// Writes each number that it handles into a file.
class TallyTaker final : public orca::Component {
 public:
  explicit TallyTaker(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::seconds(1)); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Status start() override { return handled_.open_at(*path_); }
  void stop() override { handled_.end(); }

  orca::Status on_number(const orca::ObjectPtr<orca::idl::TurretCommand>& number) {
    return handled_.add(static_cast<std::int64_t>(number->angle()));
  }

  orca::Outcome work() override { return orca::again(); }

  orca::SendServer<orca::idl::TurretCommand> in_{*this, "in", &TallyTaker::on_number};
  orca::Param<std::string> path_{*this, "path", ""};
  TallyFile handled_;
};

}  // namespace

ORCA_COMPONENT(TallyTaker, "test.TallyTaker")
