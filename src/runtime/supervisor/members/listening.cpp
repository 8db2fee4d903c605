// SPDX-License-Identifier: LGPL-3.0-or-later
#include "listening.hpp"

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "orca/base/log.hpp"

namespace orca::supervisor {
namespace {

constexpr int kMostMessages = 1000;  // of one process at a time; the others want to be heard, too

Status take_one(Member& member, const Report& report, std::uint64_t request, const TakeReport& take,
                Moment now) {
  if (const auto* answer = std::get_if<Answer>(&report)) {
    member.take_answer(request, *answer);
    return ok();
  }
  if (const auto* words = std::get_if<LastWordsReport>(&report)) {
    member.heard_last_words(words->text, now);
    return ok();
  }
  if (std::holds_alternative<Leaving>(report)) {
    member.process()->note_leaving();
    return ok();
  }
  return take(report);
}

void receive(Member& member, const TakeReport& take, Moment now) {
  Channel& channel = member.process()->channel();
  (void)channel.flush();
  for (int i = 0; i < kMostMessages; ++i) {
    Result<std::optional<Message>> message = channel.receive();
    if (!message) return member.lose_channel(now);  // as a rule because the process is just ending
    if (!message->has_value()) return;
    const std::uint64_t request = (*message)->request;
    const Result<Report> report = decode_report(std::move(**message));
    const Status taken = report ? take_one(member, *report, request, take, now) : Status(report.error());
    if (taken.ok()) continue;
    member.process()->end_by_force(Force::channel, now);
    return log::error(member.name(), "the process talks nonsense and is ended: " + taken.error().message);
  }
}

}  // namespace

bool read_output(Member& member, Moment now) {
  const std::vector<std::string> lines = member.process()->take_output();
  for (const std::string& line : lines) {
    log::info(member.name(), line);
    member.heard(line, now);
  }
  return !lines.empty();
}

bool listen(Member& member, const TakeReport& take, Moment now) {
  const bool has_printed = read_output(member, now);
  receive(member, take, now);
  return has_printed;
}

}  // namespace orca::supervisor
