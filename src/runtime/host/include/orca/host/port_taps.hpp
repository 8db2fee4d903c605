// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/executive.hpp"
#include "orca/base/mutex.hpp"
#include "orca/idl/object.hpp"

namespace orca::host {

/// The moment at which an object is seen at a port: when a PushServer pushes it or a SendProxy sends it, whoever takes it;
/// at any other port, when it arrives.
enum class Flow { pushed, requested, delivered };

/// Returns the moment at which objects are seen at a port.
[[nodiscard]] Flow flow_of(const PortContract& port);

/// What has passed some ports since the last look. Whoever passes an object never waits: one that finds no room is lost,
/// and counted.
///
/// Thread contract: any thread.
class PortTap {
 public:
  /// A port of the tap.
  struct Place {
    std::string component;
    std::string port;
    Flow flow = Flow::delivered;
  };
  /// What may wait for the next look. The default is enough for a person who looks on.
  struct Bounds {
    std::size_t objects = 64;
    std::size_t bytes =
        0;  ///< [bytes] of the objects as XCDR1, of which one at least finds room; 0: no matter.
  };
  /// An object, with the time of the run's clock at which it has passed.
  struct Passed {
    ObjectRef object;
    TimePoint time;
    std::size_t place = 0;  ///< Of its port among the places of the tap.
  };

  /// Returns what waits, the oldest first.
  [[nodiscard]] std::vector<Passed> take();
  /// Returns how many objects were lost at each place from the beginning until now.
  [[nodiscard]] std::vector<std::uint64_t> lost() const;

 private:
  friend class PortTaps;
  PortTap(std::vector<Place> places, const Bounds& bounds);
  [[nodiscard]] bool is_at(Flow flow, std::string_view component, std::string_view port) const;
  static bool counts_bytes(const std::shared_ptr<PortTap>& tap) { return tap->bounds_.bytes > 0; }
  void put(Flow flow, std::string_view component, std::string_view port, const ObjectRef& object,
           std::size_t bytes, TimePoint time);
  [[nodiscard]] bool has_room(std::size_t bytes) const ORCA_REQUIRES(mutex_);

  const std::vector<Place> places_;
  const Bounds bounds_;
  mutable Mutex mutex_;
  std::vector<Passed> waiting_ ORCA_GUARDED_BY(mutex_);
  std::size_t waiting_bytes_ ORCA_GUARDED_BY(mutex_) = 0;
  std::vector<std::uint64_t> lost_ ORCA_GUARDED_BY(mutex_);  // by place
};

/// The taps of a process. While there are none, an object that passes costs a look at one number.
///
/// Thread contract: any thread.
class PortTaps {
 public:
  explicit PortTaps(const Executive& executive) : executive_(executive) {}

  /// Opens a tap. It is closed when nobody holds the pointer any more.
  [[nodiscard]] std::shared_ptr<PortTap> open(std::vector<PortTap::Place> places,
                                              const PortTap::Bounds& bounds = {});

  /// Returns whether there is a tap at a port.
  [[nodiscard]] bool are_at(Flow flow, std::string_view component, std::string_view port) const;

  /// Takes an object that passes a port.
  void pass(Flow flow, std::string_view component, std::string_view port, const ObjectRef& object) {
    if (count_.load(std::memory_order_relaxed) > 0) pass_on(flow, component, port, object);
  }

 private:
  using Taps = std::vector<std::shared_ptr<PortTap>>;

  Taps taps_at(Flow flow, std::string_view component, std::string_view port);
  void pass_on(Flow flow, std::string_view component, std::string_view port, const ObjectRef& object);

  const Executive& executive_;
  std::atomic<std::size_t> count_{0};  // of taps_
  mutable Mutex mutex_;
  std::vector<std::weak_ptr<PortTap>> taps_ ORCA_GUARDED_BY(mutex_);
};

}  // namespace orca::host
