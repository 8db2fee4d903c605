// SPDX-License-Identifier: GPL-3.0-or-later
#include <cstdint>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/time.hpp"

namespace {

constexpr std::uint64_t kMission = 7;

/// Arrives at "home" in each lap, in a mission of its own.
class Arriver final : public orca::Component {
 public:
  explicit Arriver(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(100)); }

 private:
  orca::Outcome work() override {
    auto arrived = out_.loan();
    arrived->name() = "home";
    arrived->x(++count_);
    arrived->y(-1.0);
    arrived->stamp(orca::to_time_value(now()));
    arrived->mission(kMission);
    out_.push(std::move(arrived));
    return orca::again();
  }

  orca::PushServer<orca::idl::Arrived> out_{*this, "out"};
  double count_ = 0.0;
};

}  // namespace

ORCA_COMPONENT(Arriver, "test.Arriver")
