// SPDX-License-Identifier: GPL-3.0-or-later
#include <chrono>
#include <cstdint>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "tally_file.hpp"

namespace {

using SteadyClock = std::chrono::steady_clock;

/// A control loop of 100 Hz that serves whoever connects: it pushes an object in each lap, looks at what it is pushed, and
/// takes what it is sent. Writes the time between the beginnings of its laps into a file [ns].
class Pacer final : public orca::Component {
 public:
  explicit Pacer(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(10)); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Status start() override { return laps_.open_at(*path_); }
  void stop() override { laps_.end(); }

  orca::Outcome work() override {
    const auto now = SteadyClock::now();
    if (last_ != SteadyClock::time_point{}) (void)laps_.add(std::chrono::nanoseconds(now - last_).count());
    last_ = now;
    if (in_.new_data_arrived()) (void)in_.get_update();
    out_.push(out_.loan());
    return orca::again();
  }

  orca::Status on_sent(const orca::ObjectPtr<orca::idl::TurretCommand>& /*sent*/) { return orca::ok(); }

  orca::PushServer<orca::idl::Odometry> out_{*this, "out"};
  orca::PushProxy<orca::idl::MotionCommand> in_{*this, "in"};
  orca::SendServer<orca::idl::TurretCommand> sends_{*this, "sends", &Pacer::on_sent};
  orca::Param<std::string> path_{*this, "path", ""};
  TallyFile laps_;
  SteadyClock::time_point last_;
};

}  // namespace

ORCA_COMPONENT(Pacer, "test.Pacer")
