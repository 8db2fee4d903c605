// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "orca/base/executive.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/idl/object.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"

namespace orca::host {

/// The objects that come from outside the graph, from an operator: a client of SendServers and QueryServers that has an
/// edge of its own at each port that it was ever used for.
///
/// Thread contract: any thread. It outlives the ports, but for those that it is told to forget.
class OuterOffers {
 public:
  /// Takes the outcome; see HostedPart::offer().
  using Answered = std::function<void(Result<ObjectRef>)>;

  /// @param missions  number of missions begun so far; null: none are counted.
  OuterOffers(const Executive& executive, std::atomic<std::uint64_t>* missions);
  ~OuterOffers();
  OuterOffers(const OuterOffers&) = delete;
  OuterOffers& operator=(const OuterOffers&) = delete;

  /// Hands an object to a port.
  /// @errors  invalid_argument if the port takes no such object.
  Status offer(Endpoint& port, ObjectLoan object, Answered answered);
  /// Forgets the ports of a component that is about to be destroyed.
  void forget(const std::string& component);

 private:
  class Edge;
  template <class Answer>
  class EdgeOf;

  Result<Edge*> edge_at(Endpoint& port) ORCA_REQUIRES(mutex_);
  void stamp(ObjectLoan& object, Pattern pattern) ORCA_REQUIRES(mutex_);

  const Executive& executive_;
  std::atomic<std::uint64_t>* const missions_;
  Mutex mutex_;
  std::map<const Endpoint*, std::unique_ptr<Edge>> edges_ ORCA_GUARDED_BY(mutex_);
  std::uint64_t last_seq_ ORCA_GUARDED_BY(mutex_) = 0;
};

}  // namespace orca::host
