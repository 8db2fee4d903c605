// SPDX-License-Identifier: LGPL-3.0-or-later
#include "where.hpp"

#include <chrono>
#include <cstdio>
#include <numbers>
#include <utility>

#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::teleop {
namespace {

constexpr Duration kPatience = std::chrono::seconds(2);

std::string text_of(const idl::Odometry& odometry) {
  const Pose2 pose = plane_pose(odometry);
  char text[96];
  std::snprintf(text, sizeof text, "position %.2f m, %.2f m, heading %.0f deg by odometry", pose.x, pose.y,
                pose.yaw * 180.0 / std::numbers::pi);
  return text;
}

}  // namespace

void Where::ask(TimePoint now) {
  if (since_) return;
  since_ = now;
  trouble_ = port_.connected() ? "no answer" : "the graph does not connect the port odometry";
}

std::optional<std::string> Where::look(TimePoint now) {
  if (!since_) return std::nullopt;
  if (!question_) send();
  const auto answer = question_ ? port_.query_receive(*question_) : std::nullopt;
  if (answer) question_.reset();
  if (answer && *answer) return answered(text_of(***answer));
  if (answer) trouble_ = answer->error().message;  // the next reading may be new enough
  if (now - *since_ > kPatience) return answered("the position is not known: " + trouble_);
  return std::nullopt;
}

void Where::send() {
  auto ask = port_.loan();
  ask->since(to_time_value(*since_));
  const Result<QueryId> sent = port_.query_request(std::move(ask));
  if (sent) question_ = *sent;
  if (!sent && port_.connected()) trouble_ = sent.error().message;
}

std::string Where::answered(std::string text) {
  forget();
  return text;
}

void Where::forget() {
  since_.reset();
  if (question_) port_.query_forget(*question_);
  question_.reset();
}

}  // namespace orca::teleop
