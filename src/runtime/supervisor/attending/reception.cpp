// SPDX-License-Identifier: LGPL-3.0-or-later
#include "reception.hpp"

#include <memory>
#include <utility>
#include <vector>

#include "members/conductor.hpp"
#include "members/ledger.hpp"
#include "members/listening.hpp"
#include "members/member.hpp"
#include "members/roster.hpp"
#include "orca/base/log.hpp"
#include "orca/graph/placement.hpp"
#include "orca/supervisor/restart_policy.hpp"
#include "run/control_desk.hpp"
#include "starting/renewal.hpp"
#include "starting/run_identity.hpp"
#include "starting/starter.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kLook = 50ms;  // between two looks at everything

// The run has a listener of its own.
class Nobody final : public host::RunListener {
 public:
  [[noreturn]] void abandon(const host::RunResult& /*result*/) override { std::terminate(); }
};

host::RunListener& nobody() {
  static Nobody it;
  return it;
}

Error only_process() {
  return fail(Code::unimplemented, "everything runs in this one process, which cannot begin anew by itself");
}

}  // namespace

class Reception::Desk {
 public:
  Desk(Reception& around, RunIdentity run)
      : around_(around),
        run_(std::move(run)),
        ledger_(around.graph_, nobody(), TimePoint(), around.log_name_,
                [&] { return around.pace_.look().time; }),
        control_(conductor_, around.graph_, around.graph_, around.facts_, roster_.all(), ledger_, starter_,
                 renewal_, levers(), {}) {
    ledger_.relay_to(roster_.all());  // alarms that the desk itself raises, such as ESTOP
    self().adopt(HostProcess::here(self().name(), std::move(around.doors_.channel)));
    self().enter(Member::Phase::coming_up);
    control_.built(roster_.all());
  }

  void serve(const std::function<void(const std::function<void()>&)>& open) {
    conductor_.run([&] {
      control_.open(std::move(around_.doors_.socket));
      while (!around_.ends_) {
        wait();
        open([&] { turn(); });
      }
      control_.close();  // before the jobs of operators end without an answer
    });
  }

 private:
  [[nodiscard]] Member& self() { return *roster_.all().front(); }

  DeskLevers levers() {
    return {{[this] { self().tell(TakeDown{}); }, [](Member&) -> Status { return only_process(); },
             &around_.pace_},
            [] { return std::vector<const graph::Edge*>{}; }};
  }

  void wait() {
    Channel& channel = self().process()->channel();
    const bool unsent = channel.has_unsent();
    std::vector<pollfd> all{
        {channel.descriptor(), static_cast<short>(unsent ? POLLIN | POLLOUT : POLLIN), 0}};
    control_.add_to(all);
    around_.poller_.wait({}, all, Moment::clock::now() + kLook);
  }

  void turn() {
    const Moment now = Moment::clock::now();
    if (around_.is_up_ && self().phase() == Member::Phase::coming_up) {
      self().enter(Member::Phase::up);
      control_.came_up(roster_.all());
    }
    control_.serve(now);
    (void)listen(
        self(), [this](const Report& report) { return take(report); }, now);
    conductor_.go_on(now);
  }

  Status take(const Report& report) {
    if (const auto* code = std::get_if<ExchangedCode>(&report)) return control_.note(*code), ok();
    if (std::holds_alternative<LogWished>(report)) return ok();  // there are no other processes
    return ledger_.take(report, self().name());
  }

  Reception& around_;
  const RunIdentity run_;
  const SupervisedOptions options_{};
  Roster roster_{around_.graph_, "", run_.processes};
  Starter starter_{around_.graph_, options_.facts, options_, run_, roster_};
  Conductor conductor_{[this] { around_.poller_.wake(); }};
  Ledger ledger_;
  RestartPolicy policy_{graph::processes_of(around_.graph_), around_.graph_.supervision};
  Renewal renewal_{conductor_,
                   {roster_, policy_, starter_, [](Member&, bool) {}, [](const std::string&) {},
                    [] { return false; }, around_.log_name_}};
  ControlDesk control_;
};

void Reception::run(const std::function<void(const std::function<void()>&)>& open) {
  std::unique_ptr<Desk> desk;
  open([&] {
    Result<RunIdentity> run = begin_run(graph_, "");
    if (run)
      desk = std::make_unique<Desk>(*this, std::move(run).value());
    else
      log::error(log_name_, "nobody can reach this run: " + run.error().text());
  });
  if (desk) desk->serve(open);
}

}  // namespace orca::supervisor
