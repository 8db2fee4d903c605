// SPDX-License-Identifier: LGPL-3.0-or-later
#include "machines/clocks.hpp"

#include <algorithm>
#include <chrono>

#include "orca/idl/time.hpp"
#include "orca/xml/number.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kMemory = 60s;
constexpr std::int64_t kDrift = 10'000;  // 100 ppm: one part in so many

std::string seconds(Duration time) { return xml::number_text(to_seconds(time)) + " s"; }

// Returns a time as people want it beside an error of microseconds.
std::string rounded(Duration time) { return seconds(std::chrono::round<std::chrono::microseconds>(time)); }

// Returns whether a number from the network may be an instant: sums and differences of two do not overflow.
bool is_instant(std::int64_t ns) { return ns > 0 && ns < INT64_MAX / 4; }

}  // namespace

Duration Clocks::Sample::error(TimePoint now) const { return round_trip / 2 + (now - begun) / kDrift; }

void Clocks::hear(const idl::MachineState& state, TimePoint now) {
  Peer& peer = peers_[state.origin()];
  if (peer.run != state.run()) peer.samples.clear();
  peer.run = state.run();
  peer.said = to_time_point(state.creation_time());
  peer.heard = now;
  const auto heard = std::ranges::find_if(state.heard(), [this](const idl::MachineRun& run) {
    return run.machine() == here_ && run.run() == run_;
  });
  if (heard == state.heard().end()) return;
  const std::optional<Sample> sample = measure(state, *heard, now);
  if (!sample) return;
  keep(peer, *sample, now);
  judge(state.origin(), peer, now);
}

// The four times of NTP: mine was said at t1 and came at t2, theirs was said at t3 and came at t4.
std::optional<Clocks::Sample> Clocks::measure(const idl::MachineState& state, const idl::MachineRun& heard,
                                              TimePoint now) {
  const std::int64_t t1 = heard.said().ns();
  const std::int64_t t3 = state.creation_time().ns();
  const std::int64_t t4 = now.time_since_epoch().count();
  const Duration waited(heard.waited());
  if (!is_instant(t1) || !is_instant(t3) || waited < Duration{0} || waited > kMemory) return std::nullopt;
  const std::int64_t t2 = t3 - waited.count();
  const Duration round_trip(t4 - t1 - waited.count());
  if (round_trip < Duration{0} || Duration(t4 - t1) > kMemory) return std::nullopt;
  return Sample{Duration(((t2 - t1) + (t3 - t4)) / 2), round_trip, TimePoint(Duration(t1))};
}

void Clocks::keep(Peer& peer, const Sample& sample, TimePoint now) {
  std::deque<Sample>& samples = peer.samples;
  const Duration error = sample.error(now);
  const bool contradicts =
      !samples.empty() && abs(samples.front().ahead - sample.ahead) > samples.front().error(now) + error;
  if (contradicts) samples.clear();  // one of the clocks was set, or is pulled along by a time service
  std::erase_if(samples,
                [&](const Sample& old) { return old.error(now) >= error || now - old.begun > kMemory; });
  samples.push_back(sample);
}

void Clocks::judge(const std::string& machine, Peer& peer, TimePoint now) {
  const Sample& best = peer.samples.front();
  const Duration error = best.error(now);
  const Duration size = abs(best.ahead);
  if (!peer.differs && size > kTolerated + error) {
    peer.differs = true;
    news_.push_back({machine, true,
                     "the clock of machine " + machine + " is " + rounded(size) +
                         (best.ahead > Duration{0} ? " ahead of" : " behind") +
                         " this one's, with an error of " + rounded(error) +
                         ": instants in what comes from there are corrected by that. Let a time "
                         "service (NTP, PTP) set both clocks, and start the deployers again"});
  } else if (peer.differs && size + error < kTolerated) {
    peer.differs = false;
    news_.push_back({machine, false, "the clock of machine " + machine + " agrees with this one's again"});
  }
  if (!peer.differs)
    peer.correction = Duration{0};
  else if (abs(peer.correction - best.ahead) > error)
    peer.correction = best.ahead;
}

void Clocks::fill(idl::MachineState& state, TimePoint now) const {
  state.creation_time(to_time_value(now));
  for (idl::MachineRun& heard : state.heard()) {
    const auto peer = peers_.find(heard.machine());
    if (peer == peers_.end() || peer->second.run != heard.run()) continue;
    heard.said(to_time_value(peer->second.said));
    heard.waited((now - peer->second.heard).count());
  }
}

std::optional<Clocks::Offset> Clocks::offset(const std::string& machine, TimePoint now) const {
  const auto peer = peers_.find(machine);
  if (peer == peers_.end()) return std::nullopt;
  for (const Sample& sample : peer->second.samples)
    if (now - sample.begun <= kMemory) return Offset{sample.ahead, sample.error(now), sample.round_trip};
  return std::nullopt;
}

Duration Clocks::correction(const std::string& machine) const {
  const auto peer = peers_.find(machine);
  return peer == peers_.end() ? Duration{0} : peer->second.correction;
}

}  // namespace orca::supervisor
