// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/ros/twin.hpp"

#include <algorithm>
#include <utility>

#include "twin_making.hpp"

namespace orca::ros {
namespace {

// Returns whether a twin's message is the one that is wanted.
bool is_wanted(const Twin& twin, std::string_view message) {
  return message.empty() || twin.message == message;
}

}  // namespace

std::span<const Twin> twins() {
  static const std::vector<Twin> all = [] {
    std::vector<Twin> made;
    add_sensing_twins(made);
    add_acting_twins(made);
    return made;
  }();
  return all;
}

const Twin* twin_to_ros(const ObjectType& type, std::string_view message) {
  const auto twin = std::ranges::find_if(twins(), [&](const Twin& known) {
    return known.to_ros != nullptr && is_wanted(known, message) && is_a(type, known.object);
  });
  return twin == twins().end() ? nullptr : &*twin;
}

const Twin* twin_from_ros(const ObjectType& type, std::string_view message) {
  const auto find = [&](const auto& fits) {
    const auto twin = std::ranges::find_if(twins(), [&](const Twin& known) {
      return known.from_ros != nullptr && is_wanted(known, message) && fits(known.object);
    });
    return twin == twins().end() ? nullptr : &*twin;
  };
  if (const Twin* const exact = find([&](const ObjectType& known) { return &known == &type; })) return exact;
  return find([&](const ObjectType& known) { return is_a(known, type); });
}

std::optional<RosMessage> ros_twin(const ObjectRef& object) {
  for (const Twin& twin : twins()) {
    if (!twin.is_shown || !is_a(object.type(), twin.object)) continue;
    std::vector<std::vector<std::byte>> payloads;
    twin.to_ros(object, payloads);
    return RosMessage{twin.message, std::move(payloads.front())};
  }
  return std::nullopt;
}

}  // namespace orca::ros
