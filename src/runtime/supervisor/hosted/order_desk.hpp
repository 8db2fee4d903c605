// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "orca/base/descriptor.hpp"
#include "orca/host/part_access.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/vocabulary.hpp"
#include "port_lines.hpp"
#include "report_sender.hpp"
#include "vigil.hpp"

namespace orca::supervisor {

/// Notes the pool of the process at the other end of an edge, where it came with the edge's memory.
void note_pool(EdgeMemory& edge);

/// The thread of a host process that listens to the supervisor: it passes orders on to the part, sends the answers, and
/// beats. If the supervisor is gone, it stops the motors and ends the process; if the supervisor has said Outlive before, it
/// lets the part go on, and waits for another supervisor.
///
/// Thread contract: one object per process, made and destroyed by the main thread.
class OrderDesk {
 public:
  /// What the desk must know of its process.
  struct Site {
    std::string system;                     ///< Name of the graph.
    std::string process;                    ///< Its name there.
    std::atomic<std::uint32_t>& heartbeat;  ///< Its word in the run page.
    bool shows = false;                     ///< Whether to report again and again what the part is like.
    /// Makes what the process says of itself if it has no supervisor, but for the output.
    std::function<Orphaned()> introduce;
    /// Learns of a component that is new, in whatever process it is.
    std::function<void(const AddComponent&)> learn;
    /// Learns of a process that begins, or begins anew.
    std::function<void(const NoteProcess&)> learn_process;
  };

  OrderDesk(std::shared_ptr<Channel> channel, host::PartAccess& part, ReportSender& reports, Site site);
  ~OrderDesk();
  OrderDesk(const OrderDesk&) = delete;
  OrderDesk& operator=(const OrderDesk&) = delete;

 private:
  void work();
  void wait() const;
  void show_now_and_then(int beats);
  void hear_supervisor();
  void turn_away_all();
  void keep_vigil();
  void lose_supervisor(const Error& reason);
  void look_after_place();
  void carry_out(Told told);
  void adopt(const Told& told);
  Status prepare_to_outlive(Outlive& order);
  void tell_log_wish();
  static void hear(const TellLines& told);
  void hear(const TellAlarm& told);
  [[nodiscard]] static std::function<void(Recollection&)> memorable(const Order& order);
  void pass_on(host::PartOrder order, const Told& told);
  void pass_on(SwapCode& swap, const Told& told);
  [[nodiscard]] std::optional<Answer> answer_of(Order& order);
  [[nodiscard]] Orphaned introduction() const;
  [[noreturn]] void leave(const Error& reason);

  std::shared_ptr<Channel> channel_;  // null: there is no supervisor
  host::PartAccess& part_;
  ReportSender& reports_;
  const Site site_;
  bool wants_lines_ = false;  // as the supervisor knows it
  PortLines lines_;
  std::optional<Outlive> will_;         // what to do without a supervisor; none: to end
  std::optional<ControlSocket> place_;  // while there is a will
  Moment place_seen_{};
  std::optional<Vigil> vigil_;  // while there is no supervisor
  Moment vigil_ends_at_{};
  std::optional<std::uint64_t> graph_mark_;  // of the run's present graph; none: it is that of the start
  bool is_taken_down_ = false;
  std::map<std::string, std::uint64_t> swaps_;  // by component; used where swaps end only
  const Descriptor wake_;
  std::atomic<bool> ending_{false};
  std::thread thread_;  // the last member: it uses the others
};

}  // namespace orca::supervisor
