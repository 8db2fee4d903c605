// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report_sender.hpp"

#include <cstdlib>
#include <utility>
#include <vector>

#include "orca/idl/object_type.hpp"
#include "tallying.hpp"

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

ReportSender::ReportSender(Channel& channel, log::Level level)
    : channel_(channel), log_([this, level](const log::Line& line) {
        if (line.level < level) return;
        send(Logged{line.level, std::string(line.who), std::string(line.text)});
      }) {}

void ReportSender::send(Report report, std::uint64_t request) {
  (void)channel_.post(encode(std::move(report), request));  // without the supervisor nobody is left to tell
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
  send(MissionStep{header.mission(), static_cast<std::uint64_t>(header.creation_time().ns()), port,
                   std::string(object.type().name), header.seq(), header.cause().origin(),
                   header.cause().seq()});
}

void ReportSender::alarm(const idl::Alarm& alarm) { send(AlarmReport{bytes_of(alarm)}); }

void ReportSender::counted(const host::RunCounters& counters, const std::vector<host::RunResult::Way>& ways) {
  send(to_tally(counters, ways));
}

// The last thing that a process says, so it waits until it is said.
void ReportSender::output_failed(const Error& error) {
  (void)channel_.send(encode(Report(OutputFailed{error})), kLastLimit);
}

void ReportSender::show(const host::RunGlance& glance) {
  Message message = encode(Report(to_report(glance)));
  if (message.body == shown_) return;
  shown_ = message.body;
  (void)channel_.post(std::move(message));
}

void ReportSender::abandon(const host::RunResult& result) {
  (void)channel_.send(encode(Report(LastWordsReport{result.error ? result.error->text() : ""})), kLastLimit);
  std::_Exit(EXIT_FAILURE);
}

}  // namespace orca::supervisor
