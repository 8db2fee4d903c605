// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ros_frames.hpp"

#include <utility>

#include "orca/ros/cdr.hpp"

namespace orca::dds::of_ros {
namespace {

constexpr int kDepth = 100;  // as tf2 has it

RosChannel channel(const std::string& name, bool is_latched) {
  return {name,
          std::string(Reflection<ros::tf2_msgs::TFMessage>::name),
          is_latched,
          true,
          is_latched ? 1 : kDepth,
          "frames"};
}

}  // namespace

Status RosFrames::publish() {
  {
    const MutexLock lock(mutex_);
    if (moving_ != nullptr) return ok();
  }
  auto moving = participant_.make_writer(channel("/tf", false), [this] { ring(); });
  if (!moving) return moving.error();
  auto mounted = participant_.make_writer(channel("/tf_static", true), [] {});
  if (!mounted) return mounted.error();
  const MutexLock lock(mutex_);
  moving_ = std::move(moving).value();
  static_ = std::move(mounted).value();
  return ok();
}

Status RosFrames::listen() {
  if (heard_moving_ != nullptr) return ok();
  auto moving = hear("/tf", false);
  if (!moving) return moving.error();
  auto mounted = hear("/tf_static", true);
  if (!mounted) return mounted.error();
  heard_moving_ = std::move(moving).value();
  heard_static_ = std::move(mounted).value();
  return ok();
}

// A reader of this process counts as well.
bool RosFrames::are_heard() const {
  const MutexLock lock(mutex_);
  return moving_ != nullptr && moving_->readers() > (heard_moving_ == nullptr ? 0 : 1);
}

void RosFrames::add(std::weak_ptr<Bell> bell) {
  const MutexLock lock(mutex_);
  std::erase_if(bells_, [](const auto& known) { return known.expired(); });
  bells_.push_back(std::move(bell));
}

void RosFrames::ring() {
  std::vector<std::weak_ptr<Bell>> bells;
  {
    const MutexLock lock(mutex_);
    bells = bells_;
  }
  for (const std::weak_ptr<Bell>& known : bells)
    if (const std::shared_ptr<Bell> bell = known.lock()) bell->ring();
}

Result<std::unique_ptr<RosReader>> RosFrames::hear(const std::string& topic, bool is_latched) {
  return participant_.make_reader(channel(topic, is_latched), [this](std::span<const std::byte> payload) {
    ros::tf2_msgs::TFMessage message;
    if (!ros::from_cdr(payload, message).ok()) return;
    const MutexLock lock(mutex_);
    tree_.learn(message);
  });
}

void RosFrames::say(const ObjectRef& object) {
  std::shared_ptr<RosWriter> writer;
  std::optional<ros::FrameNews> news;
  {
    const MutexLock lock(mutex_);
    if (moving_ == nullptr) return;
    news = tree_.hear(object);
    if (!news) news = ros::mounts_of_ring(object);
    if (!news) return;
    writer = news->is_static ? static_ : moving_;
  }
  // Without the lock, which callbacks of DDS want as well.
  if (news->is_static) return say_static(news->message, *writer);
  writer->write(ros::to_cdr(news->message));
}

// A reader that comes later gets one message, so that one holds all.
void RosFrames::say_static(const ros::tf2_msgs::TFMessage& message, RosWriter& writer) {
  bool changed = false;
  for (const ros::geometry_msgs::TransformStamped& said : message.transforms) {
    const auto known = mounted_.find(said.child_frame_id);
    if (known != mounted_.end() && known->second.transform == said.transform) continue;
    mounted_[said.child_frame_id] = said;
    changed = true;
  }
  if (!changed) return;
  ros::tf2_msgs::TFMessage all;
  for (const auto& [child, said] : mounted_) all.transforms.push_back(said);
  writer.write(ros::to_cdr(all));
}

std::optional<idl::Frame3D> RosFrames::mount_of(const std::string& frame) const {
  const MutexLock lock(mutex_);
  return tree_.mount_of(frame);
}

std::vector<Gid> RosFrames::writers() const {
  const MutexLock lock(mutex_);
  return moving_ == nullptr ? std::vector<Gid>{} : std::vector{moving_->gid(), static_->gid()};
}

std::vector<Gid> RosFrames::readers() const {
  return heard_moving_ == nullptr ? std::vector<Gid>{}
                                  : std::vector{heard_moving_->gid(), heard_static_->gid()};
}

}  // namespace orca::dds::of_ros
