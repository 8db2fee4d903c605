// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"

namespace {

/// Pushes an object and sends a number with each lap, and logs what comes back.
class Talker final : public orca::Component {
 public:
  explicit Talker(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    lap_every(orca::from_seconds(*period_));
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    out_.push(out_.loan());
    auto poke = poke_.loan();
    poke->name() = std::to_string(++pokes_);
    if (const orca::Status sent = poke_.send(std::move(poke)); !sent.ok())
      log_debug("not sent: " + sent.error().text());
    while (back_.new_data_arrived()) {
      const auto heard = back_.get_update();
      if (heard->name() == last_heard_) log_debug("heard twice " + last_heard_);
      last_heard_ = heard->name();
      if (*tells_) log_debug("heard " + last_heard_);
    }
    return orca::again();
  }

  // [state]
  void save_state(orca::StateWriter& state) const override { state.write(pokes_, last_heard_); }
  orca::Status load_state(orca::StateReader& state) override { return state.read(pokes_, last_heard_); }
  // [/state]

  orca::PushServer<orca::idl::MotionCommand> out_{*this, "out"};
  orca::SendProxy<orca::idl::GoalPoint> poke_{*this, "poke", {.optional = true}};
  orca::PushProxy<orca::idl::GoalPoint> back_{*this, "back", {.optional = true}};
  orca::Param<double> period_{*this, "period", 0.01, {.unit = "s"}};
  orca::Param<bool> tells_{*this, "tells", true, {.text = "Whether to log what comes back."}};
  std::int64_t pokes_ = 0;
  std::string last_heard_;
};

}  // namespace

ORCA_COMPONENT(Talker, "test.Talker")
