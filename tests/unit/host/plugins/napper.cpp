// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"

namespace {

/// Works in short laps, and in a long one whenever `nap` gets a new value. Pushes the number of each short lap, and logs which
/// numbers it hears and misses, in its sleep, too, and whether its input is connected whenever that has changed. While it
/// runs, it takes no bad mood.
class Napper final : public orca::Component {
 public:
  explicit Napper(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    lap_every(orca::from_seconds(0.01));
    stay_active(true);
    return orca::ok();
  }

  orca::Status params_changed() override {
    return *mood_ == "bad" ? mood_.refuse("spoils its sleep") : orca::ok();
  }

  orca::Outcome work() override {
    if (back_.connected() != was_connected_) log_debug(was_connected_ ? "alone" : "connected");
    was_connected_ = back_.connected();
    auto number = out_.loan();
    number->name() = std::to_string(++laps_);
    out_.push(std::move(number));
    hear();
    if (*nap_ != napped_) nap();
    return orca::again();
  }

  void hear() {
    while (back_.new_data_arrived()) {
      const std::string name(back_.get_update()->name());
      const std::int64_t number = std::stoll(name);
      if (last_heard_ != 0 && number != last_heard_ + 1) log_debug("missed some before " + name);
      last_heard_ = number;
      log_debug("heard " + name);
    }
  }

  void nap() {
    napped_ = *nap_;
    log_debug("naps");
    for (int i = 0; i < 100; ++i) {
      sleep(orca::from_seconds(napped_ / 100));
      hear();
    }
    log_debug("wakes up");
  }

  orca::PushServer<orca::idl::GoalPoint> out_{*this, "out"};
  orca::PushProxy<orca::idl::GoalPoint> back_{*this, "back", {.optional = true}};
  orca::Param<double> nap_{*this, "nap", 0.0, {.unit = "s", .text = "How long the next lap takes."}};
  orca::Param<std::string> mood_{*this, "mood", "good", {.text = "\"bad\" is refused while it runs."}};
  double napped_ = 0.0;
  std::int64_t laps_ = 0;
  std::int64_t last_heard_ = 0;
  bool was_connected_ = false;
};

}  // namespace

ORCA_COMPONENT(Napper, "test.Napper")
