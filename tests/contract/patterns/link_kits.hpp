// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The links that must fulfil the contract of the patterns. A new link is tested by one more kit in LinkKits.
#pragma once

#include <catch2/catch.hpp>

#include <memory>
#include <mutex>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "dds_links.hpp"
#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "orca/patterns/synchronizer.hpp"
#include "peer.hpp"
#include "shm_links.hpp"

namespace orca::test {

/// The means to connect two ports of one process by some kind of Links.
template <class Kind>
class Kit {
 public:
  /// Connects a port to another.
  /// @return once objects go from one end to the other.
  void connect(Endpoint& from, Endpoint& to, const QueuePolicy& policy) {
    must(links_.connect(from, to, policy));
  }
  /// Does the same with the policy that the author of `to` gave it.
  void connect(Endpoint& from, Endpoint& to) { must(links_.connect(from, to)); }

  Executive& executive;

  /// Virtual time [s] for which everything is under way.
  static constexpr Duration kDelay{0};

 protected:
  template <class... Arguments>
  explicit Kit(Executive& used, Arguments&... arguments) : executive(used), links_(arguments...) {}

 private:
  static void must(const Status& connected) {
    if (!connected.ok()) FAIL("cannot connect: " << connected.error().text());
  }

  Kind links_;
};

/// The links within a process.
struct LocalKit : Kit<LocalLinks> {
  /// Returns whether client and server see the same object, not two equal ones.
  static constexpr bool kSharesObjects = true;

  /// Returns the executives on which this link works.
  static std::vector<ExecutiveOptions> executives() { return all_executives(); }

  explicit LocalKit(Executive& used) : Kit(used) {}
};

/// The links within a process on which objects are under way for some virtual time.
struct DelayedKit : Kit<LocalLinks> {
  static constexpr bool kSharesObjects = true;

  static std::vector<ExecutiveOptions> executives() { return virtual_executives(); }

  explicit DelayedKit(Executive& used) : DelayedKit(used, std::make_unique<Courier>(used)) {}

  static constexpr Duration kDelay = 3ms;

 private:
  DelayedKit(Executive& used, std::unique_ptr<Courier> courier)
      : Kit(used, *courier, kDelay), courier_(std::move(courier)) {}

  std::unique_ptr<Courier> courier_;
};

/// The links through shared memory, with both ends in this process.
struct ShmKit : Kit<ShmLinks> {
  static constexpr bool kSharesObjects = false;

  // Virtual time does not wait for other processes. An executive that runs one task at a time has one doorbell.
  static std::vector<ExecutiveOptions> executives() {
    static DoorbellWord bell{0};
    std::vector<ExecutiveOptions> kinds = steady_executives();
    for (ExecutiveOptions& kind : kinds)
      if (kind.backend != Backend::thread) kind.doorbell = &bell;
    return kinds;
  }

  explicit ShmKit(Executive& used) : Kit(used, used) {}
};

/// The links through DDS, with both ends in this process.
struct DdsKit : Kit<DdsLinks> {
  static constexpr bool kSharesObjects = false;

  // Virtual time does not wait for the network.
  static std::vector<ExecutiveOptions> executives() { return steady_executives(); }

  explicit DdsKit(Executive& used) : Kit(used, used) {}
};

using LinkKits = std::tuple<LocalKit, DelayedKit, ShmKit, DdsKit>;

/// Runs `body` with a fresh kit on each executive where the kit works.
template <class Kit>
void on_each_executive(const std::function<void(Kit&)>& body) {
  run_on_each(Kit::executives(), [&](Executive& executive) {
    Kit kit(executive);
    body(kit);
  });
}

/// A test case of the contract. It runs with each kind of link, on each executive where that works; its body has the `kit`,
/// which is a `TestType&`.
#define CONTRACT_CASE(title, tags) CONTRACT_CASE_OF(LinkKits, title, tags)
#define CONTRACT_CASE_OF(kits, title, tags) \
  CONTRACT_CASE_AS(INTERNAL_CATCH_UNIQUE_NAME(contract_case_), kits, title, tags)
#define CONTRACT_CASE_AS(function, kits, title, tags)                  \
  template <class TestType>                                            \
  static void function(TestType& kit);                                 \
  TEMPLATE_LIST_TEST_CASE(title, tags, kits) {                         \
    on_each_executive<TestType>([](TestType& kit) { function(kit); }); \
  }                                                                    \
  template <class TestType>                                            \
  static void function(TestType& kit)

using idl::MotionCommand;

/// Motion commands are distinguished by their speed.
inline Loan<MotionCommand> numbered(int number) { return head(0.0, number); }
inline int number_of(const ObjectPtr<MotionCommand>& command) {
  return command ? static_cast<int>(command->speed()) : -1;
}

/// The troubles that ends of links report: "from to to: text".
class Troubles final : public LinkObserver {
 public:
  void delivered(std::string_view, std::string_view, const ObjectRef&) override {}
  void link_changed(std::string_view, std::string_view, bool) override {}
  void trouble(LinkTrouble kind, std::string_view from, std::string_view to, std::string_view text) override {
    const std::lock_guard lock(mutex_);
    lines_.push_back(std::string(from) + " to " + std::string(to) + ": " + std::string(text));
    kinds_.insert(kind);
  }

  [[nodiscard]] std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }
  [[nodiscard]] std::set<LinkTrouble> kinds() const {
    const std::lock_guard lock(mutex_);
    return kinds_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
  std::set<LinkTrouble> kinds_;
};

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
    const std::size_t before = source.out.subscriber_count();
    kit.connect(source.endpoint("out"), endpoint("in"), policy);
    in.subscribe();
    CHECK(eventually(executive(), [&] { return source.out.subscriber_count() == before + 1; }));
    return edge();
  }

  [[nodiscard]] PushEdge& edge() const { return *edges("in").front(); }

  /// Takes all waiting objects, oldest first.
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
