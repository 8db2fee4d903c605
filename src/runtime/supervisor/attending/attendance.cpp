// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/attendance.hpp"

#include <pthread.h>

#include <atomic>
#include <cstdlib>
#include <exception>
#include <optional>
#include <thread>
#include <utility>

#include "hosted/order_desk.hpp"
#include "hosted/report_sender.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/log.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "reception.hpp"

namespace orca::supervisor {
namespace {

graph::Graph in_one_process(graph::Graph graph) {
  graph.machines.clear();
  graph.processes.clear();
  for (graph::HardwareNode& node : graph.hardware) node.process = graph::kMainProcess;
  for (graph::ComponentNode& node : graph.components) node.process = graph::kMainProcess;
  for (graph::Edge& edge : graph.edges) edge.link = graph::Link::local;
  return graph;
}

// The supervisor's own log is that of the run already.
RunWishes without_log() {
  RunWishes wishes;
  wishes.log_level = log::Level::off;
  return wishes;
}

}  // namespace

// The two ends of a channel within this process: a supervisor on a thread of its own, and the desk that takes its orders.
class Attendance::Inside {
 public:
  Inside(Attended run, Pace& pace, host::RunListener& listener, ControlSocket socket, SocketPair channel)
      : run_(std::move(run)),
        pace_(pace),
        listener_(listener),
        channel_(std::make_shared<Channel>(std::move(channel.host))),
        reports_(channel_, graph::kMainProcess, without_log()),
        reception_(run_.graph, run_.facts, pace, run_.log_name,
                   {std::move(socket), std::move(channel.supervisor)}) {}

  void enter(host::PartAccess& run) {
    run.open_descriptors([&] {
      desk_.emplace(channel_, run, reports_, site());
      thread_ = std::jthread([this, &run] {
        pthread_setname_np(pthread_self(), "supervisor");
        attend(run);
      });
    });
  }

  void leave() {
    desk_.reset();
    reception_.end();
    if (thread_.joinable()) thread_.join();
  }

  [[nodiscard]] Pace& pace() { return pace_; }
  [[nodiscard]] host::RunListener& listener() { return listener_; }
  [[nodiscard]] ReportSender& reports() { return reports_; }
  [[nodiscard]] Reception& reception() { return reception_; }

 private:
  // A run goes on without whoever looks on.
  void attend(host::PartAccess& run) {
    try {
      reception_.run([&run](const std::function<void()>& opening) { run.open_descriptors(opening); });
    } catch (const std::exception& error) {
      log::error(run_.log_name, std::string("nobody can reach this run any more: ") + error.what());
    }
  }

  OrderDesk::Site site() {
    return {run_.graph.name,
            graph::kMainProcess,
            heartbeat_,
            false,
            [] { return Orphaned{}; },  // it never is
            [](const AddComponent&) {},
            [](const NoteProcess&) {}};
  }

  const Attended run_;
  Pace& pace_;
  host::RunListener& listener_;
  std::atomic<std::uint32_t> heartbeat_{0};  // nobody listens: one process cannot restart itself
  const std::shared_ptr<Channel> channel_;
  ReportSender reports_;
  Reception reception_;
  std::optional<OrderDesk> desk_;
  std::jthread thread_;
};

Result<std::unique_ptr<Attendance>> Attendance::open(Attended run, Pace& pace, host::RunListener& listener) {
  Result<ControlSocket> socket = ControlSocket::open(run.graph.name);
  if (!socket) return socket.error();
  run.graph = in_one_process(std::move(run.graph));
  std::unique_ptr<Inside> inside;
  const Status made = contain_exhaustion([&]() -> Status {
    Result<SocketPair> channel = make_socket_pair();
    if (!channel) return channel.error();
    inside = std::make_unique<Inside>(std::move(run), pace, listener, std::move(socket).value(),
                                      std::move(channel).value());
    return ok();
  });
  if (!made.ok()) return made.error();
  return std::unique_ptr<Attendance>(new Attendance(std::move(inside)));
}

Attendance::Attendance(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}

Attendance::~Attendance() { inside_->leave(); }

Pace& Attendance::pace() { return inside_->pace(); }

void Attendance::enter(host::PartAccess& run) { inside_->enter(run); }

void Attendance::came_up() { inside_->reception().note_up(); }

void Attendance::component_changed(const std::string& component, const host::ComponentReport& report) {
  inside_->reports().component_changed(component, report);
}

void Attendance::leave() { inside_->leave(); }

// What follows is passed on, and what people want to know is told to the supervisor, too.

void Attendance::started(TimePoint now) { inside_->listener().started(now); }

void Attendance::robots(const host::RobotNames& robots) { inside_->listener().robots(robots); }

void Attendance::built(const host::RunView& view) { inside_->listener().built(view); }

void Attendance::arrived(const idl::Arrived& arrived) {
  inside_->listener().arrived(arrived);
  inside_->reports().arrived(arrived);
}

void Attendance::goal_failed(const idl::GoalFailed& failed) {
  inside_->listener().goal_failed(failed);
  inside_->reports().goal_failed(failed);
}

void Attendance::contact(const idl::Contact& contact) {
  inside_->listener().contact(contact);
  inside_->reports().contact(contact);
}

void Attendance::alarm(const idl::Alarm& alarm) {
  inside_->listener().alarm(alarm);
  inside_->reports().alarm(alarm);
}

void Attendance::mission_step(const std::string& port, const ObjectRef& object) {
  inside_->listener().mission_step(port, object);
  inside_->reports().mission_step(port, object);
}

void Attendance::logged(log::Level level, std::string_view who, std::string_view text) {
  inside_->listener().logged(level, who, text);
}

void Attendance::ended(const host::RunResult& result) { inside_->listener().ended(result); }

void Attendance::abandon(const host::RunResult& result) {
  inside_->listener().abandon(result);
  std::abort();  // it does not return, which the compiler cannot see
}

}  // namespace orca::supervisor
