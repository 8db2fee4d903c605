// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/hw/framing/scanner.hpp"

namespace orca::emulators {

struct SickLmsSettings {
  std::string type = "LMS200;30106;V02.30 ";
  std::string password = "SICK_LMS";  ///< Of the installation mode.
  std::uint32_t baud = 9600;          ///< After power-on.
  /// Rates that it can have; it refuses others. One on an RS-232 cable cannot have 500000.
  std::vector<std::uint32_t> rates{9600, 19200, 38400, 500000};
  Duration power_up = 500ms;              ///< Until it is ready; a real one needs about 30 s.
  Duration mirror_period = 13'333'333ns;  ///< Of a turn of the mirror.
  unsigned angle = 180;                   ///< [deg] after power-on.
  unsigned resolution = 50;               ///< [1/100 deg] after power-on.
  std::uint8_t measuring_mode = 0;        ///< As it was stored last; 0: values up to 8191 units.
  std::uint8_t unit = 0;                  ///< As it was stored last; 0: cm, 1: mm, 2: 10 cm.
  Duration write_time = 0s;               ///< Of the configuration; a real one needs up to 15 s.
  bool acknowledges = true;               ///< Sends 06 and 15, as a real one does.
};

/// A SICK LMS200 at the other end of the line: it announces itself after power-on, answers requests, and sends what its mirror
/// shows it, one scan on request or all of them. While a scan is on its way, those that are measured meanwhile are left out.
///
/// A line that the host has set to another rate carries nothing either way. What is sent takes its time at the rate. It does not
/// demand the pauses between bytes that a real one needs at 500000 baud, since a pseudo terminal cannot show them.
///
/// Thread contract: not synchronised.
/// @source  LMS2xx telegram listing.
class SickLmsFirmware final : public Firmware {
 public:
  /// It is switched on at the first advance(). @param mirror  outlives the object.
  explicit SickLmsFirmware(Mirror& mirror, SickLmsSettings settings = {});

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) override;
  std::vector<std::uint8_t> advance(TimePoint now) override;
  /// Only the configuration is kept.
  void reset(TimePoint now) override;

  /// Sets the status byte that ends all telegrams. 10 (hex) is good; with bit 7 its window is dirty.
  void set_status(std::uint8_t status) { status_ = status; }

  [[nodiscard]] bool sends_scans() const { return mode_ == 0x24 || mode_ == 0x27; }
  [[nodiscard]] std::uint32_t baud() const { return baud_; }
  /// Returns the configuration that it keeps.
  [[nodiscard]] const std::vector<std::uint8_t>& configuration() const { return configuration_; }
  /// Returns how often the configuration was written, which wears the memory.
  [[nodiscard]] int writes() const { return writes_; }
  /// Returns how many scans it has sent.
  [[nodiscard]] int scans() const { return scans_; }
  /// Returns the numbers of all commands that came, without what followed.
  [[nodiscard]] const std::vector<int>& commands() const { return commands_; }

 private:
  using Bytes = std::span<const std::uint8_t>;
  // What happens when the last byte of an answer has left.
  struct Change {
    TimePoint at;
    std::uint32_t baud = 0;  // 0: it restarts
  };

  void switch_on(TimePoint now);
  void go_on(TimePoint now);
  void let_out(TimePoint now);
  void turn_mirror(TimePoint now);
  void obey(Bytes payload, TimePoint now);
  void choose_mode(Bytes data, TimePoint now);
  [[nodiscard]] bool enter(std::uint8_t mode, Bytes parameters);
  void change_rate(std::uint32_t baud, TimePoint now);
  void choose_variant(Bytes data, TimePoint now);
  void write(Bytes block, TimePoint now);
  [[nodiscard]] bool is_possible(Bytes block) const;
  void send_scan(TimePoint now);
  void send_status(TimePoint now);
  void answer(std::vector<std::uint8_t> payload, TimePoint now);
  void send(Bytes bytes, TimePoint now) { line_.send(bytes, 10.0 / baud_, now); }
  [[nodiscard]] unsigned beams() const { return 100 * angle_ / resolution_ + 1; }
  [[nodiscard]] Duration scan_time() const { return settings_.mirror_period * (100 / resolution_); }

  Mirror& mirror_;
  const SickLmsSettings settings_;
  std::vector<std::uint8_t> configuration_;
  hw::framing::Scanner scanner_;
  OutgoingLine line_;
  std::vector<std::uint8_t> left_;  // has left the line since the last advance()
  std::uint32_t baud_;
  std::uint32_t host_baud_ = 0;
  std::optional<TimePoint> ready_at_;  // nothing: it is off
  bool ready_ = false;
  std::optional<Change> change_;
  TimePoint last_byte_{};
  TimePoint next_scan_{};
  std::uint8_t mode_ = 0x25;
  unsigned angle_;
  unsigned resolution_;
  unsigned first_ = 1;  // of the beams that mode 27 sends
  unsigned last_ = 1;
  bool scan_wanted_ = false;
  std::uint8_t turns_ = 0;
  std::uint8_t status_ = 0x10;
  int writes_ = 0;
  int scans_ = 0;
  std::vector<int> commands_;
};

}  // namespace orca::emulators
