// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/supervised_run.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "alarm_relay.hpp"
#include "conclusion.hpp"
#include "control/control_desk.hpp"
#include "ledger.hpp"
#include "listening.hpp"
#include "log_relay.hpp"
#include "machines/neighbours.hpp"
#include "member.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/plan.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/idleness.hpp"
#include "orca/supervisor/heartbeats.hpp"
#include "orca/supervisor/meeting_place.hpp"
#include "orca/supervisor/restart_policy.hpp"
#include "poller.hpp"
#include "starting/adoption.hpp"
#include "starting/arrivals.hpp"
#include "starting/on_demand.hpp"
#include "starting/run_identity.hpp"
#include "starting/starter.hpp"
#include "taking_down.hpp"
#include "trading.hpp"

namespace orca::supervisor {
namespace {

using host::RunOutcome;
using Phase = Member::Phase;

constexpr Duration kStartLimit = 15s;
constexpr Duration kRestLimit = 1s;
constexpr Duration kLook = 50ms;  // between two looks at everything
constexpr int kMostReads = 32;    // of what a process has printed, after its end

// Returns whether the end of the run waits for a component of the process.
bool runs_an_end(const graph::Graph& graph, const Member& member) {
  return std::ranges::any_of(graph.ends, [&](const std::string& name) {
    return graph.find_component(name)->process == member.name();
  });
}

// One run, from the first process to the last.
class SupervisedRun {
 public:
  SupervisedRun(const graph::Graph& graph, const SupervisedOptions& options, Beginning beginning,
                host::StopSignal& stop, host::RunListener& listener)
      : graph_(graph),
        here_(graph::part_on(graph, options.machine)),
        facts_(options.facts),
        options_(options),
        stop_(stop),
        listener_(listener),
        run_(std::move(beginning.run)),
        inherited_(std::move(beginning.processes)),
        members_(make_members(graph, options.machine)),
        all_(pointers_to(members_)),
        starter_(graph_, options, run_, all_),
        ledger_(here_, listener, run_.start, options.log_name),
        policy_(graph::processes_on(graph, options.machine), graph.supervision),
        control_(here_, facts_, all_, ledger_, levers(), applying()) {
    ledger_.relay_to(relay_);
    if (options.watches) control_.watch(options.graph_files);
    if (graph.machines.size() < 2) return;
    neighbours_.emplace(graph, options.machine, starter_.plain_start("peers"), ledger_);
    polled_.push_back(&neighbours_->member());
    conclusion_.on_end(
        [this](RunOutcome outcome, const std::string& why) { neighbours_->conclude(outcome, why, now()); });
  }

  host::RunResult execute(Result<ControlSocket> socket) {
    stop_.on_request([this] { poller_.wake(); });
    if (options_.outputs.looks_on) listener_.built(ledger_);
    control_.open(std::move(socket));
    const Members missing = inherited_.empty() ? on_demand_.put_others_to_sleep() : take_over();
    gather();
    if (!conclusion_.is_over() && !missing.empty()) arrivals_.start(missing);
    while (!is_over()) turn(next_time());
    if (conclusion_.has_closing_phase()) wait_for_rest();
    const bool was_well = !conclusion_.has_failed();
    if (conclusion_.has_come_up()) conclusion_.judge();
    take_down();
    if (was_well) report_idleness();
    if (const auto& lost = ledger_.output_error()) conclusion_.fail_late(*lost);
    stop_.on_request(nullptr);
    host::RunResult result = this->result();
    listener_.ended(result);
    return result;
  }

 private:
  // ---- Operators

  RunLevers levers() {
    const auto stop = [this] {
      if (!conclusion_.is_over()) conclusion_.stop("");
    };
    const auto restart = [this](Member& member) -> Status {
      if (conclusion_.is_over() || !conclusion_.has_come_up())
        return fail(Code::failed_precondition, "the system is just coming up or ending");
      policy_.restart(member.index(), now());
      on_demand_.want(member);
      end_for_restart(member);
      return ok();
    };
    return {stop, restart, [this] { return trading_.in_use(); }, [this] { poller_.wake(); }};
  }

  Applying::Levers applying() {
    return {options_.read, [this](const CheckedSystem& wanted) { return accept(wanted); },
            [this](const std::set<std::string>& edges) { return starter_.renew_edges(edges); },
            [this](const graph::ComponentNode& node) {
              ledger_.expect(node.name);
              return starter_.introduce(node);
            },
            [this] { poller_.wake(); }};
  }

  // Goes on with a graph that is carried out already. Processes that are started from now on run it.
  void accept(const CheckedSystem& wanted) {
    graph::go_over(graph_, wanted.graph);
    graph::go_over(here_, wanted.graph);
    starter_.go_over();
    ledger_.go_over();
    facts_ = wanted.facts;
  }

  // ---- Starting

  void gather() {
    while (!is_over() && neighbours_ && !neighbours_->have_gathered()) turn(next_time());
    began_at_ = steady_now();
    if (neighbours_ && conclusion_.has_come_up()) neighbours_->gathering().enter(idl::MACHINE_WORKING);
  }

  // Goes on with the processes of a supervisor that is gone. Returns those that do not run any more.
  Members take_over() {
    Members missing = adopt(std::move(inherited_), all_, [this](const Member& member) {
      log::info(options_.log_name, "process " + member.name() + " is adopted");
      ledger_.introduce();
    });
    forget_strangers(run_, graph_, all_, ledger_);
    for (const Member* member : all_)
      if (member->process() != nullptr) beats_.watch_working(member->index(), member->node().hang_limit);
    arrivals_.take_over();
    trading_.brief(all_);  // nobody knows any more what they use
    std::erase_if(missing, [this](const Member* member) {
      const Error gone = note_gone(*member, ledger_, policy_);
      const bool stays_away = policy_.has_finished(member->index());
      if (stays_away && runs_an_end(graph_, *member)) conclusion_.fail_with(gone);
      return stays_away;
    });
    return missing;
  }

  void refuse(const Error& error) {
    log::error(options_.log_name, error.text());
    conclusion_.fail_with(error);
  }

  // ---- Watching

  void turn(Moment until) {
    for (const Member* member : polled_)
      if (member->process() != nullptr) until = std::min(until, member->process()->due().value_or(until));
    std::vector<pollfd> clients;
    control_.add_to(clients);
    poller_.wait(polled_, clients, until);
    control_.serve(now());
    for (const auto& member : members_) look_after(*member);
    log_relay_.pass_on(all_);
    if (neighbours_) neighbours_->turn(now());
    for (const std::size_t process : beats_.look(now())) {
      if (members_[process]->process() != nullptr)
        members_[process]->process()->end_by_force(Force::hang, now());
    }
    arrivals_.go_on();
    if (conclusion_.is_over()) return;
    if (conclusion_.has_come_up()) on_demand_.look(now());
    start_due();
    if (conclusion_.has_come_up()) trading_.look();
  }

  void look_after(Member& member) {
    HostProcess* const process = member.process();
    if (process == nullptr) return;
    hear(member);
    member.look(now());
    if (!process->exit()) return;
    for (int i = 0; i < kMostReads && hear(member); ++i) continue;  // it may have said why
    const ExitReason exit = *process->exit();
    ended(member, exit);
  }

  // Takes what a process has said and printed. Returns whether it had printed something.
  bool hear(Member& member) {
    const bool has_printed = listen(
        member, [&](const Report& report) { return take(member, report); }, now());
    member.pass_on_question();
    return has_printed;
  }

  Status take(Member& member, const Report& report) {
    if (const auto* prompting = std::get_if<Prompting>(&report)) {
      if (!prompting->begins) read_output(member, now());  // the question may have been answered at once
      return member.prompt(prompting->begins), ok();
    }
    if (const auto* standing = std::get_if<Standing>(&report)) control_.recall(*standing);
    if (const auto* code = std::get_if<ExchangedCode>(&report)) return control_.note(*code), ok();
    if (const auto* kept = std::get_if<StateKept>(&report)) return starter_.keep(*kept), ok();
    if (const auto* wish = std::get_if<LogWished>(&report))
      return log_relay_.note_wish(member, wish->is_wanted), ok();
    log_relay_.set_source(&member);
    Status taken = ledger_.take(report, member.name());
    log_relay_.set_source(nullptr);
    return taken;
  }

  // ---- Losing processes

  void ended(Member& member, const ExitReason& reason) {
    const bool unasked = member.phase() != Phase::going_down;
    const std::string words = member.last_words(now());
    const std::string how =
        reason.text() + (words.empty() ? "; it ran " + listed(starter_.components_of(member)) : ": " + words);
    lose(member, how,
         {.is_normal = reason.is_normal(), .is_unasked = unasked, .had_come_up = member.has_come_up()});
  }

  // How a process was lost.
  struct Loss {
    bool is_normal;
    bool is_unasked;
    bool had_come_up;
  };

  void lose(Member& member, const std::string& how, const Loss& loss) {
    beats_.forget(member.index());
    control_.lose(member);  // before its orders are answered by its end
    member.forget();
    arrivals_.lose(member);
    ledger_.lose(member.name(), "its process " + how);
    for (const Wiring::Outer& outer : starter_.wiring().edges_at(member.name())) cut(outer, member, how);
    const std::string text = "process " + member.name() + " " + how;
    if (conclusion_.is_over()) return lose_late(text, loss);
    if (loss.is_unasked) ledger_.raise(host::AlarmKind::process_ended, member.name(), text);
    if (!conclusion_.has_come_up()) return conclusion_.fail_with(fail(Code::unavailable, text));
    const RestartDecision decision = policy_.ended(member.index(), loss.is_normal, now());
    if (policy_.has_finished(member.index()) && !decision.gives_up && runs_an_end(graph_, member))
      return conclusion_.fail_with(fail(Code::unavailable, text));
    obey(decision, text);
    if (policy_.is_asleep(member.index())) on_demand_.fall_asleep(member);
  }

  // A process that is lost while all is taken down spoils the run, unless it was only on its way back.
  void lose_late(const std::string& text, const Loss& loss) {
    if (loss.is_normal || stop_.is_urgent()) return;
    if (conclusion_.has_come_up() && !loss.had_come_up)
      return log::warning(options_.log_name, text + "; it had not come back yet when the run ended");
    log::error(options_.log_name, text);
    conclusion_.fail_late(fail(Code::unavailable, text));
  }

  void cut(const Wiring::Outer& outer, const Member& lost, const std::string& how) {
    const std::string& there = outer.from == lost.name() ? outer.to : outer.from;
    const auto other = std::ranges::find(all_, there, &Member::name);  // it may be on another machine
    if (other != all_.end()) (*other)->tell(CutEdge{outer.name, "process " + lost.name() + " " + how});
  }

  void obey(const RestartDecision& decision, const std::string& text) {
    if (decision.gives_up) {
      ledger_.raise(host::AlarmKind::gave_up, "", text + "; there were too many restarts, so the run ends");
      return conclusion_.fail_with(fail(Code::unavailable, text));
    }
    for (const std::size_t index : decision.end) end_for_restart(*members_[index]);
  }

  // Ends a process that is to start anew together with another one.
  void end_for_restart(Member& member) {
    if (member.process() == nullptr) return;
    beats_.forget(member.index());
    member.end(now(), kHurry, [](const Status&) {});
  }

  // Ends a process that nobody needs any more.
  void let_go(Member& member) {
    log::info(options_.log_name, "process " + member.name() + " ends, because nobody needs it");
    policy_.put_to_sleep(member.index());
    end_for_restart(member);
  }

  void start_due() {
    Members due;
    const auto is_needed = [this](std::size_t index) { return on_demand_.is_needed(*members_[index]); };
    for (const std::size_t index : policy_.take_due(now(), is_needed)) due.push_back(members_[index].get());
    if (!due.empty()) arrivals_.start(due);
  }

  // ---- Ending

  bool is_over() {
    if (conclusion_.is_over()) return true;
    if (stop_.requested()) {
      conclusion_.stop(stop_.failure());
    } else if (neighbours_ && is_over_elsewhere()) {
      return true;
    } else if (!conclusion_.has_come_up()) {
      if (began_at_ && steady_now() >= *began_at_ + kStartLimit)
        refuse(fail(Code::deadline_exceeded, "not everything came up in time"));
    } else if (options_.until && steady_now() >= *arrivals_.up_since() + *options_.until) {
      conclusion_.run_out_of_time();
    } else {
      look_at_ends();
    }
    return conclusion_.is_over();
  }

  // With several machines the run is done when it is on all of them.
  void look_at_ends() {
    if (!neighbours_ || graph_.ends.empty()) return conclusion_.look_at_ends();
    conclusion_.look_at_ends([this](bool is_done_here) {
      neighbours_->gathering().set_done(is_done_here || here_.ends.empty());
      return neighbours_->gathering().are_all_done();
    });
  }

  bool is_over_elsewhere() {
    if (const auto verdict = neighbours_->verdict()) {
      const RunOutcome outcome = outcome_of(verdict->end);
      const bool is_bad = outcome == RunOutcome::failed || outcome == RunOutcome::not_started;
      log::write(is_bad ? log::Level::error : log::Level::info, options_.log_name, verdict->why);
      conclusion_.conclude(outcome, is_bad ? Status(fail(Code::unavailable, verdict->why)) : ok());
      return true;
    }
    if (neighbours_->have_gathered() || steady_now() < called_at_ + graph_.supervision.machine_wait)
      return false;
    refuse(fail(Code::deadline_exceeded, neighbours_->awaited() + " did not come in time"));
    return true;
  }

  void wait_for_rest() {
    const Moment limit = now() + kRestLimit;
    while (!ledger_.at_rest() && now() < limit && !stop_.requested()) turn(limit);
  }

  void take_down() {
    end_ = steady_now();
    TakingDown all(all_, stop_);
    all.begin(now());
    while (!all.is_done(now())) turn(now() + kLook);
    while (neighbours_ && !neighbours_->take_leave(now())) turn(now() + kLook);
  }

  // Says what did not happen in a run that went well.
  void report_idleness() {
    const auto counters = ledger_.counters();
    if (!conclusion_.has_come_up() || !counters || end_ - *arrivals_.up_since() < host::kShortRun) return;
    for (const auto& [who, text] : host::find_idleness(here_, reports_, *counters))
      log::warning(who.empty() ? options_.log_name : who, text);
  }

  // Returns when there is something to do although nothing happens.
  [[nodiscard]] Moment next_time() const {
    Moment next = now() + kLook;
    if (options_.until && conclusion_.has_come_up())
      next = std::min(next, to_steady(*arrivals_.up_since() + *options_.until));
    next = std::min(next, beats_.due().value_or(next));
    return std::min(next, policy_.due().value_or(next));
  }

  [[nodiscard]] static Moment now() { return Moment::clock::now(); }

  [[nodiscard]] host::RunResult result() const {
    host::RunResult result;
    conclusion_.fill(result);
    ledger_.fill(result);
    result.end = end_;
    return result;
  }

  graph::Graph graph_;
  graph::Graph here_;  // what runs on this machine
  SystemFacts facts_;
  const SupervisedOptions& options_;
  host::StopSignal& stop_;
  host::RunListener& listener_;
  const TimePoint called_at_ = steady_now();
  const RunIdentity run_;
  std::vector<AdoptedProcess> inherited_;  // until take_over()
  const std::vector<std::unique_ptr<Member>> members_;
  const Members all_;
  Members polled_ = all_;
  Starter starter_;
  const AlarmRelay relay_{all_};
  Ledger ledger_;
  LogRelay log_relay_;
  std::optional<Neighbours> neighbours_;  // if the graph has several machines
  const host::Reports reports_ = ledger_.reports();
  Trading trading_{graph_, all_, reports_, neighbours_};
  RestartPolicy policy_;
  Poller poller_;
  Heartbeats beats_{run_.page};
  ControlDesk control_;
  Conclusion conclusion_{here_, reports_, options_.log_name};
  Arrivals arrivals_{{starter_, beats_, ledger_, control_, conclusion_, neighbours_, trading_,
                      graph_.supervision, options_.log_name, [this](Member& member, const Error& error) {
                        lose(member, "could not be started: " + error.message, {false, true, false});
                      }}};
  OnDemand on_demand_{all_, starter_, ledger_, [this](Member& member) { let_go(member); }};
  std::optional<TimePoint> began_at_;  // when all machines were there
  TimePoint end_ = called_at_;
};

host::RunResult refuse(const Error& error, const std::string& log_name, host::RunListener& listener) {
  log::error(log_name, error.text());
  host::RunResult result;
  result.outcome = RunOutcome::not_started;
  result.error = error;
  listener.ended(result);
  return result;
}

}  // namespace

host::RunResult run_supervised(const graph::Graph& graph, const SupervisedOptions& options,
                               host::StopSignal& stop, host::RunListener& listener) {
  Result<ControlSocket> socket = ControlSocket::open(graph.name);
  if (!socket && socket.error().code == Code::already_exists)
    return refuse(socket.error(), options.log_name, listener);
  Result<Beginning> beginning = begin_or_go_on(graph, options.machine);
  if (!beginning) return refuse(beginning.error(), options.log_name, listener);
  log::set_clock([start = beginning->run.start] { return TimePoint(steady_now() - start); });
  host::RunResult result =
      SupervisedRun(graph, options, std::move(beginning).value(), stop, listener).execute(std::move(socket));
  clear_meeting_places(graph.name);
  log::set_clock(nullptr);
  return result;
}

}  // namespace orca::supervisor
