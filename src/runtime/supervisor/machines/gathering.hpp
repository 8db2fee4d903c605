// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/graph/graph.hpp"
#include "orca/idl/machines.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// The machines of a system as one of them knows them: who is there, who is ready, who is lost, and what follows for this
/// machine. It decides on states, not on events: a state that is lost, doubled or late does no harm, since each machine
/// repeats its own.
///
/// * A machine is there once its state came, it runs the same graph, and it has heard this run.
/// * A machine that has been silent for its `loss_limit` is lost; its `on_loss` says whether this run ends.
/// * A machine whose deployer was started again has a new run, with a larger number. A smaller one is believed once the
///   larger one is lost or has ended.
/// * What a run says that has never heard this one is no reason to end: it may be from before. A run that has ended hears
///   no new ones.
///
/// Thread contract: not synchronised. It has no clock.
class Gathering {
 public:
  /// The end of this machine's run because of another machine.
  struct Verdict {
    idl::MachineEnd end = idl::MACHINE_STOPPED;
    std::string why;  ///< For people; names the machine.
  };
  /// Something that people should know.
  struct News {
    enum class Kind {
      info,
      warning,
      lost,  ///< An alarm about a machine.
      back,  ///< The reason for that alarm is gone.
    };
    Kind kind = Kind::info;
    std::string text;
    std::string machine{};  ///< Of the last two kinds.
  };

  /// Another machine, for people.
  struct Standing {
    std::string machine;
    std::optional<idl::MachinePhase> phase;  ///< Nothing: it was never heard.
    bool lost = false;
    Moment heard_at{};
  };

  /// @param graph  with all machines.
  /// @param here   name of this machine in the graph.
  /// @param run    number of this run, larger than those of earlier runs on this machine.
  Gathering(const graph::Graph& graph, std::string here, std::uint64_t run);

  /// Notes how far this machine has come. An earlier phase than the present one changes nothing.
  void enter(idl::MachinePhase phase);
  /// Notes whether the end of the run waits for none of this machine's components.
  void set_done(bool done) { own_.done(done); }
  /// Notes that the run has ended on this machine. A later call changes nothing.
  void end(idl::MachineEnd end, const std::string& why);

  /// Takes the state of another machine. Anything may be in it.
  /// @return whether it is believed: it comes from a machine of this system, and is the latest of that.
  bool hear(const idl::MachineState& state, Moment now);
  /// Notices who has been silent for too long. Call it often, after all that has come was heard.
  void look(Moment now);

  /// Returns what this machine is to say. The caller numbers it.
  [[nodiscard]] idl::MachineState state() const;
  /// Returns the machines that are not there, by name, in the order of the graph.
  [[nodiscard]] std::vector<std::string> missing() const;
  /// Returns the other machines, in the order of the graph.
  [[nodiscard]] std::vector<Standing> standings() const;
  /// Notes that all components of this machine before this one are configured, and returns whether this one may be: all
  /// hardware is open, and what comes before it on other machines is configured. Ask again until it may.
  [[nodiscard]] bool may_configure(const std::string& component);
  /// Notes that all components of this machine are configured, and returns whether those of all others are.
  [[nodiscard]] bool may_begin();
  /// Returns whether the end of the run waits for no component of any machine.
  [[nodiscard]] bool are_all_done() const;
  /// Returns whether no other machine waits for the word that this one has ended.
  [[nodiscard]] bool have_all_ended() const;
  /// Returns why this machine's run is to end; nothing: it goes on.
  [[nodiscard]] const std::optional<Verdict>& verdict() const { return verdict_; }
  /// Returns what has happened since the last call.
  [[nodiscard]] std::vector<News> take_news();

 private:
  struct Peer {
    graph::MachineNode node;
    std::optional<idl::MachineState> said{};  // the latest
    Moment heard_at{};
    bool lost = false;
    std::optional<std::uint64_t> refused{};  // the run that has another graph, which was reported
    bool knows_refusal = false;              // that run has heard of this one
  };

  [[nodiscard]] std::string title(const Peer& peer) const;
  [[nodiscard]] bool has_heard_us(const idl::MachineState& state) const;
  [[nodiscard]] bool is_there(const Peer& peer) const;
  [[nodiscard]] bool is_later(const Peer& peer, const idl::MachineState& state) const;
  [[nodiscard]] bool have_all_reached(idl::MachinePhase phase) const;
  void hear_namesake(const idl::MachineState& state);
  void refuse(Peer& peer, const idl::MachineState& state);
  void tell_arrival(Peer& peer, const idl::MachineState& state);
  void hear_end(Peer& peer);
  void lose(Peer& peer, const std::string& how);
  void decide(idl::MachineEnd end, const std::string& why);
  void tell(News::Kind kind, const std::string& text, const std::string& machine = "") {
    news_.push_back({kind, text, machine});
  }
  [[nodiscard]] bool works() const { return own_.phase() >= idl::MACHINE_WORKING; }

  const std::string here_;
  idl::MachineState own_;
  std::vector<Peer> peers_;  // in the order of the graph
  // Number of components on each machine that come up before a component, and of all.
  std::map<std::string, std::map<std::string, std::uint64_t>> before_;
  std::uint64_t components_ = 0;  // on this machine
  std::uint64_t namesake_ = 0;    // run of another deployer for this machine; 0: none was heard
  std::optional<Verdict> verdict_;
  std::vector<News> news_;
};

}  // namespace orca::supervisor
