// SPDX-License-Identifier: LGPL-3.0-or-later
#include "player_session.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/hw/player/payload.hpp"
#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "ranger_view.hpp"

namespace orca::hw::player {
namespace {

constexpr Duration kBannerTime = 2s;  // for the banner; it comes at once
constexpr Duration kAnswerTime = 1s;  // for an answer of the server itself
constexpr int kMostReads = 64;        // at a time; a server that never pauses must not hold the strand
constexpr const char* kSeeServer = "what the server itself has printed says why";

std::string request_name(const MessageId& id) {
  if (id == kSetDataMode) return "to let data come by themselves";
  if (id == kListDevices) return "for its devices";
  return id == kSubscribe ? "to open " : "for the place of ";
}

// Sonars and lasers that are not there may be rangers.
std::string missing(const Use& wish, const std::vector<Address>& devices) {
  std::string rangers;
  for (const Address& device : devices)
    if (device.interface == Interface::ranger)
      rangers += (rangers.empty() ? "" : ", ") + device_name({wish.part, Interface::ranger, device.index});
  const std::string what = "the server has no " + device_name(wish) + "; ";
  const bool may_be_ranger = wish.part == Part::sonar || wish.part == Part::laser;
  if (may_be_ranger && !rangers.empty())
    return what + "it has " + rangers + ": if one of them is meant, write e.g. " +
           (wish.part == Part::sonar ? "sonar" : "laser") + "=ranger:0 in \"uses\"";
  return what + "leave it out of \"uses\", or add it to the server's configuration";
}

}  // namespace

PlayerSession::PlayerSession(link::ByteLink& link, std::vector<Use> wishes, Duration patience)
    : link_(link), wishes_(std::move(wishes)), patience_(patience) {}

Status PlayerSession::begin(TimePoint now) {
  reader_ = MessageReader(MessageReader::Side::client);
  questions_.clear();
  late_.clear();
  places_due_.reset();
  greeted_ = false;
  facts_ = {};
  messages_ = bad_ = 0;
  deadline_ = now + kBannerTime;
  return ok();
}

Status PlayerSession::ask(TimePoint now) {
  const Question& question = questions_.front();
  deadline_ = now + (question.id == kSubscribe ? patience_ : kAnswerTime);
  if (question.is_about_place()) {
    if (!places_due_) places_due_ = now + patience_;
    deadline_ = std::max(deadline_, *places_due_);
  }
  return send(question.id, question.payload, question.index());
}

Result<bool> PlayerSession::advance(TimePoint now) {
  Status taken;
  Status read = receive(now, [&](const Message& message, TimePoint) {
    if (taken.ok()) taken = take(message, now);
  });
  if (!taken.ok()) return taken.error();
  if (!read.ok()) return fail(read.error().code, read.error().message, link_.name());
  if (!greeted_ && !reader_.server_version().empty()) {
    greeted_ = true;
    facts_.version = reader_.server_version();
    questions_.push_back({kSetDataMode, encode(DataMode{DataMode::Mode::push})});
    questions_.push_back({kListDevices, {}});
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

Status PlayerSession::receive(TimePoint now, const Take& take) {
  std::array<std::uint8_t, 4096> bytes{};
  for (int i = 0; i < kMostReads; ++i) {
    const Result<std::size_t> count = link_.read(bytes);
    if (!count) return count.error();
    if (*count == 0) return ok();
    if (reader_.waiting() == 0) begun_ = now;
    Status fed = reader_.feed({bytes.data(), *count}, [&](const Message& message) {
      ++messages_;
      take(message, std::exchange(begun_, now));
    });
    if (!fed.ok()) return fed;
  }
  return ok();
}

Status PlayerSession::send(const MessageId& id, std::span<const std::uint8_t> payload, std::uint32_t index) {
  const auto message = make_message(header_for(id, index), payload);
  return message ? link_.write(*message) : Status(message.error());
}

// Data that come meanwhile are not looked at, nor answers to what was not asked.
Status PlayerSession::take(const Message& message, TimePoint now) {
  const bool is_answer = message.header.type == MessageType::ack || message.header.type == MessageType::nack;
  if (!is_answer || questions_.empty()) return ok();
  const MessageId& asked = questions_.front().id;
  const Address& from = message.header.address;
  if (from.interface != asked.interface || from.index != questions_.front().index() ||
      message.header.subtype != asked.subtype)
    return ok();
  if (message.header.type == MessageType::ack && is_late(message)) return ok();
  const Question question = std::move(questions_.front());
  questions_.pop_front();
  Status taken =
      message.header.type == MessageType::ack ? take_answer(question, message.payload) : refuse(question);
  if (!taken.ok() || questions_.empty()) return taken;
  return ask(now);
}

bool PlayerSession::take_late(const Message& message) {
  const Header& header = message.header;
  const bool is_answer = header.type == MessageType::ack || header.type == MessageType::nack;
  if (!is_answer) return false;
  const auto asked = std::ranges::find_if(late_, [&](const Question& question) {
    return question.id.interface == header.address.interface && question.index() == header.address.index &&
           question.id.subtype == header.subtype;
  });
  if (asked == late_.end()) return false;
  const Question question = *asked;
  late_.erase(asked);
  return header.type == MessageType::ack && take_answer(question, message.payload).ok();
}

// A device that was too slow to open answers while the next one is awaited.
bool PlayerSession::is_late(const Message& message) const {
  const Question& awaited = questions_.front();
  if (awaited.id != kSubscribe) return false;
  const auto answer = decode<Subscription>(message.payload);
  return answer &&
         (answer->device.interface != awaited.about.interface || answer->device.index != awaited.about.index);
}

Status PlayerSession::take_answer(const Question& question, std::span<const std::uint8_t> payload) {
  if (question.id == kSetDataMode) return ok();
  if (question.id == kListDevices) return take_devices(payload);
  if (question.id == kSubscribe) return take_subscription(question.about, payload);
  if (question.id.interface == Interface::ranger) return take_ranger(question, payload);
  return take_geometry(question, payload);
}

Status PlayerSession::take_devices(std::span<const std::uint8_t> payload) {
  const auto list = decode<DeviceList>(payload);
  if (!list) return list.error();
  for (const Use& wish : wishes_) {
    const bool has = std::ranges::any_of(list->devices, [&](const Address& device) {
      return device.interface == wish.interface && device.index == wish.index;
    });
    if (!has && wish.part == Part::base)
      return fail(Code::not_found, link_.name() + " is a Player server without a base: " + device_name(wish) +
                                       " is none of its " + std::to_string(list->devices.size()) +
                                       " devices; start it with a configuration that provides one");
    const Address device{.interface = wish.interface, .index = wish.index};
    if (has)
      questions_.push_back(
          {kSubscribe, encode(Subscription{.device = device, .access = Access::open}), wish});
    else
      facts_.shortcomings.push_back(missing(wish, list->devices));
  }
  return ok();
}

Status PlayerSession::take_subscription(const Use& about, std::span<const std::uint8_t> payload) {
  const auto answer = decode<Subscription>(payload);
  if (!answer) return answer.error();
  if (answer->access != Access::open)
    return go_without(about, "its driver " + in_quotes(printable(answer->driver)) +
                                 " does not start; is the device switched on and connected to the server's "
                                 "machine? " +
                                 kSeeServer);
  if (about.part == Part::base) facts_.driver = printable(answer->driver);
  ask_place(about);
  return ok();
}

// And of a laser that is a ranger, between which angles it sees.
void PlayerSession::ask_place(const Use& device) {
  switch (device.interface) {
    case Interface::position2d: questions_.push_back({kPosition2dAskGeometry, {}, device}); break;
    case Interface::sonar: questions_.push_back({kSonarAskGeometry, {}, device}); break;
    case Interface::laser: questions_.push_back({kLaserAskGeometry, {}, device}); break;
    case Interface::ranger:
      questions_.push_back({kRangerAskGeometry, {}, device});
      if (device.part == Part::laser) questions_.push_back({kRangerAskConfig, {}, device});
      break;
    default: break;  // it does not matter where the others are
  }
}

Status PlayerSession::take_ranger(const Question& question, std::span<const std::uint8_t> payload) {
  if (question.id == kRangerAskConfig) {
    const auto config = decode<RangerConfig>(payload);
    if (!config) return config.error();
    facts_.angles = *config;
    return ok();
  }
  const auto geometry = decode<RangerGeometry>(payload);
  if (!geometry) return geometry.error();
  if (question.about.part == Part::sonar)
    facts_.sonars = as_sonar(*geometry);
  else
    facts_.laser = Geometry{geometry->pose, geometry->size};
  return ok();
}

Status PlayerSession::take_geometry(const Question& question, std::span<const std::uint8_t> payload) {
  if (question.about.part == Part::sonar) {
    const auto sonars = decode<SonarGeometry>(payload);
    if (!sonars) return sonars.error();
    facts_.sonars = *sonars;
    return ok();
  }
  const auto geometry = decode<Geometry>(payload);
  if (!geometry) return geometry.error();
  (question.about.part == Part::laser ? facts_.laser : facts_.base) = *geometry;
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

// The server says nothing. Drivers that do not know a request drop it, and drivers that still start answer later.
Status PlayerSession::miss(const Question& question) {
  if (question.is_about_place()) late_.push_back(question);
  if (question.id == kRangerAskConfig) {
    facts_.shortcomings.push_back("the server does not say between which angles " +
                                  device_name(question.about) + " sees; those of \"laser_angle\" are taken");
    return ok();
  }
  if (question.is_about_place()) {
    const bool is_sonar = question.about.part == Part::sonar;
    facts_.shortcomings.push_back("the server does not say where " + device_name(question.about) + " is" +
                                  (is_sonar ? ", so the sonars are not used until it does" : ""));
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

Status PlayerSession::go_without(const Use& about, const std::string& why) {
  const std::string what = device_name(about) + " cannot be opened: " + why;
  if (about.part == Part::base) return fail(Code::unavailable, what, link_.name());
  facts_.shortcomings.push_back(what);
  return ok();
}

}  // namespace orca::hw::player
