// SPDX-License-Identifier: LGPL-3.0-or-later
#include "network_line.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace orca::sim {
namespace {

constexpr std::size_t kMostSeats = 16;
constexpr std::size_t kMostUnsent = std::size_t{256} << 10;  // [bytes]
constexpr int kMostReads = 64;  // of one client at a time, so that it delays no other

}  // namespace

// The place of one client: its connection, and the firmware that talks to it.
class NetworkLine::Seat {
 public:
  Seat(hw::link::TcpListener& listener, std::unique_ptr<emulators::Firmware> firmware)
      : link_(listener), firmware_(std::move(firmware)) {}

  [[nodiscard]] bool is_taken() const { return is_taken_; }
  [[nodiscard]] std::unique_ptr<emulators::Firmware> another() const { return firmware_->for_another_host(); }

  // While there is no client, what the device says is lost.
  void exchange(TimePoint now) {
    if (!is_taken_) take_next();
    firmware_->note_host(is_taken_, now);
    if (is_taken_ && !hear(now)) leave(now);
    const std::vector<std::uint8_t> sent = firmware_->advance(now);
    if (is_taken_ && !say(sent)) leave(now);
  }

  void close() {
    link_.close();
    unsent_.clear();
    is_taken_ = false;
  }

 private:
  void take_next() {
    const auto opened = link_.open();
    is_taken_ = opened && *opened == hw::link::Opening::done;
  }

  // Returns whether the client is still there.
  bool hear(TimePoint now) {
    std::array<std::uint8_t, 4096> bytes{};
    for (int i = 0; i < kMostReads; ++i) {
      const auto count = link_.read(bytes);
      if (!count) return false;
      if (*count == 0) return true;
      firmware_->take({bytes.data(), *count}, 0, now);
    }
    return true;
  }

  bool say(const std::vector<std::uint8_t>& bytes) {
    unsent_.insert(unsent_.end(), bytes.begin(), bytes.end());
    std::size_t sent = 0;
    while (sent < unsent_.size()) {
      const std::size_t size = std::min(unsent_.size() - sent, hw::link::kMostPending);
      const Status written = link_.write(std::span(unsent_).subspan(sent, size));
      if (!written.ok() && written.error().code != Code::deadline_exceeded) return false;
      if (!written.ok()) break;
      sent += size;
    }
    unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(sent));
    return unsent_.size() <= kMostUnsent;
  }

  void leave(TimePoint now) {
    close();
    firmware_->note_host(false, now);
  }

  hw::link::TcpLink link_;
  const std::unique_ptr<emulators::Firmware> firmware_;
  std::vector<std::uint8_t> unsent_;
  bool is_taken_ = false;
};

NetworkLine::NetworkLine(std::string address, std::uint16_t port,
                         std::unique_ptr<emulators::Firmware> firmware)
    : address_(std::move(address)), port_(port) {
  seats_.push_back(std::make_unique<Seat>(listener_, std::move(firmware)));
}

NetworkLine::~NetworkLine() = default;

Status NetworkLine::open() { return listener_.open(address_, port_); }

void NetworkLine::close() {
  listener_.close();
  for (const auto& seat : seats_) seat->close();
}

bool NetworkLine::exchange(TimePoint now) {
  for (const auto& seat : seats_) seat->exchange(now);
  const auto is_taken = [](const auto& seat) { return seat->is_taken(); };
  if (std::ranges::all_of(seats_, is_taken)) add_seat();
  return std::ranges::any_of(seats_, is_taken);
}

void NetworkLine::add_seat() {
  if (seats_.size() == kMostSeats) return;
  if (auto firmware = seats_.front()->another())
    seats_.push_back(std::make_unique<Seat>(listener_, std::move(firmware)));
}

}  // namespace orca::sim
