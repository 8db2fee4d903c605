// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <poll.h>

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "applying/applying.hpp"
#include "control/code_watch.hpp"
#include "control/doors.hpp"
#include "control/exchanging.hpp"
#include "control/log_book.hpp"
#include "control/motor_hold.hpp"
#include "control/operating.hpp"
#include "control/peer_desk.hpp"
#include "control/showing.hpp"
#include "control/system_names.hpp"
#include "machines/system_hold.hpp"
#include "members/conductor.hpp"
#include "members/ledger.hpp"
#include "members/member.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/system_facts.hpp"

namespace orca::supervisor {

/// What a desk does to a run, and asks of it.
struct DeskLevers {
  RunLevers run;
  /// Returns the edges in use of those that ports choose from.
  std::function<std::vector<const graph::Edge*>()> edges_in_use;
};

/// The place at which a running system can be watched and commanded, through its socket.
///
/// Thread contract: the supervisor's thread.
class ControlDesk {
 public:
  /// All of these outlive the object.
  /// @param whole  the graph of the whole system.
  /// @param here   what of it runs on this machine.
  ControlDesk(Conductor& conductor, const graph::Graph& whole, const graph::Graph& here,
              const SystemFacts& facts, const Members& members, Ledger& ledger, Starter& starter,
              Renewal& renewal, const DeskLevers& levers, Applying::Levers applying);

  /// Notes which file the graph was read from.
  void note_file(std::string graph_file) { graph_file_ = std::move(graph_file); }
  /// Takes the system's socket. If it could not be made, nobody can reach the system, and the log says so.
  /// @param others  for other users.
  void open(Result<ControlSocket> socket, SharedSocket others = {});
  /// Gives the system's socket up. From now on nobody can reach the system.
  void close() { doors_.close(); }
  /// Adds what it waits for.
  void add_to(std::vector<pollfd>& all) const;
  /// Carries out what clients ask, and passes on what they follow. Never waits.
  void serve(Moment now);

  /// Exchanges the code of components from now on whenever it is built anew, and carries out the graph whenever one of its
  /// files is saved, the main one first.
  void watch(std::vector<std::string> graph_files);

  /// Agrees with other machines on what stops the motors of all.
  /// @param accord  outlives the object.
  /// @param show    answers what is known of the machines.
  void join(MotorsAccord& accord, std::function<void(Reply&)> show) {
    hold_.join(accord);
    showing_.join(std::move(show));
  }
  /// Learns that the system is in a team.
  /// @param show  answers what is known of it.
  void join_team(std::function<void(Reply&)> show) { showing_.join_team(std::move(show)); }
  /// Goes on with what other machines have said. To be called whenever one was heard.
  void hear_machines(Moment now) { hold_.turn(now); }
  /// Stops all motors of the system, and holds them until an operator releases them, those of processes that come up later,
  /// too.
  void hold() { hold_.order(true, nullptr); }
  /// Notes that processes are built, before they open their hardware.
  void built(const std::vector<Member*>& members);
  /// Goes on with what an earlier supervisor has ordered a process.
  void recall(const Standing& standing);
  /// Notes that a component runs other code.
  void note(const ExchangedCode& code) { exchanging_.note(code); }
  /// Carries out what a component orders about another one, and gives it the outcome.
  /// @errors  as PeerDesk::take().
  [[nodiscard]] Status obey(const PeerCalled& call, const std::string& process) {
    return peers_.take(call, process);
  }
  /// Notes what a process was built from.
  void note(const Built& built, const std::string& process) { exchanging_.note(built, process); }
  /// Notes that a process has ended, or is about to be started.
  void lose(const Member& member) { applying_.lose(member.name()); }
  /// Notes that a process has ended and may begin anew: what it moves stands then, until an operator releases it.
  void distrust(const Member& member) { motors_.distrust(member); }
  /// Returns how often somebody was given lines with bounds of their own, as a recorder is.
  [[nodiscard]] std::size_t count_recorders() const { return recorders_; }
  /// Notes that processes work.
  void came_up(const std::vector<Member*>& members);

 private:
  using Handler = void (*)(ControlDesk& desk, const Ask& ask, const ReplyPtr& reply);
  using Handlers = std::map<std::string, Handler, std::less<>>;

  static const Handlers& handlers();
  void handle(const Ask& ask, const ReplyPtr& reply);
  void attempt(const Ask& ask, const ReplyPtr& reply);
  void carry_out(const Ask& ask, const ReplyPtr& reply);
  using Rewiring = void (Applying::*)(const std::vector<std::string>& words, const ReplyPtr& reply);
  void rewire(const Ask& ask, const ReplyPtr& reply, Rewiring rewiring);
  void pause_components(const std::string& name, bool suspends, const ReplyPtr& reply);
  void show_log(const Ask& ask, const ReplyPtr& reply);
  void show_missions(const Ask& ask, Reply& reply) const;
  void look_at_files(Moment now);
  void look_after_socket(Moment now);

  Conductor& conductor_;
  Ledger& ledger_;
  const SystemNames names_;
  Operating operating_;
  PeerDesk peers_;
  Exchanging exchanging_;
  Applying applying_;
  std::optional<CodeWatch> watch_;
  std::string graph_file_;                // the main one
  std::vector<std::string> graph_files_;  // that are watched, the main one first
  Showing showing_;
  MotorHold motors_;
  SystemHold hold_{motors_};
  LogBook log_{[this] { return TimePoint(ledger_.look().time); }};
  Moment socket_seen_{};
  std::size_t recorders_ = 0;
  Doors doors_{[this](const Ask& ask, const ReplyPtr& reply) {
    handle(ask, reply);
  }};  // the last member: its clients are gone first
};

}  // namespace orca::supervisor
