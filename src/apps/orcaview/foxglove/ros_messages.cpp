// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "foxglove/ros_messages.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "answers.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/text/object_xml.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

// Reads CDR, little-endian. After its end all numbers are NaN.
class CdrNumbers {
 public:
  explicit CdrNumbers(const std::string& bytes) : bytes_(bytes) {}

  void skip_header() {
    at_ += 2 * sizeof(std::uint32_t);  // the time
    const auto length = read<std::uint32_t>();
    at_ = length > bytes_.size() ? bytes_.size() : at_ + length;
  }
  double number() {
    if (is_over_) return std::nan("");
    return read<double>();
  }

 private:
  template <class Number>
  Number read() {
    constexpr std::size_t kSize = sizeof(Number);
    at_ = (at_ + kSize - 1) / kSize * kSize;
    Number number{};
    is_over_ = is_over_ || at_ + kSize + kEncapsulation > bytes_.size();
    if (is_over_) return sizeof(Number) == sizeof(double) ? static_cast<Number>(std::nan("")) : Number{};
    std::memcpy(&number, bytes_.data() + kEncapsulation + at_, kSize);
    at_ += kSize;
    return number;
  }

  static constexpr std::size_t kEncapsulation = 4;
  const std::string& bytes_;
  std::size_t at_ = 0;  // after the encapsulation
  bool is_over_ = false;
};

// A message type, and where its numbers are in JSON.
struct Kind {
  bool has_header = false;
  std::vector<const char*> paths{};
};

const std::map<std::string_view, Kind>& kinds() {
  static const std::map<std::string_view, Kind> all{
      {"Twist", {false, {"/linear/x", "/linear/y", "/linear/z", "/angular/x", "/angular/y", "/angular/z"}}},
      {"TwistStamped",
       {true,
        {"/twist/linear/x", "/twist/linear/y", "/twist/linear/z", "/twist/angular/x", "/twist/angular/y",
         "/twist/angular/z"}}},
      {"PoseStamped",
       {true,
        {"/pose/position/x", "/pose/position/y", "/pose/position/z", "/pose/orientation/x",
         "/pose/orientation/y", "/pose/orientation/z", "/pose/orientation/w"}}},
      {"PoseWithCovarianceStamped",
       {true,
        {"/pose/pose/position/x", "/pose/pose/position/y", "/pose/pose/position/z",
         "/pose/pose/orientation/x", "/pose/pose/orientation/y", "/pose/pose/orientation/z",
         "/pose/pose/orientation/w"}}}};
  return all;
}

std::vector<double> numbers_of(const Kind& kind, bool is_cdr, const std::string& bytes) {
  std::vector<double> numbers;
  if (is_cdr) {
    CdrNumbers cdr(bytes);
    if (kind.has_header) cdr.skip_header();
    for (std::size_t i = 0; i < kind.paths.size(); ++i) numbers.push_back(cdr.number());
    return numbers;
  }
  const json message = read_json(bytes);
  for (const char* const path : kind.paths) {
    const json::json_pointer place(path);
    const bool is_there = message.is_object() && message.contains(place) && message.at(place).is_number();
    numbers.push_back(is_there ? message.at(place).get<double>() : std::nan(""));
  }
  return numbers;
}

double yaw_of(const std::vector<double>& n) {  // a quaternion in 3 to 6: x, y, z, w
  return portable::atan2(2.0 * (n[6] * n[5] + n[3] * n[4]), 1.0 - 2.0 * (n[4] * n[4] + n[5] * n[5]));
}

Published goal(const std::vector<double>& n) {
  auto object = make_object<idl::GoalPoint>();
  object->name("viewer");
  object->coordinate().point().x(n[0]);
  object->coordinate().point().y(n[1]);
  constexpr double kReach = 0.2;  // [m]
  object->reach_radius().distance(kReach);
  object->use_orientation(true);
  object->orientation().orientation().yaw(yaw_of(n));
  constexpr double kReachAngle = 0.2;  // [rad]
  object->reach_angle(kReachAngle);
  return {".GotoCoordinateSend", to_xml(std::move(object).seal())};
}

Published place(const std::vector<double>& n) {
  auto object = make_object<idl::RobotPose>();
  object->x(n[0]);
  object->y(n[1]);
  object->orientation(yaw_of(n));
  return {".RobotPoseSend", to_xml(std::move(object).seal())};
}

Published drive(const std::vector<double>& n) {
  auto object = make_object<idl::MotionCommand>();
  object->kind(idl::NORMAL);
  object->steering(idl::BY_TURN_RATE);
  object->speed(n[0]);
  object->turn_rate(n[5]);
  return {".MotionSend", to_xml(std::move(object).seal())};
}

}  // namespace

Result<Published> read_ros_message(std::string_view type, std::string_view encoding,
                                   const std::string& bytes) {
  if (encoding != "cdr" && encoding != "json")
    return fail(Code::unimplemented, "messages are read as cdr or json, not as " + std::string(encoding));
  const std::string_view name = type.substr(type.rfind('/') + 1);
  const auto kind = kinds().find(name);
  if (!type.starts_with("geometry_msgs/") || kind == kinds().end())
    return fail(
        Code::unimplemented,
        "a robot takes geometry_msgs PoseStamped, PoseWithCovarianceStamped, Twist and TwistStamped, not " +
            std::string(type));
  if (encoding == "cdr" && !bytes.starts_with(std::string_view("\0\1", 2)))
    return fail(Code::data_loss, "the bytes are no plain CDR with the least byte first");
  const std::vector<double> numbers = numbers_of(kind->second, encoding == "cdr", bytes);
  for (const double number : numbers)
    if (!std::isfinite(number))
      return fail(Code::data_loss, "the bytes are no " + std::string(type) + ", or a number in it is none");
  if (name == "PoseStamped") return goal(numbers);
  if (name == "PoseWithCovarianceStamped") return place(numbers);
  return drive(numbers);
}

}  // namespace orca::view
