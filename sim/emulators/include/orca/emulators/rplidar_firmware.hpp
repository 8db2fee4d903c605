// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/hw/framing/scanner.hpp"

namespace orca::emulators {

struct RplidarSettings {
  std::uint8_t model = 0x18;  ///< An A1M8.
  std::uint8_t firmware_major = 1;
  std::uint8_t firmware_minor = 29;
  std::uint8_t hardware = 7;
  std::array<std::uint8_t, 16> serial{0xA4, 0xE1, 0x9A, 0xF0, 0xC1, 0xE3, 0x9E, 0xD4,
                                      0xB1, 0x98, 0x4C, 0x95, 0x1C, 0x28, 0x42, 0x13};
  std::uint32_t baud = 115200;
  Duration boot = 500ms;          ///< After power-on and reset, until it hears requests. Not documented.
  Duration spin_up = 500ms;       ///< Until the motor turns evenly. Not documented.
  Duration turn = 181'818'182ns;  ///< [s] of the motor: 5.5 in a second.
  Duration sample = 500us;        ///< [s] from one measurement to the next; half as long in an express scan.
  double max_range = 12.0;        ///< [m] beyond it hears no echo.
  bool has_express = true;  ///< Knows express scans and tells its sample rates: not before firmware 1.17.
  bool resets_heal = true;  ///< A reset ends an error that health reports.
};

/// An RPLIDAR A1 at the other end of the line: it answers requests, and sends what the mirror shows it in nodes of 5 bytes or in
/// capsules of 84. Its firmware tells its scan modes, the standard and the express one, as those from 1.24 on do. It turns clockwise, seen from above, and begins to send when its motor turns evenly. A request that it does not
/// know, and one whose checksum is wrong, it does not answer; any request ends a scan.
///
/// The motor is no part of the protocol: the adapter's line DTR switches it. A pseudo terminal does not have that line, so there
/// the motor always turns, see power_motor(). A line that the host has set to another rate carries nothing either way. What is sent
/// takes its time at the rate.
///
/// Thread contract: not synchronised.
/// @source  SLAMTEC, "RPLIDAR Interface Protocol and Application Notes", for the A1 and A2.
class RplidarFirmware final : public Firmware {
 public:
  /// It is switched on at the first advance(). @param mirror  outlives the object; its beams are those of a whole turn, or less.
  explicit RplidarFirmware(Mirror& mirror, RplidarSettings settings = {});

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) override;
  std::vector<std::uint8_t> advance(TimePoint now) override;
  void reset(TimePoint now) override;

  /// Switches the motor, as the adapter's line does. It is on at first.
  void power_motor(bool on, TimePoint now);
  /// Sets what health reports: 0 good, 1 warning, 2 error. With an error it does not scan.
  void set_health(std::uint8_t state, std::uint16_t error);

  [[nodiscard]] bool sends_scans() const { return scan_ != Scan::none; }
  /// Returns how many turns it has sent whole.
  [[nodiscard]] int turns() const { return turns_; }
  /// Returns the numbers of all requests that came.
  [[nodiscard]] const std::vector<int>& requests() const { return requests_; }

 private:
  enum class Scan { none, nodes, capsules };

  void switch_on(TimePoint now);
  void say_who(TimePoint now);
  void obey(std::span<const std::uint8_t> request, TimePoint now);
  void restart(TimePoint now);
  void answer_info(TimePoint now);
  void answer_health(TimePoint now);
  void answer_sample_times(TimePoint now);
  void answer_configuration(std::span<const std::uint8_t> asked, TimePoint now);
  void answer(std::uint8_t type, std::span<const std::uint8_t> data, TimePoint now);
  void begin_scan(Scan scan, bool waits_for_motor, TimePoint now);
  void measure(TimePoint now);
  void measure_once(TimePoint now);
  void turn_by(Duration time);
  void send_node(TimePoint now);
  void add_to_capsule(TimePoint now);
  void send_capsule(TimePoint now);
  [[nodiscard]] Duration sample_time() const;
  [[nodiscard]] unsigned angle() const;
  [[nodiscard]] unsigned distance(double per_metre, unsigned most) const;
  [[nodiscard]] double range_at(double angle) const;
  void send(std::span<const std::uint8_t> bytes, TimePoint now) {
    line_.send(bytes, 10.0 / settings_.baud, now);
  }

  Mirror& mirror_;
  const RplidarSettings settings_;
  hw::framing::Scanner scanner_;
  OutgoingLine line_;
  std::uint32_t host_baud_ = 0;
  std::optional<TimePoint> ready_at_;  // nothing: it is off
  bool ready_ = false;
  bool motor_ = true;
  TimePoint even_at_{};  // the motor
  Scan scan_ = Scan::none;
  TimePoint next_sample_{};
  Duration phase_{0};  // of the motor since it pointed ahead
  bool begins_turn_ = false;
  std::vector<unsigned> capsule_;  // [mm] the samples so far
  unsigned capsule_start_ = 0;     // angle of the first one
  bool is_first_capsule_ = false;
  std::uint8_t health_ = 0;
  std::uint16_t error_ = 0;
  int turns_ = 0;
  std::vector<int> requests_;
};

}  // namespace orca::emulators
