// SPDX-License-Identifier: GPL-3.0-or-later
// Any object, whatever its fields are, becomes messages of ROS 2 that can be read, or none. The first byte chooses the type; the rest is
// the payload.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <vector>

#include "orca/idl/object.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/frame_tree.hpp"
#include "orca/ros/range_ring.hpp"
#include "orca/ros/twin.hpp"

namespace {

using namespace orca;

void check(bool holds) {
  if (!holds) std::abort();
}

void try_frames(ros::FrameTree& frames, const ObjectRef& object) {
  for (const auto& news : {frames.hear(object), ros::mounts_of_ring(object)}) {
    if (!news) continue;
    ros::tf2_msgs::TFMessage again;
    check(ros::from_cdr(ros::to_cdr(news->message), again).ok());
    frames.learn(again);
    for (const auto& said : again.transforms) (void)frames.mount_of(said.child_frame_id);
  }
}

void try_twin(const ros::Twin& twin, const ObjectRef& object) {
  std::vector<std::vector<std::byte>> payloads;
  twin.to_ros(object, payloads);
  if (twin.from_ros == nullptr) return;
  ros::RangeRing ring;
  for (const auto& payload : payloads) {
    const auto back = twin.from_ros(payload, {}, object.stamp());
    if (back) (void)ring.take(*back);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const auto types = object_types();
  const ObjectType& type = *types[data[0] % types.size()];
  ObjectLoan loan = make_object(type);
  if (!type.deserialize(std::as_bytes(std::span(data + 1, size - 1)), loan.get()).ok()) return 0;
  const ObjectRef object = std::move(loan).seal();
  ros::FrameTree frames;
  try_frames(frames, object);
  try_frames(frames, object);  // there is odometry now
  for (const ros::Twin& twin : ros::twins())
    if (twin.to_ros != nullptr && is_a(type, twin.object)) try_twin(twin, object);
  const auto shown = ros::ros_twin(object);
  check(!shown || !shown->payload.empty());
  return 0;
}
