// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/strand.hpp"
#include "orca/idl/object.hpp"
#include "orca/patterns/endpoints/computing.hpp"
#include "orca/patterns/endpoints/link_observer.hpp"
#include "orca/patterns/endpoints/provenance.hpp"

namespace orca {

/// The surroundings that all ports of one component share.
struct PortHome {
  Strand& strand;
  std::string component;
  LinkObserver* observer = nullptr;  ///< May be null.
  Provenance provenance{};           ///< Used on the component's strand only.
  /// Any address in the component's plugin; null: no code is loaded.
  std::atomic<const void*> code{nullptr};
  Computing computing{strand};  ///< The component's laps.
};

/// One end of a link, for as long as it serves a port. Its destructor cuts the link at this end; afterwards
/// nothing of the link touches the port any more.
class LinkEnd {
 public:
  virtual ~LinkEnd() = default;
};

/// The part of a port that belongs to the host process and survives a swap of the plugin behind it. The
/// handles that an author sees (PushProxy and others) only refer to it.
class Endpoint {
 public:
  Endpoint(PortHome& home, PortContract contract);
  virtual ~Endpoint();
  Endpoint(const Endpoint&) = delete;
  Endpoint& operator=(const Endpoint&) = delete;

  [[nodiscard]] const PortContract& contract() const { return contract_; }
  [[nodiscard]] const std::string& component() const { return home_.component; }
  [[nodiscard]] std::string path() const { return home_.component + "." + contract_.name; }
  [[nodiscard]] PortHome& home() const { return home_; }
  /// Returns the instant that is `limit` [s] from now.
  [[nodiscard]] TimePoint deadline_in(Duration limit) const {
    return saturating_add(home_.strand.executive().now(), limit);
  }

  /// Returns whether there is an observer.
  [[nodiscard]] bool observed() const { return home_.observer != nullptr; }
  /// Reports to the observer, if there is one, that an object has arrived at this port.
  void observe(const ObjectRef& object) const {
    if (home_.observer != nullptr) home_.observer->delivered(home_.component, contract_.name, object);
  }

  /// Returns whether the caller may use the port: it runs on a strand, or is the component's destructor. If not,
  /// reports it to the observer.
  /// @thread  any; costs a strand one look at a variable of its thread.
  [[nodiscard]] bool admits_caller() const {
    return home_.strand.executive().runs_here() || admits_stranger();
  }
  /// Returns the error of a call from a thread that runs no component.
  [[nodiscard]] Error foreign_call() const;

  /// Keeps the end of a link that serves this port. The port destroys it before its own members go.
  /// @param peer  "component.port" at the other end, for cut_link(); empty: it stays until then.
  /// @thread  before the component runs, or its strand between two laps.
  void adopt(std::unique_ptr<LinkEnd> end, std::string peer = {}) {
    link_ends_.push_back({std::move(peer), std::move(end)});
  }
  /// Destroys the ends of links to a peer. @thread  as adopt(); any if there are none.
  void cut_link(const std::string& peer) {
    std::erase_if(link_ends_, [&](const Joint& joint) { return joint.peer == peer; });
  }

 protected:
  /// Fills the header of an object that leaves through this port.
  void stamp(ObjectLoan& loan, const Provenance* provenance);

  /// Destroys all link ends of this port. Each final class calls it in its destructor, before its members go.
  void cut_links() { link_ends_.clear(); }

 private:
  struct Joint {
    std::string peer;
    std::unique_ptr<LinkEnd> end;
  };

  [[nodiscard]] bool admits_stranger() const;

  PortHome& home_;
  PortContract contract_;
  std::uint64_t next_seq_ = 1;
  std::vector<Joint> link_ends_;
};

}  // namespace orca
