// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/patterns/dds/ros_topics.hpp"

namespace orca::dds::of_ros {

/// The name of a writer or reader in DDS: 12 bytes of its participant, 4 of its own.
using Gid = std::array<std::byte, 16>;

/// A topic as DDS knows it, and how it is spoken on.
struct RosChannel {
  std::string name;  ///< "/scan"; without a slash in front a name of DDS itself.
  std::string
      message;  ///< "sensor_msgs/msg/LaserScan"; with "::" a name of DDS itself: "orca::idl::TeamObject".
  /// Whether a reader that comes later gets what was written last, and whether this reader wants that.
  bool is_latched = false;
  bool is_reliable = true;  ///< Readers: whether only writers will do that repeat what is lost.
  int depth = 10;           ///< The number of messages that are kept.
  std::string user;         ///< Whom it serves, for people: "laser.LaserRangeReadingsPush".
};

/// A writer of messages.
///
/// Thread contract: write() from one thread; the rest from any.
class RosWriter {
 public:
  virtual ~RosWriter() = default;
  /// @param payload  CDR with its encapsulation.
  virtual void write(std::span<const std::byte> payload) = 0;
  /// Returns how many readers there are.
  [[nodiscard]] virtual int readers() const = 0;
  [[nodiscard]] virtual Gid gid() const = 0;
};

/// A reader of messages. No callback runs after its destructor.
class RosReader {
 public:
  virtual ~RosReader() = default;
  [[nodiscard]] virtual Gid gid() const = 0;
};

/// Where a participant is, and what it says of itself. Nodes of ROS 2 call themselves as here.
struct ParticipantOptions {
  std::uint32_t domain = 0;
  std::string address{};  ///< The network interface's; empty: all of them.
  std::string name = "/";
  std::string user_data = "enclave=/;";
};

/// This process's participant of DDS among those of ROS 2, or of a team. Endpoints that cannot speak to each other because of a policy are
/// reported in the log, with topic and policy.
///
/// Thread contract: any thread.
class RosParticipant {
 public:
  /// Takes a message's payload, with its encapsulation. It must not block.
  /// @thread  one of DDS.
  using Received = std::function<void(std::span<const std::byte> payload)>;

  /// @errors  unavailable if DDS does not start.
  [[nodiscard]] static Result<std::unique_ptr<RosParticipant>> open(const ParticipantOptions& options);

  virtual ~RosParticipant() = default;
  /// @param changed  is called when a reader has come or gone. It must not block.
  /// @errors  unavailable if DDS refuses.
  [[nodiscard]] virtual Result<std::shared_ptr<RosWriter>> make_writer(const RosChannel& channel,
                                                                       std::function<void()> changed) = 0;
  [[nodiscard]] virtual Result<std::unique_ptr<RosReader>> make_reader(const RosChannel& channel,
                                                                       Received received) = 0;
  [[nodiscard]] virtual Gid gid() const = 0;
};

}  // namespace orca::dds::of_ros
