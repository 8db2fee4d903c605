// SPDX-License-Identifier: LGPL-3.0-or-later
#include "losses.hpp"

#include <algorithm>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/last_words.hpp"
#include "taking_down.hpp"

namespace orca::supervisor {

bool runs_an_end(const graph::Graph& graph, const Member& member) {
  return std::ranges::any_of(graph.ends, [&](const std::string& name) {
    return graph.find_component(name)->process == member.name();
  });
}

void Losses::ended(Member& member, const ExitReason& reason) {
  const bool unasked = member.phase() != Member::Phase::going_down;
  const std::string words = member.last_words(Moment::clock::now());
  const std::string how =
      reason.text() +
      (words.empty() ? "; it ran " + listed(place_.starter.components_of(member)) : ": " + words);
  lose(member, how,
       {.is_normal = reason.is_normal(),
        .is_unasked = unasked,
        .had_come_up = member.has_come_up(),
        .counts = !words.starts_with(host::kNetworkCode)});
}

void Losses::could_not_start(Member& member, const Error& error) {
  lose(member, "could not be started: " + error.message,
       {.is_normal = false, .is_unasked = true, .had_come_up = false});
}

void Losses::lose(Member& member, const std::string& how, const Loss& loss) {
  place_.beats.forget(member.place());
  place_.control.lose(member);  // before its orders are answered by its end
  member.forget();
  place_.ledger.lose(member.name(), "its process " + how);
  for (const Wiring::Outer& outer : place_.starter.wiring().edges_at(member.name())) cut(outer, member, how);
  const std::string text = "process " + member.name() + " " + how;
  host::Conclusion& conclusion = place_.conclusion;
  if (conclusion.is_over()) return lose_late(text, loss);
  if (!place_.policy.is_dozing(member.index())) place_.control.distrust(member);
  if (place_.renewal.lose(member, loss.is_normal, how)) return;
  if (loss.is_unasked) place_.ledger.raise(idl::PROCESS_ENDED, member.name(), text);
  if (!conclusion.has_come_up()) return conclusion.fail_with(fail(Code::unavailable, text));
  const RestartDecision decision =
      place_.policy.ended(member.index(), loss.is_normal, Moment::clock::now(), loss.counts);
  if (place_.policy.has_finished(member.index()) && !decision.gives_up && runs_an_end(place_.graph, member))
    return conclusion.fail_with(fail(Code::unavailable, text));
  obey(decision, text);
  if (place_.policy.is_asleep(member.index())) place_.on_demand.fall_asleep(member);
}

// A process that is lost while all is taken down spoils the run, unless it was only on its way back.
void Losses::lose_late(const std::string& text, const Loss& loss) {
  if (loss.is_normal || place_.stop.is_urgent()) return;
  if (place_.conclusion.has_come_up() && !loss.had_come_up)
    return log::warning(place_.log_name, text + "; it had not come back yet when the run ended");
  log::error(place_.log_name, text);
  place_.conclusion.fail_late(fail(Code::unavailable, text));
}

void Losses::cut(const Wiring::Outer& outer, const Member& lost, const std::string& how) {
  const std::string& there = outer.from == lost.name() ? outer.to : outer.from;
  Member* const other = place_.roster.find(there);  // it may be on another machine
  if (other != nullptr) other->tell(CutEdge{outer.name, "process " + lost.name() + " " + how});
}

void Losses::obey(const RestartDecision& decision, const std::string& text) {
  if (decision.gives_up) {
    place_.ledger.raise(idl::GAVE_UP, "", text + "; there were too many restarts, so the run ends");
    return place_.conclusion.fail_with(fail(Code::unavailable, text));
  }
  for (const std::size_t index : decision.end) end(*place_.roster.all()[index]);
}

void Losses::end(Member& member, bool keeps_states) {
  if (member.process() == nullptr) return;
  place_.beats.forget(member.place());
  member.end(
      Moment::clock::now(), kHurry, [](const Status&) {}, keeps_states);
}

}  // namespace orca::supervisor
