// SPDX-License-Identifier: LGPL-3.0-or-later
#include "client_session.hpp"

#include <cmath>

#include "orca/hw/player/message.hpp"
#include "orca/hw/player/payload.hpp"
#include "orca/hw/player/session.hpp"

namespace orca::player_server {
namespace {

using namespace hw::player;

constexpr std::size_t kMostUnread = 256 * 1024;        // [bytes] until a client is sent no new data
constexpr std::size_t kMostAnswers = 4 * 1024 * 1024;  // and until it is given up
constexpr const char* kDriver = "orca";

Pose2 pose_of(const Planar& planar) { return {planar.x, planar.y, planar.yaw}; }

DeviceName name_of(const Address& address) { return {address.interface, address.index}; }

bool is_finite_twist(const Planar& planar) {
  return std::isfinite(planar.x) && std::isfinite(planar.y) && std::isfinite(planar.yaw);
}

}  // namespace

ClientSession::ClientSession(const RobotFace& face, Address address) : face_(face), address_(address) {
  const auto banner = make_banner("3.1.0-orca");
  output_.assign(banner.begin(), banner.end());
}

Status ClientSession::take(std::span<const std::uint8_t> bytes, TimePoint now) {
  Status read = reader_.feed(bytes, [&](const Message& message) { obey(message, now); });
  if (!read.ok()) return read;
  if (output_.size() > kMostAnswers) return fail(Code::unavailable, "it asks and does not read the answers");
  return ok();
}

void ClientSession::obey(const Message& message, TimePoint now) {
  if (message.header.type == MessageType::command) return command(message, now);
  if (message.header.type == MessageType::request) return answer(message);
}

// Only velocities are carried out. A command that cannot be understood is dropped, as a server of Player does. The client hears nothing of
// that, so the log says it.
void ClientSession::command(const Message& message, TimePoint now) {
  const MessageId id = id_of(message.header);
  if (!uses(kBase) || id != kPosition2dVelocity) return note_dropped(id);
  const Result<VelocityCommand> wanted = decode<VelocityCommand>(message.payload);
  if (!wanted || !is_finite_twist(wanted->velocity)) return;
  wish_.reset();
  if (motors_on_ && wanted->motors_on)
    wish_ = Wish{{wanted->velocity.x, wanted->velocity.y, wanted->velocity.yaw}, now};
}

void ClientSession::note_dropped(const MessageId& id) {
  constexpr std::size_t kMostRemarks = 4;
  const std::string what = id == kPosition2dVelocity
                               ? "velocities without having subscribed to position2d:0"
                               : "what is not carried out (interface " +
                                     std::to_string(static_cast<unsigned>(id.interface)) + ", command " +
                                     std::to_string(id.subtype) + "): only velocities of position2d are";
  if (remarks_.size() < kMostRemarks && remarks_.insert(what).second) remark_ = "it commands " + what;
}

void ClientSession::answer(const Message& message) {
  if (message.header.address.interface == Interface::player) return answer_server(message);
  if (!has(message.header.address)) return;
  if (message.header.subtype == 255) {
    const Result<Capability> asked = decode<Capability>(message.payload);
    const MessageId id{message.header.address.interface,
                       asked ? static_cast<MessageType>(asked->type) : MessageType::nack,
                       asked ? asked->subtype : 0};
    return knows(id) ? accept(message.header) : refuse(message.header);
  }
  answer_device(message);
}

void ClientSession::answer_server(const Message& message) {
  const Header& header = message.header;
  const MessageId id = id_of(header);
  if (id == kListDevices) {
    DeviceList list;
    for (const DeviceName& device : face_.devices())
      list.devices.push_back({address_.host, address_.robot, device.interface, device.index});
    return accept(header, encode(list));
  }
  if (id == kAskDriver) return tell_driver(message);
  if (id == kSubscribe) return subscribe(message);
  if (id == kAskData) return begin_round(header);
  if (id == kAddReplaceRule) return accept(header);  // the newest replaces others in any case
  if (id != kSetDataMode) return refuse(header);
  const Result<DataMode> mode = decode<DataMode>(message.payload);
  if (!mode) return refuse(header);
  pulls_ = mode->mode == DataMode::Mode::pull;
  asked_ = false;
  accept(header);
}

void ClientSession::tell_driver(const Message& message) {
  Result<DriverInfo> asked = decode<DriverInfo>(message.payload);
  if (!asked || !has(asked->device)) return refuse(message.header);
  asked->driver = kDriver;
  accept(message.header, encode(*asked));
}

void ClientSession::subscribe(const Message& message) {
  Result<Subscription> wish = decode<Subscription>(message.payload);
  if (!wish || !has(wish->device)) return refuse(message.header);
  const DeviceName device = name_of(wish->device);
  if (wish->access == Access::open) {
    uses_.insert(device);
  } else {
    uses_.erase(device);
    fresh_.erase(device);
    if (device == kBase) wish_.reset();
  }
  wish->device.host = address_.host;
  wish->device.robot = address_.robot;
  wish->driver = kDriver;
  accept(message.header, encode(*wish));
}

void ClientSession::begin_round(const Header& request) {
  accept(request);
  asked_ = true;
  end_round();
}

// Sends the news of each device, and the synch that a client waits for. A round without anything new waits, as a server of Player does.
void ClientSession::end_round() {
  if (!asked_ || fresh_.empty()) return;
  asked_ = false;
  for (const auto& [device, stamp] : std::exchange(fresh_, {})) send_data(device, stamp);
  send({.address = {.interface = Interface::player}, .type = MessageType::synch, .subtype = kSynch.subtype});
}

void ClientSession::answer_device(const Message& message) {
  const Header& header = message.header;
  const MessageId id = id_of(header);
  if (id == kPosition2dAskGeometry) return accept(header, encode(Geometry{.size = face_.size}));
  if (id == kSonarAskGeometry) return accept(header, encode(face_.sonar_poses));
  if (id == kLaserAskGeometry) return accept(header, encode(Geometry{.pose = face_.laser_pose}));
  if (id == kLaserAskConfig) return accept(header, encode(face_.laser_config));
  if (answer_ranger(message)) return;
  const bool is_done = id == kSonarPower || id == kPosition2dVelocityMode ||
                       (id == kPosition2dMotorPower && switch_motors(message.payload)) ||
                       (id == kPosition2dResetOdometry && set_odometry(Planar{})) ||
                       (id == kPosition2dSetOdometry && set_odometry(decode<Planar>(message.payload)));
  return is_done ? accept(header) : refuse(header);
}

bool ClientSession::answer_ranger(const Message& message) {
  const Header& header = message.header;
  const MessageId id = id_of(header);
  if (id == kRangerAskGeometry)
    accept(header, encode(face_.ranger_geometry(name_of(header.address))));
  else if (id == kRangerAskConfig)
    accept(header, encode(face_.ranger_config(name_of(header.address))));
  else
    return false;
  return true;
}

bool ClientSession::switch_motors(Payload payload) {
  const Result<Switch> power = decode<Switch>(payload);
  if (!power) return false;
  motors_on_ = power->on;
  if (!motors_on_) wish_.reset();
  return true;
}

bool ClientSession::set_odometry(const Result<Planar>& wanted) {
  if (!wanted || !is_finite_twist(*wanted)) return false;
  const Pose2 here = face_.state ? pose_of(face_.state->pose) : Pose2{};
  origin_ = pose_of(*wanted) * inverse(here);
  return true;
}

bool ClientSession::knows(const MessageId& id) const {
  static constexpr MessageId kAll[] = {kPosition2dState,
                                       kPosition2dVelocity,
                                       kPosition2dAskGeometry,
                                       kPosition2dMotorPower,
                                       kPosition2dSetOdometry,
                                       kPosition2dResetOdometry,
                                       kPosition2dVelocityMode,
                                       kSonarRanges,
                                       kSonarAskGeometry,
                                       kSonarPower,
                                       kLaserScan,
                                       kLaserAskGeometry,
                                       kLaserAskConfig,
                                       kRangerRanges,
                                       kRangerAskGeometry,
                                       kRangerAskConfig};
  for (const MessageId& known : kAll)
    if (known == id) return true;
  return false;
}

bool ClientSession::has(const Address& device) const {
  for (const DeviceName& offered : face_.devices())
    if (offered == name_of(device)) return true;
  return false;
}

void ClientSession::offer(const DeviceName& device, double stamp) {
  if (!uses(device)) return;
  fresh_[device] = stamp;
  end_round();
  if (pulls_ || output_.size() > kMostUnread) return;
  for (const auto& [waiting, since] : std::exchange(fresh_, {})) send_data(waiting, since);
}

Planar ClientSession::shown_pose() const {
  const Pose2 pose = origin_ * pose_of(face_.state->pose);
  return {pose.x, pose.y, pose.yaw};
}

std::optional<std::vector<std::uint8_t>> ClientSession::data_of(const DeviceName& device) const {
  if (device == kBase && face_.state) {
    Position2dState state = *face_.state;
    state.pose = shown_pose();
    return encode(state);
  }
  if (device == kSonar && face_.sonar) return encode(*face_.sonar);
  if (device == kLaser && face_.scan) return encode(*face_.scan);
  if (device.interface != Interface::ranger) return std::nullopt;
  const auto values = face_.ranger_values(device);
  return values ? std::optional(encode(*values)) : std::nullopt;
}

void ClientSession::send_data(const DeviceName& device, double stamp) {
  if (const auto data = data_of(device))
    send({.address = {.interface = device.interface, .index = device.index},
          .type = MessageType::data,
          .subtype = 1,
          .time = stamp},
         *data);
}

void ClientSession::accept(const Header& request, Payload payload) {
  send(answer_to(request, MessageType::ack), payload);
}

void ClientSession::refuse(const Header& request) { send(answer_to(request, MessageType::nack)); }

void ClientSession::send(Header header, Payload payload) {
  header.address.host = address_.host;
  header.address.robot = address_.robot;
  const auto message = make_message(header, payload);
  if (message) output_.insert(output_.end(), message->begin(), message->end());
}

}  // namespace orca::player_server
