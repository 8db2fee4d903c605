// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "convert.hpp"
#include "orca/idl/time.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/twin.hpp"

namespace orca::ros {

/// What besides topics uses a twin.
enum class TwinUse {
  plain,   ///< Nothing.
  shown,   ///< Viewers and recordings.
  latched  ///< The same, and a topic's reader that comes later gets the latest message.
};

namespace detail {

// Returns the stamp of a message, or of its header; zero if it has none.
template <class Message>
builtin_interfaces::Time stamp_of(const Message& message) {
  if constexpr (requires { message.header.stamp; }) return message.header.stamp;
  if constexpr (requires { message.stamp; }) return message.stamp;
  return {};
}

// Gives a message without a stamp, as small devices send them, that of its arrival.
template <class Message>
void date(Message& message, TimePoint came) {
  if constexpr (requires { message.header.stamp; })
    if (message.header.stamp == builtin_interfaces::Time{}) message.header.stamp = to_ros_time(came);
}

// Returns the frame of a message, or of its camera.
template <class Message>
std::string frame_of(const Message& message) {
  if constexpr (std::is_same_v<Message, sensor_msgs::Image>) return camera_frame(message.header.frame_id);
  if constexpr (requires { message.header.frame_id; }) return message.header.frame_id;
  return {};
}

}  // namespace detail

/// Returns a message's stamp; if it has none, or one of the future as the sender's clock may have it, when it came.
inline TimePoint stamp_or(const builtin_interfaces::Time& stamp, TimePoint came) {
  return stamp == builtin_interfaces::Time{} ? came : std::min(to_instant(stamp), came);
}

/// Returns a twin of T, with its conversions. A null one: not in that direction.
/// @tparam to    appends the messages of an object.
/// @tparam from  fills an object from a message.
template <class T, class Message, void (*to)(const T&, TimePoint, std::vector<Message>&),
          Status (*from)(const Message&, const MountOf&, T&)>
Twin make_twin(TwinUse use) {
  Twin twin{
      object_type<T>(), Reflection<Message>::name, use != TwinUse::plain, use == TwinUse::latched, nullptr,
      nullptr};
  if constexpr (to != nullptr)
    twin.to_ros = [](const ObjectRef& object, std::vector<std::vector<std::byte>>& payloads) {
      std::vector<Message> messages;
      to(*object_cast<T>(object), object.stamp(), messages);
      for (const Message& message : messages) payloads.push_back(to_cdr(message));
    };
  if constexpr (from != nullptr)
    twin.from_ros = [](std::span<const std::byte> payload, const MountOf& mount_of,
                       TimePoint came) -> Result<ObjectRef> {
      Message message;
      if (Status read = from_cdr(payload, message); !read.ok()) return read.error();
      detail::date(message, came);
      Loan<T> object = make_object<T>();
      if (Status said = from(message, mount_of, *object); !said.ok()) return said.error();
      object->creation_time(to_time_value(stamp_or(detail::stamp_of(message), came)));
      object->origin(detail::frame_of(message));
      return std::move(object).seal().ref();
    };
  return twin;
}

void add_sensing_twins(std::vector<Twin>& twins);
void add_acting_twins(std::vector<Twin>& twins);

}  // namespace orca::ros
