// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <thread>

#include "orca/base/descriptor.hpp"
#include "orca/host/hosted_part.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/vocabulary.hpp"
#include "port_lines.hpp"
#include "report_sender.hpp"

namespace orca::supervisor {

/// The thread of a host process that listens to the supervisor: it passes orders on to the part, sends the answers, and
/// beats. If the supervisor is gone, it stops the motors and ends the process.
///
/// Thread contract: one object per process, made and destroyed by the main thread.
class OrderDesk {
 public:
  /// @param heartbeat  word of this process in the run page.
  /// @param shows      whether to report again and again what the part is like.
  OrderDesk(Channel& channel, host::HostedPart& part, ReportSender& reports,
            std::atomic<std::uint32_t>& heartbeat, bool shows);
  ~OrderDesk();
  OrderDesk(const OrderDesk&) = delete;
  OrderDesk& operator=(const OrderDesk&) = delete;

 private:
  void work();
  void wait() const;
  void show_now_and_then(int beats);
  void receive();
  void carry_out(Order order, std::uint64_t request);
  void hear(const TellAlarm& told);
  void pass_on(host::PartOrder order, std::uint64_t request);
  [[nodiscard]] std::optional<Answer> answer_of(Order& order);
  [[noreturn]] void leave(const Error& reason);

  Channel& channel_;
  host::HostedPart& part_;
  ReportSender& reports_;
  std::atomic<std::uint32_t>& heartbeat_;
  const bool shows_;
  PortLines lines_;
  const Descriptor wake_;
  std::atomic<bool> ending_{false};
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace orca::supervisor
