// SPDX-License-Identifier: LGPL-3.0-or-later
#include "arbitration.hpp"

#include <algorithm>

namespace orca::fuse {
namespace {

using Line = std::optional<std::size_t>;  // whose wish it carries

std::string trim(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool has_fresh_wish(const Voice& voice, double max_age) {
  return voice.said == Voice::Said::wish && voice.age <= max_age && voice.wish.weight > 0.0;
}

Line find(std::span<const Voice> voices, const std::string& name) {
  for (std::size_t i = 0; i < voices.size(); ++i)
    if (voices[i].name == name) return i;
  return std::nullopt;
}

bool suppresses(const Wiring& wiring, const std::string& name) {
  return std::any_of(wiring.suppress.begin(), wiring.suppress.end(),
                     [&](const Node& node) { return node.higher == name; });
}

// Calls act(higher, lower) for each node if the fuser listens to both its ends.
template <class Act>
void for_each_node(std::span<const Voice> voices, const std::vector<Node>& nodes, Act act) {
  for (const Node& node : nodes) {
    const Line higher = find(voices, node.higher);
    const Line lower = find(voices, node.lower);
    if (higher && lower) act(*higher, *lower);
  }
}

}  // namespace

std::optional<Node> parse_node(const std::string& text) {
  const auto mark = text.find('>');
  if (mark == std::string::npos) return std::nullopt;
  const Node node{trim(text.substr(0, mark)), trim(text.substr(mark + 1))};
  if (node.higher.empty() || node.lower.empty() || node.higher == node.lower) return std::nullopt;
  return node;
}

std::size_t first_in_order(std::span<const Voice> voices, const std::vector<std::string>& order) {
  for (const std::string& name : order)
    if (const Line found = find(voices, name)) return *found;
  return 0;
}

std::optional<std::size_t> subsume(std::span<const Voice> voices, const Wiring& wiring) {
  const auto acts = [&](std::size_t i) {
    return has_fresh_wish(voices[i], wiring.max_age) || voices[i].wish_age <= wiring.hold;
  };
  std::vector<Line> lines(voices.size());
  for (std::size_t i = 0; i < voices.size(); ++i)
    if (has_fresh_wish(voices[i], wiring.max_age)) lines[i] = i;
  for_each_node(voices, wiring.suppress, [&](std::size_t higher, std::size_t lower) {
    if (lines[higher] || acts(higher)) lines[lower] = lines[higher].value_or(higher);
  });
  for_each_node(voices, wiring.inhibit, [&](std::size_t higher, std::size_t lower) {
    if (acts(higher)) lines[lower].reset();
  });
  for (std::size_t i = 0; i < voices.size(); ++i)
    if (lines[i] && !suppresses(wiring, voices[i].name)) return lines[i];
  return std::nullopt;
}

}  // namespace orca::fuse
