// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "foxglove/ros_messages.hpp"

#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <type_traits>

#include "answers.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/generated/messages.hpp"
#include "orca/ros/twin.hpp"
#include "orca/text/object_xml.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

// Reads a message from JSON. Numbers that are not there are NaN; texts and lists may be left out.
class JsonReader {
 public:
  explicit JsonReader(const json& from) : from_(from) {}

  template <class T>
  void field(const FieldInfo& info, T& value) {
    const std::string name(info.name);
    read(from_.is_object() && from_.contains(name) ? from_.at(name) : json(), value);
  }

 private:
  template <class T>
  void read(const json& from, T& value) {
    if constexpr (ReflectedStruct<T>) {
      JsonReader inner(from);
      Reflection<T>::fields(value, inner);
    } else if constexpr (std::is_same_v<T, double>) {
      value = from.is_number() ? from.get<double>() : std::numeric_limits<double>::quiet_NaN();
    } else if constexpr (std::is_same_v<T, std::string>) {
      if (from.is_string()) value = from.get<std::string>();
    }
  }

  const json& from_;
};

template <class Message>
Status decode(std::string_view encoding, const std::string& bytes, Message& message) {
  if (encoding == "cdr") return ros::from_cdr(std::as_bytes(std::span(bytes)), message);
  const json from = read_json(bytes);
  JsonReader reader(from);
  Reflection<Message>::fields(message, reader);
  return ok();
}

// Returns the object that a message says, for the port that takes it.
// @tparam T  the port's type.
template <class T, class Message>
Result<Published> published(const char* port_end, std::string_view encoding, const std::string& bytes) {
  Message message;
  if (const Status read = decode(encoding, bytes, message); !read.ok())
    return fail(Code::data_loss,
                "the bytes are no " + std::string(Reflection<Message>::name) + ": " + read.error().text());
  // A viewer's clock is none of the system's, which may run in virtual time.
  if constexpr (requires { message.header.stamp; }) message.header.stamp = {};
  const ros::Twin& twin = *ros::twin_from_ros(object_type<T>(), Reflection<Message>::name);
  const Result<ObjectRef> object = twin.from_ros(ros::to_cdr(message), {}, {});
  if (!object) return object.error();
  ObjectLoan fresh = copy_value(*object);
  fresh.header().origin("");
  return Published{port_end, to_xml(std::move(fresh).seal())};
}

}  // namespace

Result<Published> read_ros_message(std::string_view type, std::string_view encoding,
                                   const std::string& bytes) {
  namespace msg = ros::geometry_msgs;
  if (encoding != "cdr" && encoding != "json")
    return fail(Code::unimplemented, "messages are read as cdr or json, not as " + std::string(encoding));
  const std::string_view name =
      type.starts_with("geometry_msgs/") ? type.substr(type.rfind('/') + 1) : std::string_view();
  if (name == "PoseStamped")
    return published<idl::GoalPoint, msg::PoseStamped>(".GotoCoordinateSend", encoding, bytes);
  if (name == "PoseWithCovarianceStamped")
    return published<idl::RobotPose, msg::PoseWithCovarianceStamped>(".RobotPoseSend", encoding, bytes);
  if (name == "Twist") return published<idl::MotionCommand, msg::Twist>(".MotionSend", encoding, bytes);
  if (name == "TwistStamped")
    return published<idl::MotionCommand, msg::TwistStamped>(".MotionSend", encoding, bytes);
  return fail(
      Code::unimplemented,
      "a robot takes geometry_msgs PoseStamped, PoseWithCovarianceStamped, Twist and TwistStamped, not " +
          std::string(type));
}

}  // namespace orca::view
