// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/world.hpp"

namespace {

/// Puts an obstacle into the simulated world at a time of the run, and logs what comes of it.
class Meddler final : public orca::Component {
 public:
  using Component::Component;

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    sleep(orca::from_seconds(*at_));
    auto change = world_.loan();
    change->kind(orca::idl::PUT_OBSTACLE);
    change->name() = "crate";
    change->x(*x_);
    change->y(*y_);
    change->length(*diameter_);
    const orca::Status put = world_.send_wait(std::move(change));
    log_info(put.ok() ? "the crate is there" : "refused: " + put.error().message);
    return orca::done();
  }

  orca::SendProxy<orca::idl::WorldChange> world_{*this, "world"};
  orca::Param<double> at_{*this, "at", 2.0, {.unit = "s", .text = "When it comes."}};
  orca::Param<double> x_{*this, "x", 5.0, {.unit = "m", .text = "Where it comes."}};
  orca::Param<double> y_{*this, "y", 3.0, {.unit = "m", .text = "Where it comes."}};
  orca::Param<double> diameter_{*this, "diameter", 0.6, {.unit = "m", .text = "Of the crate."}};
};

}  // namespace

ORCA_COMPONENT(Meddler, "test.Meddler")
