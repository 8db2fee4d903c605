// SPDX-License-Identifier: LGPL-3.0-or-later
#include "decide.hpp"

#include <algorithm>
#include <optional>

namespace orca::fuse {
namespace {

// Returns a behaviour that must be heard and is not; null if there is none.
const std::string* silent(std::span<const Voice> voices, const Rules& rules) {
  for (const Voice& voice : voices)
    if (voice.lost || voice.age > voice.silence_limit) return &voice.name;
  for (const std::string& name : rules.required)
    if (std::none_of(voices.begin(), voices.end(), [&](const Voice& voice) { return voice.name == name; }))
      return &name;
  return nullptr;
}

std::vector<std::size_t> those_with_wishes(std::span<const Voice> voices, double max_age) {
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < voices.size(); ++i)
    if (voices[i].said == Voice::Said::wish && voices[i].age <= max_age && voices[i].wish.weight > 0.0)
      indices.push_back(i);
  return indices;
}

Decision only(std::span<const Voice> voices, std::size_t chosen) {
  std::vector<double> shares(voices.size(), 0.0);
  shares[chosen] = 1.0;
  return {Verdict::fused, voices[chosen].wish, std::move(shares), voices[chosen].name};
}

Fused fuse(std::span<const Wish> wishes, const Rules& rules, double last_rate) {
  switch (rules.mode) {
    case Mode::vote: return vote(wishes, rules.ballot, last_rate);
    case Mode::vector_sum: return sum_vectors(wishes, rules.ballot.steer_gain);
    default: return fuse_weighted(wishes, rules.ballot.steer_gain);
  }
}

Decision blend(std::span<const Voice> voices, const std::vector<std::size_t>& chosen, const Rules& rules,
               double last_rate) {
  std::vector<Wish> wishes;
  for (const std::size_t i : chosen) wishes.push_back(voices[i].wish);
  Fused fused = fuse(wishes, rules, last_rate);
  Decision decision{Verdict::fused, fused.command, std::vector<double>(voices.size(), 0.0), {}};
  std::size_t largest = 0;
  for (std::size_t j = 0; j < chosen.size(); ++j) {
    decision.shares[chosen[j]] = fused.shares[j];
    decision.command.left += fused.agreement * fused.shares[j] * wishes[j].left;
    if (fused.shares[j] > fused.shares[largest]) largest = j;
  }
  decision.decided_by = voices[chosen[largest]].name;
  return decision;
}

Decision by_priority(std::span<const Voice> voices, const std::vector<std::size_t>& chosen,
                     const std::vector<std::string>& order) {
  std::vector<Voice> candidates;
  for (const std::size_t i : chosen) candidates.push_back(voices[i]);
  return only(voices, chosen[first_in_order(candidates, order)]);
}

}  // namespace

Mode mode_of(std::string_view text) {
  return static_cast<Mode>(std::find(kModes.begin(), kModes.end(), text) - kModes.begin());
}

Decision decide(std::span<const Voice> voices, const Rules& rules, double last_rate) {
  Decision decision;
  decision.shares.assign(voices.size(), 0.0);
  for (const Voice& voice : voices)
    if (voice.said == Voice::Said::full_stop && voice.age <= rules.max_age)
      return {Verdict::told_to_stop, {}, std::move(decision.shares), voice.name};
  if (const std::string* name = silent(voices, rules))
    return {Verdict::required_silent, {}, std::move(decision.shares), *name};
  if (rules.mode == Mode::subsumption) {
    const std::optional<std::size_t> chosen = subsume(voices, rules.wiring);
    return chosen ? only(voices, *chosen) : decision;
  }
  const std::vector<std::size_t> chosen = those_with_wishes(voices, rules.max_age);
  if (chosen.empty()) return decision;
  if (rules.mode == Mode::priority) return by_priority(voices, chosen, rules.order);
  return blend(voices, chosen, rules, last_rate);
}

}  // namespace orca::fuse
