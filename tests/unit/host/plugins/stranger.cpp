// SPDX-License-Identifier: GPL-3.0-or-later
#include <thread>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"

namespace {

/// In each lap, a thread of the component's own pushes, sends and asks; then the component pushes itself. It
/// is done after ten laps, and fails if the thread's calls are not all refused.
class Stranger final : public orca::Component {
 public:
  explicit Stranger(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(20)); }

 private:
  orca::Outcome work() override {
    int accepted = 0;
    std::thread([&] {
      accepted += out_.push(orca::idl::GoalPoint{}) ? 1 : 0;
      accepted += poke_.send(orca::idl::GoalPoint{}).ok() ? 1 : 0;
      accepted += ask_.query(ask_.loan()).has_value() ? 1 : 0;
    }).join();
    if (accepted > 0) return orca::failed(std::to_string(accepted) + " calls were accepted");
    if (!out_.push(orca::idl::GoalPoint{})) return orca::failed("its own push was refused");
    return ++laps_ == 10 ? orca::done() : orca::again();
  }

  orca::PushServer<orca::idl::GoalPoint> out_{*this, "out"};
  orca::SendProxy<orca::idl::GoalPoint> poke_{*this, "poke"};
  orca::QueryProxy<orca::idl::Ask, orca::idl::GoalPoint> ask_{*this, "ask"};
  int laps_ = 0;
};

}  // namespace

ORCA_COMPONENT(Stranger, "test.Stranger")
ORCA_ALLOW_IN_VIRTUAL_TIME("std::thread::_M_start_thread", "it is what is tested")
ORCA_ALLOW_IN_VIRTUAL_TIME("std::thread::join", "the thread waits for nothing")
