// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "orca/base/contract.hpp"
#include "orca/base/strand.hpp"
#include "orca/idl/object.hpp"

namespace orca {

/// Sees what happens on the links of a run, for traces and taps.
///
/// Thread contract: called from the strand that sends; implementations synchronise themselves.
class LinkObserver {
 public:
  virtual ~LinkObserver() = default;

  /// An object was put into the queue of `component`.`port`.
  virtual void delivered(std::string_view component, std::string_view port, const ObjectRef& object) = 0;

  /// A client's port was connected to, or disconnected from, a server's port.
  virtual void link_changed(std::string_view client, std::string_view server, bool connected) = 0;
};

/// What the object that a component handles at the moment belongs to; stamped on everything it sends
/// meanwhile.
///
/// The cause is the object taken last. The mission is that of the last object that had one; an object without
/// a mission, as most sensor readings, leaves it. A lap starts with the mission of the component's task: that
/// of the object which a Send handler took last.
///
/// Thread contract: the component's strand.
class Provenance {
 public:
  void begin_lap() { mission_ = task_mission_; }
  /// A handler begins: what is sent meanwhile belongs to the mission of this object, or to none.
  void begin_handling(const idl::OrcaObject& object);
  /// The same for a Send handler, whose object gives the component its task.
  void begin_task(const idl::OrcaObject& object);
  /// The component has nothing more to do.
  void end_task() { task_mission_ = mission_ = 0; }

  void note(const idl::OrcaObject& received);
  void stamp(idl::OrcaObject& sent) const;

  [[nodiscard]] std::uint64_t mission() const { return mission_; }

 private:
  std::uint64_t mission_ = 0;  // 0: none
  std::uint64_t task_mission_ = 0;
  std::string origin_;
  std::uint64_t seq_ = 0;
};

/// What all ports of one component share.
struct PortHome {
  Strand& strand;
  std::string component;
  LinkObserver* observer = nullptr;  ///< May be null.
  Provenance provenance{};           ///< Touched by the component's strand only.
};

/// The part of a port that belongs to the host process and survives a swap of the plugin behind it. The
/// handles that an author sees (PushProxy and friends) only point here.
class Endpoint {
 public:
  Endpoint(PortHome& home, PortContract contract);
  virtual ~Endpoint() = default;
  Endpoint(const Endpoint&) = delete;
  Endpoint& operator=(const Endpoint&) = delete;

  [[nodiscard]] const PortContract& contract() const { return contract_; }
  [[nodiscard]] const std::string& component() const { return home_.component; }
  [[nodiscard]] std::string path() const { return home_.component + "." + contract_.name; }
  [[nodiscard]] PortHome& home() const { return home_; }

  /// Whether there is an observer.
  [[nodiscard]] bool observed() const { return home_.observer != nullptr; }
  /// Tells the observer, if there is one, that an object has come to this port.
  void observe(const ObjectRef& object) const {
    if (home_.observer != nullptr) home_.observer->delivered(home_.component, contract_.name, object);
  }

 protected:
  /// Fills the header of an object that leaves through this port.
  void stamp(ObjectLoan& loan, const Provenance* provenance);

 private:
  PortHome& home_;
  PortContract contract_;
  std::uint64_t next_seq_ = 1;
};

}  // namespace orca
