// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/emulators/sick_lms_firmware.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "orca/emulators/firmware.hpp"
#include "orca/hw/framing/checksums.hpp"
#include "sick_lms_scan.hpp"

namespace orca::emulators {
namespace {

using hw::framing::Finding;

constexpr std::size_t kLongestPayload = 812;
constexpr std::size_t kConfigurationSize = 34;
constexpr std::size_t kAvailability = 4;  // offsets in the configuration
constexpr std::size_t kMeasuringMode = 5;
constexpr std::size_t kUnit = 6;
constexpr std::size_t kStatusSize = 151;   // of the answer to 31, without the last byte
constexpr Duration kLongestGap = 100ms;    // within a telegram
constexpr std::uint8_t kOnRequest = 0x25;  // modes
constexpr std::uint8_t kAllScans = 0x24;
constexpr std::uint8_t kRange = 0x27;
constexpr std::uint8_t kInstallation = 0x00;
constexpr std::uint8_t kDiagnosis = 0x10;
constexpr std::uint8_t kDone = 0;  // answers to a request for a mode
constexpr std::uint8_t kRefused = 1;

// Start 02, address 00, number of bytes up to the check word, those bytes, check word.
Finding find_telegram(std::span<const std::uint8_t> bytes) {
  if (bytes[0] != 0x02) return {};
  if (bytes.size() < 4) return {Finding::Kind::need_more};
  const std::size_t length = bytes[2] + 256U * bytes[3];
  if (bytes[1] != 0x00 || length < 1 || length > kLongestPayload) return {};
  if (bytes.size() < length + 6) return {Finding::Kind::need_more};
  const unsigned check = bytes[length + 4] + 256U * bytes[length + 5];
  if (hw::framing::crc_of_pairs(bytes.first(length + 4)) != check) return {Finding::Kind::bad_checksum};
  return {Finding::Kind::frame, length + 6};
}

unsigned word_at(std::span<const std::uint8_t> bytes, std::size_t index) {
  return bytes[index] + 256U * bytes[index + 1];
}

void put(std::vector<std::uint8_t>& bytes, std::size_t at, std::string_view text) {
  std::ranges::copy(text, bytes.begin() + static_cast<std::ptrdiff_t>(at));
}

// Returns the rate that a mode byte asks for; 0: it is another mode.
std::uint32_t rate_of(std::uint8_t mode) {
  switch (mode) {
    case 0x40: return 38400;
    case 0x41: return 19200;
    case 0x42: return 9600;
    case 0x48: return 500000;
    default: return 0;
  }
}

bool has_variant(unsigned angle, unsigned resolution) {
  if (resolution == 25) return angle == 100;
  return (resolution == 50 || resolution == 100) && (angle == 100 || angle == 180);
}

}  // namespace

SickLmsFirmware::SickLmsFirmware(Mirror& mirror, SickLmsSettings settings)
    : mirror_(mirror),
      settings_(std::move(settings)),
      configuration_(kConfigurationSize),
      scanner_({.look = find_telegram, .longest = kLongestPayload + 6}),
      baud_(settings_.baud),
      angle_(settings_.angle),
      resolution_(settings_.resolution) {
  configuration_[kMeasuringMode] = settings_.measuring_mode;
  configuration_[kUnit] = settings_.unit;
}

void SickLmsFirmware::reset(TimePoint now) {
  line_.clear();
  left_.clear();
  switch_on(now);
}

void SickLmsFirmware::switch_on(TimePoint now) {
  change_.reset();
  scanner_.give_up([](const hw::framing::Frame&) {});
  baud_ = settings_.baud;
  angle_ = settings_.angle;
  resolution_ = settings_.resolution;
  mode_ = kOnRequest;
  scan_wanted_ = ready_ = false;
  ready_at_ = now + settings_.power_up;
}

void SickLmsFirmware::take(Bytes bytes, std::uint32_t baud, TimePoint now) {
  go_on(now);
  host_baud_ = baud;
  if (!ready_ || (baud != 0 && baud != baud_)) return;  // it sees other bits, and no telegram
  last_byte_ = now;
  constexpr std::array<std::uint8_t, 1> kNak{0x15};
  for (const std::uint8_t byte : bytes) {
    const std::uint64_t before = scanner_.statistics().bad_checksums;
    scanner_.feed({&byte, 1}, [&](const hw::framing::Frame& frame) {
      obey(frame.bytes.subspan(4, frame.bytes.size() - 6), now);
    });
    if (settings_.acknowledges && scanner_.statistics().bad_checksums > before) send(kNak, now);
  }
}

std::vector<std::uint8_t> SickLmsFirmware::advance(TimePoint now) {
  go_on(now);
  return std::exchange(left_, {});
}

void SickLmsFirmware::go_on(TimePoint now) {
  if (!ready_at_) switch_on(now);
  if (change_ && now >= change_->at) {
    let_out(change_->at);
    const Change change = *std::exchange(change_, std::nullopt);
    if (change.baud == 0)
      switch_on(change.at);
    else
      baud_ = change.baud;
  }
  if (scanner_.waiting() > 0 && now - last_byte_ > kLongestGap)
    scanner_.give_up(
        [&](const hw::framing::Frame& frame) { obey(frame.bytes.subspan(4, frame.bytes.size() - 6), now); });
  if (!ready_ && now >= *ready_at_) {
    ready_ = true;
    next_scan_ = *ready_at_ + scan_time();
    std::vector<std::uint8_t> announcement{0x90};
    announcement.insert(announcement.end(), settings_.type.begin(), settings_.type.end());
    answer(std::move(announcement), *ready_at_);
  }
  if (ready_) turn_mirror(now);
  let_out(now);
}

void SickLmsFirmware::let_out(TimePoint now) {
  const std::vector<std::uint8_t> bytes = line_.leave(now, host_baud_ == 0 || host_baud_ == baud_);
  left_.insert(left_.end(), bytes.begin(), bytes.end());
}

// The last measured scan goes out when the line is free; the others are left out.
void SickLmsFirmware::turn_mirror(TimePoint now) {
  for (; now >= next_scan_; next_scan_ += scan_time()) {
    turns_ = static_cast<std::uint8_t>(turns_ + 100 / resolution_);
    if ((sends_scans() || scan_wanted_) && !change_ && line_.idle_at() <= next_scan_) send_scan(next_scan_);
  }
}

void SickLmsFirmware::obey(Bytes payload, TimePoint now) {
  note_command(commands_, payload[0]);
  constexpr std::array<std::uint8_t, 1> kAck{0x06};
  if (settings_.acknowledges) send(kAck, now);
  const Bytes data = payload.subspan(1);
  std::vector<std::uint8_t> text{0xBA};
  switch (payload[0]) {
    case 0x10:
      answer({0x91}, now);
      change_ = {.at = line_.idle_at()};
      return;
    case 0x20: return choose_mode(data, now);
    case 0x30:
      if (data.size() != 1 || data[0] != 1 || mode_ != kOnRequest) break;
      scan_wanted_ = true;  // the next one that is measured
      return;
    case 0x31: return send_status(now);
    case 0x32: return answer({0xB2}, now);  // it has no errors
    case 0x3A:
      text.insert(text.end(), settings_.type.begin(), settings_.type.end());
      return answer(std::move(text), now);
    case 0x3B:
      if (data.size() != 4) break;
      return choose_variant(data, now);
    case 0x74:
      text = {0xF4};
      text.insert(text.end(), configuration_.begin(), configuration_.end());
      return answer(std::move(text), now);
    case 0x77: return write(data, now);
    default: break;
  }
  answer({0x92}, now);
}

void SickLmsFirmware::choose_mode(Bytes data, TimePoint now) {
  constexpr std::array<std::uint8_t, 5> kModes{kInstallation, kDiagnosis, kAllScans, kOnRequest, kRange};
  if (data.empty()) return answer({0x92}, now);
  if (const std::uint32_t baud = rate_of(data[0]); baud != 0) return change_rate(baud, now);
  if (std::ranges::find(kModes, data[0]) == kModes.end()) return answer({0x92}, now);
  const bool entered = enter(data[0], data.subspan(1));
  if (entered) mode_ = data[0];
  answer({0xA0, entered ? kDone : kRefused}, now);
}

bool SickLmsFirmware::enter(std::uint8_t mode, Bytes parameters) {
  if (mode == kInstallation) return std::ranges::equal(parameters, settings_.password);
  if (mode != kRange) return true;
  if (parameters.size() < 4) return false;
  const unsigned first = word_at(parameters, 0);
  const unsigned last = word_at(parameters, 2);
  if (first < 1 || last < first || last > beams()) return false;
  first_ = first;
  last_ = last;
  return true;
}

// The answer comes at the old rate.
void SickLmsFirmware::change_rate(std::uint32_t baud, TimePoint now) {
  const bool possible = std::ranges::find(settings_.rates, baud) != settings_.rates.end();
  answer({0xA0, possible ? kDone : kRefused}, now);
  if (possible) change_ = {.at = line_.idle_at(), .baud = baud};
}

void SickLmsFirmware::choose_variant(Bytes data, TimePoint now) {
  const bool possible = !sends_scans() && has_variant(word_at(data, 0), word_at(data, 2));
  if (possible) {
    angle_ = word_at(data, 0);
    resolution_ = word_at(data, 2);
    next_scan_ = now + scan_time();
  }
  std::vector<std::uint8_t> payload{0xBB, static_cast<std::uint8_t>(possible ? 1 : 0)};
  append_u16(payload, angle_);
  append_u16(payload, resolution_);
  answer(std::move(payload), now);
}

// What the host leaves out stays as it is.
void SickLmsFirmware::write(Bytes block, TimePoint now) {
  const bool possible = mode_ == kInstallation && is_possible(block);
  if (possible) {
    std::ranges::copy(block, configuration_.begin());
    ++writes_;
  }
  std::vector<std::uint8_t> payload{0xF7, static_cast<std::uint8_t>(possible ? 1 : 0)};
  payload.insert(payload.end(), configuration_.begin(), configuration_.end());
  answer(std::move(payload), possible ? now + settings_.write_time : now);
}

bool SickLmsFirmware::is_possible(Bytes block) const {
  if (block.empty() || block.size() > configuration_.size()) return false;
  if (block.size() > kMeasuringMode && distance_mask(block[kMeasuringMode]) == 0) return false;
  return block.size() <= kUnit || block[kUnit] <= 2;
}

void SickLmsFirmware::send_scan(TimePoint now) {
  const std::optional<MirrorTurn> turn = mirror_.last_turn();
  if (!turn) return;
  scan_wanted_ = false;
  LmsBeams beams{.angle = angle_, .resolution = resolution_, .first = 1, .last = this->beams()};
  std::vector<std::uint8_t> payload{0xB0};
  if (mode_ == kRange) {
    payload = {0xB7};
    beams.last = std::min(last_, beams.last);
    beams.first = std::min(first_, beams.last);
    append_u16(payload, beams.first);
    append_u16(payload, beams.last);
  }
  add_values(payload, *turn, beams, {configuration_[kMeasuringMode], configuration_[kUnit]});
  if ((configuration_[kAvailability] & 0x02) != 0) payload.push_back(turns_);
  answer(std::move(payload), now);
  ++scans_;
}

void SickLmsFirmware::send_status(TimePoint now) {
  std::vector<std::uint8_t> payload(kStatusSize);
  payload[0] = 0xB1;
  put(payload, 1, "V02.30 ");
  payload[8] = mode_;
  payload[67] = 75;  // turns of the mirror in a second
  payload[102] = configuration_[kMeasuringMode];
  payload[107] = static_cast<std::uint8_t>(angle_);
  payload[109] = static_cast<std::uint8_t>(resolution_);
  payload[122] = configuration_[kUnit];
  payload[123] = 1;  // the laser is on
  put(payload, 124, "V01.20 ");
  answer(std::move(payload), now);
}

void SickLmsFirmware::answer(std::vector<std::uint8_t> payload, TimePoint now) {
  payload.push_back(status_);
  std::vector<std::uint8_t> telegram{0x02, 0x80};
  append_u16(telegram, static_cast<unsigned>(payload.size()));
  telegram.insert(telegram.end(), payload.begin(), payload.end());
  append_u16(telegram, hw::framing::crc_of_pairs(telegram));
  send(telegram, now);
}

}  // namespace orca::emulators
