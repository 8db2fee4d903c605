// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for topics_fuzz into a folder: for each kind of topic what others say there, and on /tf_static where they are.
#include <cstddef>
#include <fstream>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "filled_object.hpp"
#include "orca/idl/machines.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/generated/messages.hpp"
#include "topic_kinds.hpp"

namespace {

using namespace orca;
using Bytes = std::vector<std::byte>;

constexpr char kTopic = 0;
constexpr char kMoving = 2;
constexpr char kStatic = 3;

void add(std::ofstream& file, char topic, std::span<const std::byte> fields) {
  file.put(topic).put(static_cast<char>(fields.size() % 256)).put(static_cast<char>(fields.size() / 256));
  file.write(reinterpret_cast<const char*>(fields.data()), static_cast<std::streamsize>(fields.size()));
}

std::span<const std::byte> fields_of(const Bytes& payload) {
  return std::span(payload).subspan(ros::kEncapsulation);
}

Bytes frames(const std::string& parent, const std::string& child) {
  ros::geometry_msgs::TransformStamped said;
  said.header.frame_id = parent;
  said.child_frame_id = child;
  said.transform.rotation.w = 1.0;
  return ros::to_cdr(ros::tf2_msgs::TFMessage{{said}});
}

// Returns what a system of a team sends.
Bytes team_object(const ObjectLoan& object) {
  idl::TeamObject sent;
  sent.origin("bert");
  sent.run(3);
  sent.type(object.type().layout_hash);
  Bytes content;
  object.type().serialize(object.get(), content);
  for (const std::byte one : content) sent.content().push_back(std::to_integer<std::uint8_t>(one));
  Bytes fields;
  object_type<idl::TeamObject>().serialize(&sent, fields);
  return fields;
}

void write_seed(const std::string& path, std::size_t choice, const test::TopicKind& kind) {
  std::ofstream file(path, std::ios::binary);
  file.put(static_cast<char>(choice));
  ObjectLoan object = test::filled_object(kind.object);
  if (kind.twin == nullptr) return add(file, kTopic, team_object(object));
  object.header().origin("laser");
  std::vector<Bytes> payloads;
  const ros::Twin* const back = ros::twin_to_ros(kind.object, kind.twin->message);
  if (back != nullptr) back->to_ros(std::move(object).seal(), payloads);
  add(file, kStatic, fields_of(frames("base_link", "laser")));
  add(file, kMoving, fields_of(frames("odom", "base_link")));
  for (const Bytes& payload : payloads) add(file, kTopic, fields_of(payload));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: topics_seeds FOLDER\n";
    return 2;
  }
  const auto& kinds = test::topic_kinds();
  for (std::size_t i = 0; i < 2 * kinds.size(); ++i) {
    const test::TopicKind& kind = kinds[i % kinds.size()];
    if (i < kinds.size() || kind.twin != nullptr)
      write_seed(std::string(argv[1]) + "/" + std::to_string(i), i, kind);
  }
  return 0;
}
