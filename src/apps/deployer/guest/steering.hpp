// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "orca/base/system/pace.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/part_access.hpp"
#include "packet_line.hpp"

namespace orca::guest {

/// A program that lets virtual time pass in steps, and looks at ports and sets parameters between them. When it is gone, time passes
/// no more and the run is asked to stop.
///
/// Thread contract: as RunVisitors. A thread of its own answers the program.
class Steering final : public host::RunVisitors {
 public:
  /// @param ports  all that objects leave their components through.
  Steering(Descriptor socket, std::vector<graph::PortRef> ports);
  ~Steering() override;

  [[nodiscard]] Pace& pace() override { return pace_; }
  void enter(host::PartAccess& run) override;
  void came_up() override { is_up_ = true; }
  void component_changed(const std::string& /*component*/, const host::ComponentReport& /*report*/) override {
  }
  void leave() override;

 private:
  void serve();
  Packet answer(const Packet& order);
  Packet step(const std::string& nanoseconds);
  Packet latest(const std::string& port);
  Packet set(const std::string& component, const std::string& param, const std::string& value);
  // Waits until something holds. @return false if the run is over before.
  template <class Condition>
  bool wait(Condition condition);
  void look();

  Pace pace_{0.0};
  PacketLine line_;
  const std::vector<graph::PortRef> ports_;
  std::atomic<bool> is_up_{false};
  std::atomic<bool> is_over_{false};
  std::mutex mutex_;                 // held while the run is used
  host::PartAccess* run_ = nullptr;  // null: not yet, or over
  std::shared_ptr<host::PortTap> tap_;
  std::map<std::string, ObjectRef> latest_;  // by port
  std::jthread thread_;
};

}  // namespace orca::guest
