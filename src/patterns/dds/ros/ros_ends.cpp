// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ros_ends.hpp"

#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/log.hpp"

namespace orca::dds::of_ros {
namespace {

constexpr Duration kPatience = 3s;  // with those who say where sensors are

}  // namespace

// --- Out --------------------------------------------------------------------------------------------------

bool RosPublication::write(const ObjectRef& object, std::size_t /*size*/, const Label& /*label*/) {
  // An object of a derived type may say more in the same message.
  const ros::Twin* const twin = ros::twin_to_ros(object.type(), twin_.message);
  if (twin == nullptr) return false;
  std::vector<std::vector<std::byte>> payloads;
  twin->to_ros(object, payloads);
  for (const std::vector<std::byte>& payload : payloads) writer().write(payload);
  frames_.say(object);
  return true;
}

std::optional<Status> SendToRos::offer(const ObjectRef& object, SendReplySink& /*reply_to*/, RequestId /*id*/,
                                       bool /*may_wait*/) {
  if (!publication_->is_latched() && !publication_->has_readers())
    return fail(Code::unavailable, "nobody reads topic " + topic_ + " of ROS 2");
  if (TopicPublication::post(publication_, object, outbox_)) return ok();
  return fail(Code::unavailable, "topic " + topic_ + " of ROS 2 takes no more: the network is slower");
}

// --- In ---------------------------------------------------------------------------------------------------

ObjectRef RosIntake::read(std::span<const std::byte> payload, TimePoint now) {
  const auto mount_of = [this](const std::string& frame) { return find_mount(frame); };
  is_mount_missing_ = false;
  Result<ObjectRef> object =
      contain_exhaustion([&]() -> Result<ObjectRef> { return twin_.from_ros(payload, mount_of, now); });
  if (!object) {
    if (!std::exchange(complained_, true))
      log::warning(user(), "a message of topic " + topic() +
                               " is dropped, and others like it without a word: " + object.error().message);
    return {};
  }
  if (is_mount_missing_ && now < opened() + kPatience) return {};  // /tf_static comes soon
  if (is_mount_missing_ && !std::exchange(warned_of_mount_, true))
    log::warning(user(), "nobody says on /tf_static where the frame '" + object->header().origin() +
                             "' of topic " + topic() +
                             " is; it is taken to be in the middle of the robot, looking ahead");
  return ring_.take(*object);
}

std::optional<idl::Frame3D> RosIntake::find_mount(const std::string& frame) {
  if (frame.empty()) return std::nullopt;
  std::optional<idl::Frame3D> mount = frames_.mount_of(frame);
  is_mount_missing_ = !mount.has_value();
  return mount;
}

void RosToSend::pass_on(ObjectRef object) {
  if (std::optional<Status> answer = target_->offer(object, *this, next_++, false)) reply(next_, *answer);
}

void RosToSend::pass_on_losses(std::uint64_t objects) {
  log::warning(user(), std::to_string(objects) + " messages of topic " + topic() +
                           " came faster than they were handled, and are lost");
}

void RosToSend::reply(RequestId /*id*/, Status answer) {
  if (answer.ok()) {
    refused_ = false;
  } else if (!refused_.exchange(true)) {
    log::warning(user(), "refuses what comes on topic " + topic() + ": " + answer.error().message);
  }
}

}  // namespace orca::dds::of_ros
