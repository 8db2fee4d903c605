// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report_sender.hpp"

#include <cstdlib>
#include <utility>
#include <vector>

#include "agreed/tallying.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/supervisor/meeting_place.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kLastLimit = 200ms;

template <class T>
std::vector<std::byte> bytes_of(const T& object) {
  std::vector<std::byte> bytes;
  object_type<T>().serialize(&object, bytes);
  return bytes;
}

}  // namespace

ReportSender::ReportSender(std::shared_ptr<Channel> channel, const std::string& process,
                           const RunWishes& wishes)
    : start_(wishes.start),
      channel_(std::move(channel)),
      recollection_(process),
      log_([this, level = wishes.log_level](const log::Line& line) {
        if (line.level < level) return;
        send(Logged{line.level, std::string(line.who), std::string(line.text)});
      }) {}

void ReportSender::send(Report report) {
  const MutexLock lock(mutex_);
  tell(std::move(report));
}

void ReportSender::tell(Report report) {
  const bool is_state = recollection_.note_state(report);
  if (channel_ != nullptr) {
    recollection_.note_told(report);
    (void)channel_->post(encode(std::move(report)));  // its end is seen elsewhere
  } else if (!is_state) {
    backlog_.keep(std::move(report), steady_now() - start_);
  }
}

void ReportSender::send_last(Report report) {
  std::shared_ptr<Channel> channel;
  {
    const MutexLock lock(mutex_);
    channel = channel_;
  }
  if (channel != nullptr) (void)channel->send(encode(std::move(report)), kLastLimit);
}

void ReportSender::lose_supervisor() {
  const MutexLock lock(mutex_);
  channel_.reset();
}

void ReportSender::greet(std::shared_ptr<Channel> channel) {
  const MutexLock lock(mutex_);
  for (Report& report : recollection_.reports()) (void)channel->post(encode(std::move(report)));
  channel_ = std::move(channel);
  shown_.clear();
  for (Report& report : backlog_.take()) tell(std::move(report));
}

void ReportSender::remember(const std::function<void(Recollection&)>& note) {
  const MutexLock lock(mutex_);
  note(recollection_);
}

void ReportSender::component_changed(const std::string& component, const host::ComponentReport& report) {
  send(StateChange{component, static_cast<std::uint64_t>(report.state), report.failure, report.has_worked,
                   report.has_failed, report.ended_badly});
}

void ReportSender::rest_changed(bool at_rest) { send(RestChange{at_rest}); }

void ReportSender::arrived(const idl::Arrived& arrived) { send(ArrivedReport{bytes_of(arrived)}); }

void ReportSender::goal_failed(const idl::GoalFailed& failed) { send(GoalFailedReport{bytes_of(failed)}); }

void ReportSender::contact(const idl::Contact& contact) { send(ContactReport{bytes_of(contact)}); }

void ReportSender::mission_step(const std::string& port, const ObjectRef& object) {
  const idl::OrcaObject& header = object.header();
  const idl::Cause& cause = header.cause();
  send(MissionStep{header.mission(), static_cast<std::uint64_t>(header.creation_time().ns()), port,
                   std::string(object.type().name), header.seq(), cause.origin(), cause.port(), cause.seq()});
}

void ReportSender::alarm(const idl::Alarm& alarm) { send(AlarmReport{bytes_of(alarm)}); }

void ReportSender::counted(const host::RunCounters& counters, const std::vector<host::RunResult::Way>& ways) {
  send(to_tally(counters, ways));
}

void ReportSender::state_kept(const std::string& component, const host::KeptState& state) {
  send(StateKept{component, state.tag.type, state.tag.version, state.bytes});
}

void ReportSender::peer_called(const host::PeerCall& call) {
  const PeerOrder& order = call.order;
  send(PeerCalled{call.by, call.number, static_cast<PeerCalled::Act>(order.kind), order.component,
                  order.param, order.value});
}

void ReportSender::edge_damaged(const std::string& edge) { send(EdgeDamaged{edge}); }

void ReportSender::output_failed(const Error& error) { send_last(OutputFailed{error}); }

void ReportSender::show(const host::RunGlance& glance) {
  Message message = encode(Report(to_report(glance)));
  const MutexLock lock(mutex_);
  if (channel_ == nullptr || message.body == shown_) return;
  shown_ = message.body;
  (void)channel_->post(std::move(message));
}

void ReportSender::abandon(const host::RunResult& result) {
  send_last(LastWordsReport{result.error ? result.error->text() : ""});
  remove_meeting_place();
  std::_Exit(EXIT_FAILURE);
}

}  // namespace orca::supervisor
