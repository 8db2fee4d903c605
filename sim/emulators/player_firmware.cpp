// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/emulators/player_firmware.hpp"

#include <utility>

#include "player_robot.hpp"
#include "player_wire.hpp"

namespace orca::emulators {
namespace {

constexpr std::size_t kBannerBytes = 32;  // [bytes]
// 127.0.0.1, as a server writes it.
constexpr std::uint32_t kLoopback = 0x0100007F;
constexpr std::uint32_t kAccessOpen = 1;
constexpr std::uint32_t kAccessClose = 2;
constexpr std::uint32_t kAccessRefused = 3;
constexpr std::uint32_t kPullMode = 2;
constexpr std::uint32_t kAskCapability = 255;

PlayerWriter written_address(std::uint32_t port, const PlayerAddress& address) {
  PlayerWriter out;
  out.word(kLoopback).word(port).word(address.interface).word(address.index);
  return out;
}

// In a payload.
PlayerAddress read_address(std::span<const std::uint8_t> payload) {
  return {player_word(payload, 8), player_word(payload, 12)};
}

const std::string& driver_of(const PlayerSettings& settings, std::uint32_t device) {
  return device == kPlayerLaser ? settings.laser_driver : settings.base_driver;
}

}  // namespace

PlayerFirmware::PlayerFirmware(Body& body, PlayerSettings settings, const Mirror* mirror)
    : PlayerFirmware(std::make_shared<PlayerRobot>(body, mirror, std::move(settings))) {}

PlayerFirmware::PlayerFirmware(std::shared_ptr<PlayerRobot> robot)
    : robot_(std::move(robot)), settings_(robot_->settings()) {}

PlayerFirmware::~PlayerFirmware() = default;

std::unique_ptr<Firmware> PlayerFirmware::for_another_host() {
  return std::unique_ptr<Firmware>(new PlayerFirmware(robot_));
}

bool PlayerFirmware::has_power() const { return robot_->has_power(); }

void PlayerFirmware::note_host(bool is_there, TimePoint now) {
  if (is_there == has_host_) return;
  has_host_ = is_there;
  if (is_there)
    connect(now);
  else
    disconnect();
}

void PlayerFirmware::connect(TimePoint now) {
  disconnect();
  greet_at_ = now + settings_.accept_time;
}

void PlayerFirmware::disconnect() {
  while (!open_.empty()) close(*open_.begin());
  greet_at_.reset();
  connected_ = pulls_ = asked_ = false;
  heard_.clear();
  waiting_.clear();
  out_.clear();
  queue_.clear();
}

void PlayerFirmware::reset(TimePoint now) {
  connect(now);
  robot_->define({});
}

void PlayerFirmware::greet() {
  greet_at_.reset();
  connected_ = true;
  ++connections_;
  std::string text = settings_.banner.empty() ? "Player v." + settings_.version : settings_.banner;
  text.resize(kBannerBytes);
  out_.insert(out_.end(), text.begin(), text.end());
}

void PlayerFirmware::take(Bytes bytes, std::uint32_t /*baud*/, TimePoint now) {
  now_ = now;
  if (!connected_) greet();
  heard_.insert(heard_.end(), bytes.begin(), bytes.end());
  while (heard_.size() >= kPlayerHeader) {
    const PlayerHeader header = read_player_header(heard_);
    if (header.type < kPlayerData || header.type > kPlayerNack || header.size > kPlayerLongest) {
      heard_.clear();
      ++dropped_;
      return;
    }
    const std::size_t size = kPlayerHeader + header.size;
    if (heard_.size() < size) return;
    obey(Bytes(heard_).first(size));
    heard_.erase(heard_.begin(), heard_.begin() + static_cast<std::ptrdiff_t>(size));
  }
}

void PlayerFirmware::obey(Bytes message) {
  const PlayerHeader header = read_player_header(message);
  const Bytes payload = message.subspan(kPlayerHeader);
  if (header.interface == kPlayerServer && header.index == 0 && header.type == kPlayerRequest)
    return serve(header, payload);
  const std::optional<std::uint32_t> device = robot_->device_at({header.interface, header.index});
  if (!device || !open_.contains(*device) || settings_.silent.contains(*device)) {
    ++dropped_;
  } else if (is_starting(*device)) {
    waiting_.emplace_back(message.begin(), message.end());
  } else if (header.type == kPlayerRequest && header.subtype == kAskCapability) {
    const bool knows = robot_->knows(*device, player_word(payload, 0), player_word(payload, 4));
    answer(header, knows ? kPlayerAck : kPlayerNack, {});
  } else if (header.type == kPlayerRequest) {
    ask(*device, header, payload);
  } else if (header.type != kPlayerCommand || *device != kPlayerPosition ||
             !robot_->command(header.subtype, payload)) {
    ++dropped_;
  }
}

// Its driver's queue holds what comes until it has started.
bool PlayerFirmware::is_starting(std::uint32_t device) const {
  const auto takes = settings_.starting.find(device);
  return takes != settings_.starting.end() && now_ - opened_at_.at(device) < takes->second;
}

void PlayerFirmware::ask(std::uint32_t device, const PlayerHeader& header, Bytes payload) {
  const auto reply = robot_->request(device, header.subtype, payload);
  answer(header, reply ? kPlayerAck : kPlayerNack, reply.value_or(std::vector<std::uint8_t>{}));
}

// The device that is the server itself.
void PlayerFirmware::serve(const PlayerHeader& header, Bytes payload) {
  if (settings_.silent.contains(kPlayerServer)) return;
  switch (header.subtype) {
    case 1: return list_devices(header);
    case 2: return tell_driver(header, payload);
    case 3: return subscribe(header, payload);
    case 4: return give_data(header);
    case 5: return set_data_mode(header, payload);
    case 10: return answer(header, kPlayerAck, {});  // the newest data replace older ones in any case
    default: return answer(header, kPlayerNack, {});
  }
}

void PlayerFirmware::list_devices(const PlayerHeader& header) {
  const std::vector<std::uint32_t> all = robot_->devices();
  PlayerWriter list;
  list.count(all.size());
  for (const std::uint32_t device : all) {
    const PlayerAddress address = robot_->address_of(device);
    list.word(kLoopback).word(settings_.port).word(address.interface).word(address.index);
  }
  answer(header, kPlayerAck, list.bytes());
}

void PlayerFirmware::tell_driver(const PlayerHeader& header, Bytes payload) {
  const std::optional<std::uint32_t> device = robot_->device_at(read_address(payload));
  if (!device) return answer(header, kPlayerNack, {});
  PlayerWriter out = written_address(settings_.port, read_address(payload));
  answer(header, kPlayerAck, out.text(driver_of(settings_, *device)).bytes());
}

void PlayerFirmware::subscribe(const PlayerHeader& header, Bytes payload) {
  const std::optional<std::uint32_t> device = robot_->device_at(read_address(payload));
  std::uint32_t access = player_word(payload, 16);
  if (!device) return answer(header, kPlayerNack, {});
  if (access == kAccessClose)
    close(*device);
  else if (access != kAccessOpen || settings_.refused.contains(*device))
    access = kAccessRefused;
  else if (open_.empty())
    next_cycle_ = now_ + settings_.cycle;
  if (access == kAccessOpen && open_.insert(*device).second) {
    robot_->open(*device);
    opened_at_[*device] = now_;
    if (*device == kPlayerLaser) scans_ = robot_->scans();
  }
  PlayerWriter out = written_address(settings_.port, read_address(payload));
  answer(header, kPlayerAck, out.word(access).text(driver_of(settings_, *device)).bytes());
}

void PlayerFirmware::close(std::uint32_t device) {
  if (open_.erase(device) > 0) robot_->close(device);
  queue_.erase(device);
}

void PlayerFirmware::set_data_mode(const PlayerHeader& header, Bytes payload) {
  const std::uint32_t mode = player_word(payload, 0);
  if (mode < 1 || mode > kPullMode) return answer(header, kPlayerNack, {});
  pulls_ = mode == kPullMode;
  asked_ = false;
  queue_.clear();
  answer(header, kPlayerAck, {});
}

void PlayerFirmware::give_data(const PlayerHeader& header) {
  answer(header, kPlayerAck, {});
  asked_ = true;
  end_round();
}

// A round that has no data yet waits for some.
void PlayerFirmware::end_round() {
  if (!asked_ || queue_.empty()) return;
  asked_ = false;
  for (const auto& [device, payload] : std::exchange(queue_, {})) send_data(device, payload);
  send({.interface = kPlayerServer, .type = kPlayerSynch, .subtype = 1}, {});
}

std::vector<std::uint8_t> PlayerFirmware::advance(TimePoint now) {
  now_ = now;
  if (greet_at_ && now >= *greet_at_) greet();
  for (const std::vector<std::uint8_t>& message : std::exchange(waiting_, {})) obey(message);
  for (; !open_.empty() && now >= next_cycle_; next_cycle_ += settings_.cycle)
    for (const std::uint32_t device : open_)
      if (device != kPlayerLaser && !is_starting(device)) publish(device, robot_->data(device));
  if (open_.contains(kPlayerLaser)) {
    robot_->look(now);
    if (scans_ != robot_->scans()) publish(kPlayerLaser, robot_->scan());
    scans_ = robot_->scans();
  }
  end_round();
  return std::exchange(out_, {});
}

void PlayerFirmware::publish(std::uint32_t device, Bytes payload) {
  if (pulls_)
    queue_[device].assign(payload.begin(), payload.end());
  else
    send_data(device, payload);
}

void PlayerFirmware::send_data(std::uint32_t device, Bytes payload) {
  const PlayerAddress address = robot_->address_of(device);
  send({.interface = address.interface, .index = address.index, .type = kPlayerData, .subtype = 1}, payload);
}

void PlayerFirmware::answer(const PlayerHeader& header, std::uint32_t type, Bytes payload) {
  PlayerHeader reply = header;
  reply.type = type;
  send(reply, payload);
}

void PlayerFirmware::send(const PlayerHeader& header, Bytes payload) {
  PlayerWriter out = written_address(settings_.port, {header.interface, header.index});
  out.word(header.type).word(header.subtype).real(to_seconds(now_));
  out.word(header.sequence).word(static_cast<std::uint32_t>(payload.size()));
  out_.insert(out_.end(), out.bytes().begin(), out.bytes().end());
  out_.insert(out_.end(), payload.begin(), payload.end());
}

}  // namespace orca::emulators
