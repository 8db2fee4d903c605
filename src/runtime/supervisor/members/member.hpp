// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/live_line.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/graph/process.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/host_process.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// One process of the graph, as the supervisor sees it: the host process that runs it at present, if any, and the orders
/// that it has not answered yet.
///
/// Thread contract: the supervisor's thread.
class Member {
 public:
  enum class Phase {
    absent,      ///< It does not run.
    asleep,      ///< It does not run, because nobody needs it: it is started on demand.
    coming_up,   ///< It loads, constructs, configures.
    up,          ///< Its components work.
    going_down,  ///< It has been told to end.
  };
  /// Takes the answer to an order.
  using Answered = std::function<void(const Status&)>;
  /// Takes all of it. If the process ends before it has answered, the function is destroyed without a call.
  using AnswerTaker = std::function<void(const Answer&)>;

  /// @param index  its place in the order of graph::processes_on().
  /// @param place  its place in the run page.
  Member(graph::ProcessNode node, std::size_t index, std::size_t place, bool is_newcomer = false)
      : node_(std::move(node)), index_(index), place_(place), starts_{.is_newcomer = is_newcomer} {}

  /// Goes on with what another graph says of the process. What runs already keeps what it was started with.
  void go_over(graph::ProcessNode node, std::size_t index);

  /// Starts a host process.
  /// @errors  as HostProcess::start().
  Status start(const HostStart& start);

  /// Takes over a host process that works already.
  void adopt(std::unique_ptr<HostProcess> process);

  /// Sends an order. `answered` is called when the answer is there, unless the process ends before.
  void ask(Order order, Answered answered);
  /// Does the same for an order that asks for more than an outcome.
  void ask_for(Order order, AnswerTaker taker);
  /// Sends an order that nobody waits for.
  void tell(Order order);
  /// Orders the process to end, and sees to it that it does.
  /// @param keeps_states  whether it tells the states of its components before.
  void end(Moment now, const EndLimits& limits, Answered answered, bool keeps_states = false);
  /// Takes the answer to an order.
  void take_answer(std::uint64_t request, const Answer& answer);

  /// Notes a line that the process has printed. A line of host::LastWords tells why it ends.
  void heard(const std::string& line, Moment now);
  /// Notes that the process has said why it ends.
  void heard_last_words(const std::string& words, Moment now);
  /// Returns why the process has ended by its own words, which it said just before; empty: it said nothing.
  [[nodiscard]] std::string last_words(Moment now) const;

  /// Notes whether the process asks the user something. Meanwhile what it writes without an end of the line is on the
  /// terminal, and the line of progress is not.
  void prompt(bool begins);
  /// Writes to stderr what the process asks the user.
  void pass_on_question();

  /// Notes that nothing can be received from the process any more.
  void lose_channel(Moment now);
  [[nodiscard]] bool is_deaf() const { return deaf_since_.has_value(); }
  /// Ends a process that uses more memory than the graph allows, or that lives on without its channel, and sends the
  /// signals that are due.
  void look(Moment now);

  /// Forgets the process, which has ended.
  void forget();

  [[nodiscard]] const graph::ProcessNode& node() const { return node_; }
  [[nodiscard]] const std::string& name() const { return node_.name; }
  /// Returns its place in the order of graph::processes_on().
  [[nodiscard]] std::size_t index() const { return index_; }
  /// Returns its place in the run page.
  [[nodiscard]] std::size_t place() const { return place_; }
  [[nodiscard]] HostProcess* process() const { return process_.get(); }
  [[nodiscard]] Phase phase() const { return phase_; }
  void enter(Phase phase);
  /// Returns whether the present process has come up, which stays so when it goes down.
  [[nodiscard]] bool has_come_up() const { return has_come_up_; }
  /// Returns whether its instances are built, so that it takes orders about them.
  [[nodiscard]] bool is_built() const { return is_built_; }
  void note_built() { is_built_ = true; }
  /// Its starts by this supervisor.
  struct Starts {
    bool is_newcomer = false;        ///< It is none of the processes with which the run has begun.
    std::uint64_t count = 0;         ///< An adoption counts as one.
    Moment last{};                   ///< When it was started last.
    std::optional<Duration> time{};  ///< That it took to come up last; nothing: it has not come up yet.
  };
  [[nodiscard]] const Starts& starts() const { return starts_; }
  /// Returns how often it was started again.
  [[nodiscard]] std::uint64_t restarts() const { return starts_.count > 0 ? starts_.count - 1 : 0; }

 private:
  graph::ProcessNode node_;
  std::size_t index_;
  const std::size_t place_;
  Phase phase_ = Phase::absent;
  bool has_come_up_ = false;
  bool is_built_ = false;
  Starts starts_;
  std::unique_ptr<HostProcess> process_;
  std::map<std::uint64_t, AnswerTaker> open_;
  std::uint64_t last_request_ = 0;
  std::string words_;  // the last that sounded like last words
  Moment words_at_{};
  std::optional<Moment> deaf_since_;
  std::optional<LiveLine::Pause> prompts_;  // while it asks the user
};

using Members = std::vector<Member*>;

}  // namespace orca::supervisor
