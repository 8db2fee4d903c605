// SPDX-License-Identifier: LGPL-3.0-or-later
#include "senders.hpp"

#include <algorithm>

namespace orca::dds::of_team {
namespace {

constexpr Duration kSilent = 1s;          // Whoever says nothing for that long has given up his name.
constexpr Duration kWindow = 30s;         // of which the shortest way counts
constexpr std::size_t kMostSenders = 64;  // systems that are heard at a time
constexpr std::uint64_t kFourDigits = 10'000;

// Instants of others may be any numbers.
Duration difference(TimePoint later, TimePoint earlier) {
  const auto number = [](TimePoint time) {
    return static_cast<std::uint64_t>(time.time_since_epoch().count());
  };
  return Duration(static_cast<std::int64_t>(number(later) - number(earlier)));
}

}  // namespace

std::optional<Senders::Sender> Senders::note(const std::string& name, std::uint64_t run, TimePoint sent,
                                             TimePoint came) {
  forget_silent(came);
  const std::pair key{name, run};
  if (!known_.contains(key)) {
    if (known_.size() >= kMostSenders) return std::nullopt;
    Known first;
    first.name = is_taken(name) ? name + "#" + std::to_string(run % kFourDigits) : name;
    first.window = came;
    known_.emplace(key, std::move(first));
  }
  Known& sender = known_.at(key);
  sender.heard = came;
  if (came - sender.window > kWindow) {
    sender.shortest_before = std::exchange(sender.shortest, Duration::max());
    sender.window = came;
  }
  sender.shortest = std::min(sender.shortest, difference(came, sent));
  return Sender{sender.name, std::min(sender.shortest, sender.shortest_before)};
}

void Senders::forget_silent(TimePoint now) {
  std::erase_if(known_, [&](const auto& one) { return now - one.second.heard > kSilent; });
}

bool Senders::is_taken(const std::string& name) const {
  return std::ranges::any_of(known_, [&](const auto& one) { return one.second.name == name; });
}

}  // namespace orca::dds::of_team
