// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/supervised_run.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "arrivals.hpp"
#include "control_desk.hpp"
#include "losses.hpp"
#include "machines/neighbours.hpp"
#include "machines/team_presence.hpp"
#include "machines/trading.hpp"
#include "members/conductor.hpp"
#include "members/ledger.hpp"
#include "members/listening.hpp"
#include "members/log_relay.hpp"
#include "members/member.hpp"
#include "members/poller.hpp"
#include "members/recorder_watch.hpp"
#include "members/roster.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/plan.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/conclusion.hpp"
#include "orca/host/idleness.hpp"
#include "orca/supervisor/heartbeats.hpp"
#include "orca/supervisor/meeting_place.hpp"
#include "orca/supervisor/restart_policy.hpp"
#include "refusal.hpp"
#include "starting/adoption.hpp"
#include "starting/on_demand.hpp"
#include "starting/renewal.hpp"
#include "starting/run_identity.hpp"
#include "starting/starter.hpp"
#include "taking_down.hpp"

namespace orca::supervisor {
namespace {

using host::RunOutcome;

constexpr Duration kRestLimit = 1s;
constexpr Duration kLook = 50ms;  // between two looks at everything
constexpr int kMostReads = 32;    // of what a process has printed, after its end

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
        roster_(graph, options.machine, run_.processes),
        starter_(graph_, facts_, options, run_, roster_),
        ledger_(here_, listener, run_.start, options.log_name),
        policy_(graph::processes_on(graph, options.machine), graph.supervision),
        control_(conductor_, graph_, here_, facts_, roster_.all(), ledger_, starter_, renewal_, levers(),
                 applying()) {
    ledger_.relay_to(roster_.all());
    control_.note_file(options.graph_file);
    if (options.watches) control_.watch(options.graph_files);
    if (speaks_to_team()) {
      team_.emplace(graph, starter_.plain_start("team"));
      control_.join_team([this](Reply& reply) { team_->show(reply); });
      poll_all();
    }
    if (graph.machines.size() < 2) return;
    neighbours_.emplace(graph, options.machine, starter_.plain_start("peers"), ledger_, run_.page);
    control_.join(neighbours_->motors(), [this](Reply& reply) { neighbours_->show(reply); });
    poll_all();
    conclusion_.on_end(
        [this](RunOutcome outcome, const std::string& why) { neighbours_->conclude(outcome, why, now()); });
  }

  host::RunResult execute(Result<ControlSocket> socket, SharedSocket others) {
    host::RunResult result;
    conductor_.run([&] {
      result = run(std::move(socket), std::move(others));
      control_.close();  // before the jobs of operators end without an answer
    });
    return result;
  }

 private:
  host::RunResult run(Result<ControlSocket> socket, SharedSocket others) {
    stop_.on_request([this] { poller_.wake(); });
    if (options_.outputs.looks_on) listener_.built(ledger_);
    control_.open(std::move(socket), std::move(others));
    if (options_.holds) control_.hold();
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

  // ---- Operators

  DeskLevers levers() {
    const auto stop = [this] {
      if (!conclusion_.is_over()) conclusion_.stop("");
    };
    const auto restart = [this](Member& member) -> Status {
      if (Status works = this->works(); !works.ok()) return works;
      if (renewal_.is_under_way())
        return fail(Code::unavailable, "processes are just beginning anew; try again when they are up");
      if (Status can = can_start_processes(facts_); !can.ok()) return can;
      policy_.restart(member.index(), now());
      on_demand_.want(member);
      losses_.end(member);
      return ok();
    };
    return {{stop, restart}, [this] { return trading_.in_use(); }};
  }

  Applying::Levers applying() {
    return {options_.read, options_.executor, [this](const CheckedSystem& wanted) { accept(wanted); },
            [this] { return works(); }};
  }

  [[nodiscard]] Status works() const {
    if (conclusion_.has_come_up() && !conclusion_.is_over()) return ok();
    return fail(Code::failed_precondition, "the system is just coming up or ending");
  }

  // Goes on with a graph that is carried out already. Processes that are started from now on run it.
  void accept(const CheckedSystem& wanted) {
    graph::go_over(graph_, wanted.graph);
    graph::go_over(here_, wanted.graph);
    roster_.go_over(graph_);
    if (team_) team_->go_over(graph_.team);
    policy_.go_over(graph::processes_on(graph_, options_.machine));
    poll_all();
    starter_.go_over();
    ledger_.go_over();
    facts_ = wanted.facts;
  }

  void poll_all() {
    polled_ = roster_.all();
    if (neighbours_) polled_.push_back(&neighbours_->member());
    if (team_) polled_.push_back(&team_->member());
  }

  // The first machine speaks for all.
  [[nodiscard]] bool speaks_to_team() const {
    return !graph_.team.name.empty() &&
           (graph_.machines.empty() || graph_.machines.front().name == options_.machine);
  }

  // ---- Starting

  void gather() {
    while (!is_over() && neighbours_ && !neighbours_->have_gathered()) turn(next_time());
    began_at_ = steady_now();
    if (neighbours_ && conclusion_.has_come_up()) neighbours_->gathering().enter(idl::MACHINE_WORKING);
  }

  // Goes on with the processes of a supervisor that is gone. Returns those that do not run any more.
  Members take_over() {
    Members missing = adopt(std::move(inherited_), roster_.all(), [this](const Member& member) {
      log::info(options_.log_name, "process " + member.name() + " is adopted");
      ledger_.introduce();
    });
    forget_strangers(run_, graph_, roster_.all(), ledger_);
    for (const Member* member : roster_.all())
      if (member->process() != nullptr) beats_.watch_working(member->place(), member->node().hang_limit);
    arrivals_.take_over();
    trading_.brief(roster_.all());  // nobody knows any more what they use
    std::erase_if(missing, [this](const Member* member) {
      const Error gone = note_gone(*member, ledger_, policy_);
      if (!member->node().on_demand) control_.distrust(*member);
      const bool stays_away = policy_.has_finished(member->index());
      if (stays_away && runs_an_end(graph_, *member)) conclusion_.fail_with(gone);
      return stays_away;
    });
    return missing;
  }

  // ---- Watching

  void turn(Moment until) {
    for (const Member* member : polled_)
      if (member->process() != nullptr) until = std::min(until, member->process()->due().value_or(until));
    std::vector<pollfd> clients;
    control_.add_to(clients);
    poller_.wait(polled_, clients, until);
    control_.serve(now());
    for (Member* const member : Members(roster_.all())) look_after(*member);
    log_relay_.pass_on(roster_.all());
    if (neighbours_) neighbours_->turn(now());
    if (team_) team_->turn(now());
    control_.hear_machines(now());
    look_at_beats();
    conductor_.go_on(now());
    if (conclusion_.is_over()) return;
    look_at_recorders(recorders_, options_.look_beside, conclusion_.has_come_up(), now(), ledger_);
    if (conclusion_.has_come_up()) on_demand_.look(now());
    start_due();
    if (conclusion_.has_come_up()) trading_.look();
  }

  void look_at_beats() {
    for (const std::size_t place : beats_.look(now())) {
      const Member* const member = roster_.at_place(place);
      if (member != nullptr && member->process() != nullptr && !member->process()->is_dying())
        member->process()->end_by_force(Force::hang, now());
    }
    for (const auto& [place, time] : beats_.take_starved()) {
      const Member* const member = roster_.at_place(place);
      if (member != nullptr)
        log::warning(options_.log_name, "process " + member->name() + " had no processor for " +
                                            seconds_text(time) + ": the machine has too much to do");
    }
  }

  // Returns for how long the thread of a process that beats has waited for a processor.
  Duration waited_of(std::size_t place) {
    const Member* const member = roster_.at_place(place);
    return member == nullptr || member->process() == nullptr ? Duration{0}
                                                             : member->process()->waited_for_processor();
  }

  void look_after(Member& member) {
    HostProcess* const process = member.process();
    if (process == nullptr) return;
    hear(member);
    member.look(now());
    if (!process->exit()) return;
    for (int i = 0; i < kMostReads && hear(member); ++i) continue;  // it may have said why
    const ExitReason exit = *process->exit();
    // A signal to all processes ends this one, too, and perhaps first.
    if (stop_.requested() && !conclusion_.is_over()) conclusion_.stop(stop_.failure());
    losses_.ended(member, exit);
  }

  // Takes what a process has said and printed. Returns whether it had printed something.
  bool hear(Member& member) {
    const bool has_printed = listen(
        member, [&](const Report& report) { return take(member, report); }, now());
    member.pass_on_question();
    conductor_.go_on(now());  // before anything is made of the end of the process
    return has_printed;
  }

  Status take(Member& member, const Report& report) {
    if (const auto* prompting = std::get_if<Prompting>(&report)) {
      if (!prompting->begins) read_output(member, now());  // the question may have been answered at once
      return member.prompt(prompting->begins), ok();
    }
    if (const auto* standing = std::get_if<Standing>(&report)) control_.recall(*standing);
    if (const auto* built = std::get_if<Built>(&report)) control_.note(*built, member.name());
    if (const auto* code = std::get_if<ExchangedCode>(&report)) return control_.note(*code), ok();
    if (const auto* call = std::get_if<PeerCalled>(&report)) return control_.obey(*call, member.name());
    if (const auto* kept = std::get_if<StateKept>(&report)) return starter_.keep(*kept), ok();
    if (const auto* damaged = std::get_if<EdgeDamaged>(&report))
      return starter_.mend(damaged->edge, now()), ok();
    if (const auto* wish = std::get_if<LogWished>(&report))
      return log_relay_.note_wish(member, wish->is_wanted), ok();
    log_relay_.set_source(&member);
    Status taken = ledger_.take(report, member.name());
    log_relay_.set_source(nullptr);
    return taken;
  }

  // ---- Processes that come and go

  // Ends a process that nobody needs any more.
  void let_go(Member& member) {
    log::info(options_.log_name, "process " + member.name() + " ends, because nobody needs it");
    policy_.put_to_sleep(member.index());
    losses_.end(member);
  }

  void start_due() {
    Members due;
    const auto is_needed = [this](std::size_t index) { return on_demand_.is_needed(*roster_.all()[index]); };
    for (const std::size_t index : policy_.take_due(now(), is_needed)) due.push_back(roster_.all()[index]);
    for (const Member* const member : due) renewal_.note_start(*member);
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
        conclusion_.report_failure(fail(Code::deadline_exceeded, "not everything came up in time"));
    } else if (options_.until && steady_now() >= *arrivals_.up_since() + *options_.until) {
      conclusion_.run_out_of_time();
    } else if (!renewal_.is_under_way()) {  // what goes back has not failed
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
    conclusion_.report_failure(
        fail(Code::deadline_exceeded, neighbours_->awaited() + " did not come in time"));
    return true;
  }

  void wait_for_rest() {
    const Moment limit = now() + kRestLimit;
    while (!ledger_.at_rest() && now() < limit && !stop_.requested()) turn(limit);
  }

  void take_down() {
    end_ = steady_now();
    TakingDown all(roster_.all(), stop_);
    all.begin(now());
    while (!all.is_done(now())) turn(now() + kLook);
    while (team_ && !team_->take_leave(now())) turn(now() + kLook);
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
  Roster roster_;
  Members polled_ = roster_.all();
  Starter starter_;
  Ledger ledger_;
  LogRelay log_relay_;
  RecorderWatch recorders_;
  std::optional<Neighbours> neighbours_;  // if the graph has several machines
  std::optional<TeamPresence> team_;      // if this supervisor speaks to one
  const host::Reports reports_ = ledger_.reports();
  Trading trading_{graph_, roster_.all(), reports_, neighbours_};
  RestartPolicy policy_;
  Poller poller_;
  Conductor conductor_{[this] { poller_.wake(); }};
  Heartbeats beats_{run_.page, [this](std::size_t place) { return waited_of(place); }};
  ControlDesk control_;
  host::Conclusion conclusion_{here_, reports_, options_.log_name};
  Arrivals arrivals_{
      {conductor_, starter_, beats_, ledger_, control_, conclusion_, neighbours_, trading_,
       graph_.supervision, options_.log_name, options_.recorders,
       [this](Member& member, const Error& error) { losses_.could_not_start(member, error); }}};
  OnDemand on_demand_{roster_.all(), starter_, ledger_, [this](Member& member) { let_go(member); }};
  Renewal renewal_{conductor_,
                   {roster_, policy_, starter_,
                    [this](Member& member, bool keeps_states) { losses_.end(member, keeps_states); },
                    [this](const std::string& component) { ledger_.pardon(component); },
                    [this] { return conclusion_.is_over(); }, options_.log_name}};
  Losses losses_{{graph_, options_.log_name, stop_, roster_, starter_, ledger_, policy_, beats_, control_,
                  conclusion_, on_demand_, renewal_}};
  std::optional<TimePoint> began_at_;  // when all machines were there
  TimePoint end_ = called_at_;
};

}  // namespace

host::RunResult run_supervised(const graph::Graph& graph, const SupervisedOptions& options,
                               host::StopSignal& stop, host::RunListener& listener) {
  Result<ControlSocket> socket = ControlSocket::open(graph.name);
  if (!socket && (socket.error().code == Code::already_exists || !graph.hardware.empty()))
    return refuse(unreachable(socket.error()), options.log_name, listener);
  Result<SharedSocket> others = SharedSocket::open(graph.name, options.grants);
  if (!others) return refuse(others.error(), options.log_name, listener);
  Result<Beginning> beginning = begin_or_go_on(graph, options.machine);
  if (!beginning) return refuse(beginning.error(), options.log_name, listener);
  log::set_clock([start = beginning->run.start] { return TimePoint(steady_now() - start); });
  host::RunResult result = SupervisedRun(graph, options, std::move(beginning).value(), stop, listener)
                               .execute(std::move(socket), std::move(others).value());
  clear_meeting_places(graph.name);
  log::set_clock(nullptr);
  return result;
}

}  // namespace orca::supervisor
