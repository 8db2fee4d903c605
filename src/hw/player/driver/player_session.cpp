// SPDX-License-Identifier: LGPL-3.0-or-later
#include "player_session.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/hw/player/laser.hpp"
#include "orca/hw/player/payload.hpp"
#include "orca/hw/player/position2d.hpp"

namespace orca::hw::player {
namespace {

constexpr Duration kBannerTime = 2s;  // for the banner; it comes at once
constexpr Duration kAnswerTime = 1s;  // for an answer of the server, and of a driver that runs
constexpr int kMostReads = 64;        // at a time; a server that never pauses must not hold the strand
constexpr const char* kSeeServer = "what the server itself has printed says why";

std::string request_name(const MessageId& id) {
  if (id == kSetDataMode) return "to let data come by themselves";
  if (id == kListDevices) return "for its devices";
  return id == kSubscribe ? "to open " : "for the place of ";
}

}  // namespace

std::string device_name(Interface interface) {
  switch (interface) {
    case Interface::position2d: return "position2d:0";
    case Interface::sonar: return "sonar:0";
    case Interface::laser: return "laser:0";
    case Interface::bumper: return "bumper:0";
    case Interface::power: return "power:0";
    default: return "interface " + std::to_string(static_cast<std::uint32_t>(interface));
  }
}

bool PlayerRobotFacts::has(Interface interface) const { return std::ranges::count(open, interface) > 0; }

PlayerSession::PlayerSession(link::ByteLink& link, std::vector<Interface> wishes, Duration patience)
    : link_(link), wishes_(std::move(wishes)), patience_(patience) {}

Status PlayerSession::begin(TimePoint now) {
  reader_ = MessageReader(MessageReader::Side::client);
  questions_.clear();
  greeted_ = false;
  facts_ = {};
  messages_ = bad_ = 0;
  deadline_ = now + kBannerTime;
  return ok();
}

void PlayerSession::add(const MessageId& id, Interface about, std::vector<std::uint8_t> payload) {
  questions_.push_back({id, std::move(payload), about});
}

Status PlayerSession::ask(TimePoint now) {
  const Question& question = questions_.front();
  deadline_ = now + (question.id == kSubscribe ? patience_ : kAnswerTime);
  return send(question.id, question.payload);
}

Result<bool> PlayerSession::advance(TimePoint now) {
  Status taken;
  Status read = receive([&](const Message& message) {
    if (taken.ok()) taken = take(message, now);
  });
  if (!taken.ok()) return taken.error();
  if (!read.ok()) return fail(read.error().code, read.error().message, link_.name());
  if (!greeted_ && !reader_.server_version().empty()) {
    greeted_ = true;
    facts_.version = reader_.server_version();
    add(kSetDataMode, Interface::player, encode(DataMode{DataMode::Mode::push}));
    add(kListDevices, Interface::player);
    if (Status asked = ask(now); !asked.ok()) return asked.error();
  }
  if (greeted_ && questions_.empty()) return true;
  if (now < deadline_) return false;
  if (!greeted_)
    return fail(Code::not_found,
                link_.name() +
                    " is no Player server: it takes the connection but sends no banner; is this "
                    "the server's port (usually 6665), and does the server run?");
  const Question late = std::move(questions_.front());
  questions_.pop_front();
  if (Status missed = miss(late); !missed.ok()) return missed.error();
  if (questions_.empty()) return true;
  if (Status asked = ask(now); !asked.ok()) return asked.error();
  return false;
}

Status PlayerSession::receive(const Take& take) {
  std::array<std::uint8_t, 4096> bytes{};
  for (int i = 0; i < kMostReads; ++i) {
    const Result<std::size_t> count = link_.read(bytes);
    if (!count) return count.error();
    if (*count == 0) return ok();
    Status fed = reader_.feed({bytes.data(), *count}, [&](const Message& message) {
      ++messages_;
      take(message);
    });
    if (!fed.ok()) return fed;
  }
  return ok();
}

Status PlayerSession::send(const MessageId& id, std::span<const std::uint8_t> payload) {
  const auto message = make_message(header_for(id), payload);
  return message ? link_.write(*message) : Status(message.error());
}

// Data that come meanwhile are not looked at, nor answers to what was not asked.
Status PlayerSession::take(const Message& message, TimePoint now) {
  const bool is_answer = message.header.type == MessageType::ack || message.header.type == MessageType::nack;
  if (!is_answer || questions_.empty()) return ok();
  const MessageId& asked = questions_.front().id;
  if (message.header.address.interface != asked.interface || message.header.subtype != asked.subtype)
    return ok();
  if (message.header.type == MessageType::ack && is_late(message)) return ok();
  const Question question = std::move(questions_.front());
  questions_.pop_front();
  Status taken =
      message.header.type == MessageType::ack ? take_answer(question, message.payload) : refuse(question);
  if (!taken.ok() || questions_.empty()) return taken;
  return ask(now);
}

// A device that was too slow to open answers while the next one is awaited.
bool PlayerSession::is_late(const Message& message) const {
  const Question& awaited = questions_.front();
  if (awaited.id != kSubscribe) return false;
  const auto answer = decode<Subscription>(message.payload);
  return answer && answer->device.interface != awaited.about;
}

Status PlayerSession::take_answer(const Question& question, std::span<const std::uint8_t> payload) {
  if (question.id == kSetDataMode) return ok();
  if (question.id == kListDevices) return take_devices(payload);
  if (question.id == kSubscribe) return take_subscription(question.about, payload);
  return take_geometry(question, payload);
}

Status PlayerSession::take_devices(std::span<const std::uint8_t> payload) {
  const auto list = decode<DeviceList>(payload);
  if (!list) return list.error();
  const auto has = [&](Interface interface) {
    return std::ranges::any_of(list->devices, [&](const Address& device) {
      return device.interface == interface && device.index == 0;
    });
  };
  if (!has(Interface::position2d))
    return fail(Code::not_found, link_.name() +
                                     " is a Player server without a base: position2d:0 is none of its " +
                                     std::to_string(list->devices.size()) +
                                     " devices; start it with a configuration that provides one");
  std::vector<Interface> wanted{Interface::position2d};
  for (const Interface wish : wishes_) {
    if (has(wish))
      wanted.push_back(wish);
    else
      facts_.shortcomings.push_back("the server has no " + device_name(wish) +
                                    "; leave it out of \"uses\", or add it to the server's configuration");
  }
  for (const Interface device : wanted)
    add(kSubscribe, device, encode(Subscription{.device = {.interface = device}, .access = Access::open}));
  return ok();
}

Status PlayerSession::take_subscription(Interface about, std::span<const std::uint8_t> payload) {
  const auto answer = decode<Subscription>(payload);
  if (!answer) return answer.error();
  if (answer->access != Access::open)
    return go_without(about, "its driver " + in_quotes(printable(answer->driver)) +
                                 " does not start; is the device switched on and connected to the server's "
                                 "machine? " +
                                 kSeeServer);
  facts_.open.push_back(about);
  if (about == Interface::position2d) {
    facts_.driver = printable(answer->driver);
    add(kPosition2dAskGeometry, about);
  } else if (about == Interface::sonar) {
    add(kSonarAskGeometry, about);
  } else if (about == Interface::laser) {
    add(kLaserAskGeometry, about);
  }
  return ok();
}

Status PlayerSession::take_geometry(const Question& question, std::span<const std::uint8_t> payload) {
  if (question.about == Interface::sonar) {
    const auto sonars = decode<SonarGeometry>(payload);
    if (!sonars) return sonars.error();
    facts_.sonars = *sonars;
    return ok();
  }
  const auto geometry = decode<Geometry>(payload);
  if (!geometry) return geometry.error();
  (question.about == Interface::laser ? facts_.laser : facts_.base) = *geometry;
  return ok();
}

// The server says no.
Status PlayerSession::refuse(const Question& question) {
  if (question.id == kSubscribe)
    return go_without(question.about, "the server does not know it any more; " + std::string(kSeeServer));
  if (question.id == kListDevices || question.id == kSetDataMode)
    return fail(Code::unavailable, link_.name() + " refuses the request " + request_name(question.id) +
                                       "; is it a Player server of version 3?");
  return miss(question);
}

// The server says nothing. Drivers that do not know a request drop it.
Status PlayerSession::miss(const Question& question) {
  const bool is_about_place = question.id.interface != Interface::player;
  if (is_about_place) {
    facts_.shortcomings.push_back("the server does not say where " + device_name(question.about) + " is" +
                                  (question.about == Interface::sonar ? ", so the sonars are not used" : ""));
    return ok();
  }
  if (question.id == kSubscribe)
    return go_without(question.about,
                      "the server has not answered within " +
                          std::to_string(std::llround(to_seconds(patience_))) +
                          " s; a driver that takes longer to start needs a larger \"patience\"");
  return fail(Code::deadline_exceeded, link_.name() + " does not answer the request " +
                                           request_name(question.id) +
                                           "; does the server hang? Start it anew");
}

Status PlayerSession::go_without(Interface about, const std::string& why) {
  const std::string what = device_name(about) + " cannot be opened: " + why;
  if (about == Interface::position2d) return fail(Code::unavailable, what, link_.name());
  facts_.shortcomings.push_back(what);
  return ok();
}

}  // namespace orca::hw::player
