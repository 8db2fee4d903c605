// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <fastdds/rtps/common/Locator.h>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <span>
#include <string>

#include "orca/base/mutex.hpp"
#include "orca/base/result.hpp"
#include "orca/dds/repeats.hpp"
#include "orca/keys/key_ring.hpp"

namespace orca::dds {

/// The gate of a secured participant: each packet that it sends or receives passes it, before anything else looks at it. It lets in
/// only packets of participants whose certificates are in the authority's list, neither revoked nor expired; and none in either
/// direction once the own certificate is that no longer. (Fast DDS 2.9.1 looks at a certificate only when it meets its owner.) What a
/// packet says of its sender is proven by Fast DDS afterwards. Refusals, and packets that are repeated, are in the log, with the sender's address.
///
/// Thread contract: any thread.
class Gate final : public eprosima::fastdds::dds::DomainParticipantListener {
 public:
  /// Reads the keys and proves them.
  /// @errors  as keys::KeyRing::open().
  [[nodiscard]] static Result<std::shared_ptr<Gate>> open(const std::string& keys,
                                                          const std::string& process);

  /// Returns whether a packet may come in.
  /// @param sender  its address, for the log.
  [[nodiscard]] bool lets_in(std::span<const std::uint8_t> packet,
                             const eprosima::fastrtps::rtps::Locator_t& sender);
  /// Returns whether this process may speak.
  [[nodiscard]] bool lets_out() const { return !is_closed_.load(std::memory_order_relaxed); }

  /// Returns the certificate of a participant; nothing if the authority's list has none for it.
  /// @param guid  its GUID, or the beginning of it; at least 6 bytes.
  [[nodiscard]] std::optional<keys::Certificate> certificate_of(std::span<const std::byte> guid) const;

  /// Reads the authority's list again if it has changed, and whether the own certificate has
  /// expired. To be called often; does so once a second.
  /// @param now  the time of the day.
  void look(std::chrono::system_clock::time_point now);

  [[nodiscard]] keys::KeyRing keys() const {
    const MutexLock lock(mutex_);
    return ring_;
  }

 private:
  explicit Gate(keys::KeyRing ring) : ring_(std::move(ring)) {}

  void onParticipantAuthentication(eprosima::fastdds::dds::DomainParticipant* participant,
                                   eprosima::fastrtps::rtps::ParticipantAuthenticationInfo&& info) override;
  [[nodiscard]] std::string fault_of(const keys::Mark& mark) const ORCA_REQUIRES(mutex_);
  void refuse(const std::string& sender, const std::string& why) ORCA_REQUIRES(mutex_);
  void warn_once(const std::string& text) ORCA_REQUIRES(mutex_);
  void read_list() ORCA_REQUIRES(mutex_);
  void watch_end() ORCA_REQUIRES(mutex_);

  mutable Mutex mutex_;
  keys::KeyRing ring_ ORCA_GUARDED_BY(mutex_);
  std::atomic<bool> is_closed_{false};
  std::int64_t now_ ORCA_GUARDED_BY(mutex_) = 0;             // the time of the last look [s since 1970 UTC]
  std::int64_t warned_ ORCA_GUARDED_BY(mutex_) = 0;          // of the end, at that time
  std::set<std::string> warned_of_ ORCA_GUARDED_BY(mutex_);  // what the log has said
  Repeats repeats_ ORCA_GUARDED_BY(mutex_);
};

/// Makes a participant a secured one: its settings get the keys, and each of its transports the gate.
void secure(eprosima::fastdds::dds::DomainParticipantQos& qos, const std::shared_ptr<Gate>& gate);

/// Writes what Fast DDS complains of to the log: refusals for reasons of security as warnings, each once, all else for who searches a
/// fault.
/// @param category  "SECURITY" and what begins so.
/// @thread  any.
void log_complaint(const std::string& category, const std::string& message);

}  // namespace orca::dds
