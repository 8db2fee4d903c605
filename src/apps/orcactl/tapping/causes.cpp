// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "causes.hpp"

#include <algorithm>
#include <utility>

namespace orca::orcactl {
namespace {

constexpr std::size_t kLongestWay = 32;  // [ports]

}  // namespace

ObjectId id_of(const idl::OrcaObject& object) {
  return {object.origin() + "." + object.origin_port(), object.seq()};
}

ObjectId cause_of(const idl::OrcaObject& object) {
  const idl::Cause& cause = object.cause();
  if (cause.origin().empty()) return {};
  return {cause.origin() + "." + cause.port(), cause.seq()};
}

void Causes::note_beginning(const ObjectId& object, std::uint64_t sensed) { keep(object, {{}, sensed}); }

void Causes::note(const ObjectId& object, const ObjectId& cause) { keep(object, {cause, std::nullopt}); }

void Causes::keep(const ObjectId& object, Known known) {
  if (!known_.try_emplace(object, std::move(known)).second) return;
  order_.push_back(object);
  if (order_.size() <= kMostObjects) return;
  known_.erase(order_.front());
  order_.pop_front();
}

Causes::Way Causes::way_to(ObjectId object) const {
  Way way;
  while (!object.port.empty() && way.ports.size() < kLongestWay) {
    const auto found = known_.find(object);
    way.complete = found != known_.end();
    if (!way.complete) break;
    way.ports.push_back(object.port);
    way.sensed = found->second.sensed;
    if (way.sensed) break;
    object = found->second.cause;
  }
  std::ranges::reverse(way.ports);
  return way;
}

std::string Causes::Way::text() const {
  std::string text = complete ? "" : "?";
  for (const std::string& port : ports) text += (text.empty() ? "" : " > ") + port;
  return text;
}

}  // namespace orca::orcactl
