// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The links that must fulfil the contract of the patterns. A new link is tested by one more kit in LinkKits.
#pragma once

#include <catch2/catch.hpp>

#include <numeric>
#include <tuple>

#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/local/local_link.hpp"
#include "orca/patterns/synchronizer.hpp"
#include "peer.hpp"

namespace orca::test {

/// How to connect two ports of one process.
struct LocalKit {
  /// Whether client and server see the same object, not two equal ones.
  static constexpr bool kSharesObjects = true;

  /// Where this link works.
  static std::vector<ExecutiveOptions> executives() { return all_executives(); }

  explicit LocalKit(Executive& used) : executive(used) {}

  /// @return once objects go from one end to the other.
  void connect(Endpoint& from, Endpoint& to, const QueuePolicy& policy) const {
    must(connect_locally(from, to, policy));
  }
  /// The same with the policy that the author of `to` gave it.
  void connect(Endpoint& from, Endpoint& to) const { must(connect_locally(from, to)); }

  Executive& executive;

 private:
  static void must(const Status& connected) {
    if (!connected.ok()) FAIL("cannot connect: " << connected.error().text());
  }
};

using LinkKits = std::tuple<LocalKit>;

/// Runs `body` with a fresh kit on each executive where the kit works.
template <class Kit>
void on_each_executive(const std::function<void(Kit&)>& body) {
  run_on_each(Kit::executives(), [&](Executive& executive) {
    Kit kit(executive);
    body(kit);
  });
}

using idl::MotionCommand;

/// Motion commands are told apart by their speed.
inline Loan<MotionCommand> numbered(int number) { return head(0.0, number); }
inline int number_of(const ObjectPtr<MotionCommand>& command) {
  return command ? static_cast<int>(command->speed()) : -1;
}

/// Pushes motion commands.
struct Source : Peer {
  explicit Source(Executive& executive, const std::string& name = "source") : Peer(executive, name) {}

  /// Pushes objects `first` to `last`.
  void push_numbers(int first, int last) {
    for (int number = first; number <= last; ++number) out.push(numbered(number));
  }

  PushServer<MotionCommand> out{*this, "out"};
};

/// Receives motion commands.
struct Listener : Peer {
  explicit Listener(Executive& executive, const std::string& name = "listener") : Peer(executive, name) {}

  /// Connects and subscribes.
  template <class Kit>
  PushEdge& listen(Kit& kit, Source& source, const QueuePolicy& policy = {}) {
    kit.connect(source.endpoint("out"), endpoint("in"), policy);
    in.subscribe();
    CHECK(eventually(executive(), [&] { return source.out.subscriber_count() > 0; }));
    return edge();
  }

  [[nodiscard]] PushEdge& edge() const { return *in.endpoint().edges().front(); }

  /// All that waits, oldest first.
  std::vector<int> take_all() {
    std::vector<int> numbers;
    while (in.new_data_arrived()) numbers.push_back(number_of(in.get_update()));
    return numbers;
  }

  /// Waits until the link has brought `count` objects here, dropped ones included.
  [[nodiscard]] bool has_seen(std::uint64_t count) {
    return eventually(executive(), [&] { return edge().counters().delivered >= count; });
  }

  PushProxy<MotionCommand> in{*this, "in"};
};

}  // namespace orca::test
