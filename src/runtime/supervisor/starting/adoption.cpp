// SPDX-License-Identifier: LGPL-3.0-or-later
#include "adoption.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <thread>
#include <utility>

#include "agreed/graph_mark.hpp"
#include "agreed/run_wishes.hpp"
#include "orca/base/log.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/placement.hpp"
#include "orca/graph/print.hpp"
#include "orca/supervisor/log_name.hpp"
#include "orca/supervisor/meeting_place.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kAnswerLimit = 2s;  // for all together; less than they wait for a visitor to speak
constexpr auto kRetry = std::chrono::milliseconds(20);

// A process that waits, and what it has said of itself.
struct Orphan {
  Waiting waiting;
  Orphaned said;
};

// Returns what a process says first. It says nothing while it has not noticed yet that its supervisor is gone.
Result<Orphaned> hear(const Waiting& waiting, Duration limit) {
  Descriptor copy(fcntl(waiting.connection.number(), F_DUPFD_CLOEXEC, 0));
  Channel channel(std::move(copy));
  Result<Message> message = channel.wait_for_message(limit);
  if (!message) return message.error();
  Result<Report> report = decode_report(std::move(message).value());
  if (!report) return report.error();
  if (auto* const said = std::get_if<Orphaned>(&*report)) return std::move(*said);
  return fail(Code::data_loss, "it says something else than who it is");
}

// Meets the processes of a system that wait.
class Search {
 public:
  explicit Search(const graph::Graph& graph) : system_(graph.name), mark_(mark_of(graph::print(graph))) {}

  // Returns all that have said who they are.
  std::vector<Orphan> meet_all() {
    const Moment limit = Moment::clock::now() + kAnswerLimit;
    while (!meet(limit) && Moment::clock::now() < limit) std::this_thread::sleep_for(kRetry);
    return std::move(orphans_);
  }

  // Kills those that have said nothing.
  void kill_silent() const {
    for (const Waiting& waiting : connect_to_waiting(system_)) {
      if (met_.contains(waiting.pid)) continue;
      log::warning(kLogName, "process " + std::to_string(waiting.pid) + " of " + in_quotes(system_) +
                                 " has no deployer and does not answer; it is killed");
      syscall(SYS_pidfd_send_signal, waiting.pidfd.number(), SIGKILL, nullptr, 0);
    }
  }

  // Checks that they are of one run of the graph.
  [[nodiscard]] Status check(const std::vector<Orphan>& orphans) const {
    std::vector<std::string> names;
    std::set<std::string> runs;
    bool is_same = true;
    for (const Orphan& orphan : orphans) {
      names.push_back(orphan.said.process);
      is_same = is_same && orphan.said.graph == mark_;
      for (const auto& [option, value] : orphan.said.options)
        if (option == "run") runs.insert(value);
    }
    if (is_same && runs.size() < 2) return ok();
    return fail(Code::failed_precondition,
                "processes of " + std::string(is_same ? "several runs" : "another graph") + " named " +
                    in_quotes(system_) + " run without a deployer: " + listed(names) +
                    "; stop them first: orcactl --system " + system_ + " stop");
  }

 private:
  // Returns whether all that wait have been met.
  bool meet(Moment limit) {
    bool all = true;
    for (Waiting& waiting : connect_to_waiting(system_)) {
      if (met_.contains(waiting.pid)) continue;
      Result<Orphaned> said = hear(waiting, std::max<Duration>(limit - Moment::clock::now(), 1ms));
      if (said) met_.insert(waiting.pid);
      if (said) orphans_.push_back({std::move(waiting), std::move(said).value()});
      all = all && said;
    }
    return all;
  }

  const std::string system_;
  const std::uint64_t mark_;
  std::set<pid_t> met_;
  std::vector<Orphan> orphans_;
};

AdoptedProcess process_of(Orphan& orphan) {
  return {orphan.said.process, orphan.waiting.pid, std::move(orphan.waiting.pidfd),
          std::move(orphan.said.output), std::move(orphan.waiting.connection)};
}

// The run goes on with what its processes share.
Result<RunIdentity> identity_of(std::vector<Orphan>& orphans, const graph::Graph& graph) {
  std::vector<std::vector<std::string>> doorbells;
  std::vector<std::vector<std::string>> places;
  for (const Orphan& orphan : orphans) {
    doorbells.push_back(orphan.said.doorbells);
    places.push_back(orphan.said.processes);
  }
  std::vector<std::string> processes = joined_names(places);
  Orphaned& first = orphans.front().said;
  const Result<RunWishes> wishes = read_wishes(first.options);
  if (!wishes) return wishes.error();
  Result<RunPage> page = RunPage::map(std::move(first.run_page), processes.size(), graph.components.size());
  if (!page) return page.error();
  set_steady_epoch(wishes->epoch);
  return RunIdentity{std::move(page).value(), wishes->start,        wishes->run,
                     joined_names(doorbells), std::move(processes), true};
}

// Ends what a process has left of a component that the graph does not have.
void remove(const std::string& component, Member& member) {
  member.ask(RemoveComponent{component}, [component, process = member.name()](const Status& gone) {
    if (gone.ok()) return;
    log::warning(component, "the graph does not have it, but it is left in process " + process +
                                " from before this deployer came: " + gone.error().message +
                                "; orcactl restart " + process + " is rid of it");
  });
}

}  // namespace

Result<Beginning> begin_or_go_on(const graph::Graph& graph, const std::string& machine) {
  Search search(graph);
  std::vector<Orphan> orphans = search.meet_all();
  if (const Status fits = search.check(orphans); !fits.ok()) return fits.error();
  search.kill_silent();
  const std::vector<graph::ProcessNode> here = graph::processes_on(graph, machine);
  std::erase_if(orphans, [&](const Orphan& orphan) {
    return std::ranges::find(here, orphan.said.process, &graph::ProcessNode::name) == here.end();
  });
  Result<RunIdentity> run = orphans.empty() ? begin_run(graph, machine) : identity_of(orphans, graph);
  if (!run) return run.error();
  std::vector<AdoptedProcess> processes;
  for (Orphan& orphan : orphans) processes.push_back(process_of(orphan));
  return Beginning{std::move(run).value(), std::move(processes)};
}

std::vector<std::string> joined_names(const std::vector<std::vector<std::string>>& known) {
  std::vector<std::string> all;
  for (const std::vector<std::string>& names : known) {
    all.resize(std::max(all.size(), names.size()));
    for (std::size_t i = 0; i < names.size(); ++i)
      if (!names[i].empty()) all[i] = names[i];
  }
  return all;
}

Members adopt(std::vector<AdoptedProcess> processes, const Members& all,
              const std::function<void(Member&)>& adopted) {
  Members missing;
  for (Member* const member : all) {
    const auto process = std::ranges::find(processes, member->name(), &AdoptedProcess::name);
    if (process == processes.end()) {
      missing.push_back(member);
      continue;
    }
    member->adopt(HostProcess::adopt(std::move(*process)));
    member->ask(Adopt{}, [member, adopted](const Status&) { adopted(*member); });
  }
  return missing;
}

void forget_strangers(const RunIdentity& run, const graph::Graph& graph, const Members& all, Ledger& ledger) {
  for (const std::string& name : run.doorbells) {
    if (name.empty() || graph.find_component(name) != nullptr) continue;
    ledger.expect(name);
    for (Member* const member : all)
      if (member->process() != nullptr) remove(name, *member);
  }
}

Error note_gone(const Member& member, Ledger& ledger, RestartPolicy& policy) {
  const std::string text = "process " + member.name() + " was gone when this deployer came";
  ledger.raise(idl::PROCESS_ENDED, member.name(), text);
  if (member.node().restart == graph::Restart::temporary)
    (void)policy.ended(member.index(), true, Moment::clock::now());
  return fail(Code::unavailable, text);
}

void let_outlive(Member& member, const graph::Supervision& rules) {
  if (rules.on_supervisor_loss != graph::OnLoss::go_on) return;
  Descriptor output = member.process()->share_output();
  if (!output) return;
  const auto wait = static_cast<std::uint64_t>(rules.adoption_wait.count());
  member.ask(Outlive{std::move(output), wait}, [name = member.name()](const Status& prepared) {
    if (!prepared.ok())
      log::warning(name, "this process cannot go on without its deployer: " + prepared.error().message);
  });
}

}  // namespace orca::supervisor
