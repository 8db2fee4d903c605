// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/laser_driver.hpp"
#include "orca/hw/sick_lms/scan.hpp"
#include "session.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using namespace orca::hw::sick_lms;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr unsigned kFirstRate = 38400;  // at which the laser is looked for
constexpr unsigned kFastestRate = 500000;
constexpr Duration kShortestSilence = 1s;

// A unit with the measuring mode that has the greatest range in it.
struct Scale {
  const char* name;
  Unit unit;
  std::uint8_t measuring_mode;
  double max_range;  // [m]
};
constexpr Scale kMillimetres{"mm", Unit::millimetre, 6, 32.0};
constexpr Scale kCentimetres{"cm", Unit::centimetre, 0, 80.0};

/// A SICK LMS200 or another laser of the LMS2xx family.
///
/// Its mirror turns 75 times a second. Beams closer than a degree are measured in two or four turns, and a scan is sent when the
/// last one is measured. At 38400 baud about 10 scans of 181 beams come in a second, at 500000 baud all 75.
class SickLms final : public LaserDriver {
 public:
  explicit SickLms(HardwareHost& host)
      : LaserDriver(host, {.baud = kFirstRate}, {.vendor = "SICK", .model = "LMS200"}) {}

 protected:
  void check(std::vector<HardwareFault>& faults) override {
    variant_ = {rounded(*angle_ / kDegree), rounded(100.0 * *resolution_ / kDegree)};
    if (!is_possible(variant_))
      faults.push_back(
          {"resolution", "an LMS has no beams " + shown(*resolution_ / kDegree) + " deg apart over " +
                             shown(*angle_ / kDegree) +
                             " deg; choose 0.5 or 1 deg over 180 deg, or 0.25, 0.5 or 1 deg over 100 deg"});
    if (*rate_ != 0 && !request_rate(static_cast<unsigned>(*rate_)))
      faults.push_back(
          {"rate", request_rate(static_cast<unsigned>(*rate_)).error().message + ", or 0 for the fastest"});
    scale_ = *unit_ == kCentimetres.name ? kCentimetres : kMillimetres;
  }

  [[nodiscard]] Scans scans() const override {
    return {.beams = beams(variant_),
            .first_angle = beam_angle(variant_, 0),
            .increment = increment(variant_),
            .max_range = scale_.max_range,
            .period = scan_period(variant_, *rate_ != 0 ? static_cast<unsigned>(*rate_) : kFastestRate)};
  }

  // It knows from one connection to the next which rates the laser does not have.
  LineSession& session() override {
    if (!session_)
      session_.emplace(line(),
                       Wishes{.variant = variant_,
                              .unit = scale_.unit,
                              .measuring_mode = scale_.measuring_mode,
                              .rate = static_cast<std::uint32_t>(*rate_),
                              .patience = from_seconds(*patience_)},
                       has_rate());
    return *session_;
  }

  Status meet() override {
    measuring_mode_ = session_->configuration().measuring_mode().value_or(0);
    status_ = {};
    scanning_ = false;
    log_connected(in_quotes(session_->type()), session_->rate());
    if (!session_->rate_trouble().empty()) warn(session_->rate_trouble());
    return ok();
  }

  // It says nothing unless it scans. A slow line takes a second for a scan.
  [[nodiscard]] Duration longest_silence() const override {
    return scanning_ ? std::max(kShortestSilence, 3 * scan_period(variant_, session_->rate()))
                     : Duration::max();
  }

  Status start() override {
    scanning_ = true;
    heard();  // its silence counts from now
    return session_->send(request_mode(Mode::all_scans));
  }

  void stop() override {
    if (scanning_) (void)session_->send(request_mode(Mode::on_request));
    scanning_ = false;
  }

  void take_leave() override { stop(); }

  Status look(TimePoint now) override {
    Status taken;
    Status read = session_->receive(now, [&](const Received& received) {
      if (taken.ok()) taken = take(received);
    });
    return read.ok() ? taken : read;
  }

 private:
  [[nodiscard]] static unsigned rounded(double number) {
    return number > 0.0 && number < 1e6 ? static_cast<unsigned>(std::lround(number)) : 0;
  }
  [[nodiscard]] static std::string shown(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", number);
    return text;
  }

  Status take(const Received& received) {
    const Reply& reply = received.reply;
    note_status(reply.status);
    if (reply.code == ReplyCode::power_on)
      return fail(Code::unavailable, "the laser has restarted: was its power interrupted?");
    if (!scanning_) return ok();  // a scan that was on its way
    if (reply.code == ReplyCode::not_accepted ||
        parse_mode_answer(reply).value_or(ModeAnswer::success) != ModeAnswer::success)
      return fail(Code::failed_precondition, "the laser refuses to send scans");
    if (reply.code != ReplyCode::scan) return ok();
    // A scan whose check word is good and whose content is not fits no setting of ours; the next one may.
    if (!parse_scan(reply, measuring_mode_, ranges_).ok() || ranges_.size() != beams(variant_)) return ok();
    heard(received.stamp);
    // Beams of several turns are not measured in their order.
    const bool in_order = variant_.resolution == 100;
    publish(ranges_, received.stamp - mirror_time(variant_),
            in_order ? to_seconds(mirror_time(variant_)) / 360.0 : 0.0);
    return ok();
  }

  // Reports what has changed in the status byte that ends each telegram.
  void note_status(StatusByte status) {
    if (status.byte == status_.byte) return;
    const bool was_good = is_fine(status_);
    status_ = status;
    if (is_fine(status)) {
      if (!was_good) host().write_log(log::Level::info, "the laser's status is good again");
      return;
    }
    std::string text;
    if (status.is_polluted()) text += "its window is dirty, clean it; ";
    if (status.has_implausible_values()) text += "some of its values are implausible; ";
    if (!status.is_good()) text += "it reports a " + std::string(severity(status)) + "; ";
    warn("the laser: " + text.substr(0, text.size() - 2));
  }

  [[nodiscard]] static bool is_fine(StatusByte status) {
    return status.is_good() && !status.is_polluted() && !status.has_implausible_values();
  }
  [[nodiscard]] static const char* severity(StatusByte status) {
    switch (status.severity()) {
      case 1: return "remark";
      case 2: return "warning";
      case 3: return "error";
      default: return "fatal error";
    }
  }

  Param<double> angle_{
      *this, "angle", 180.0 * kDegree, {.unit = "rad", .text = "Angle that it scans: 100 or 180 deg."}};
  Param<double> resolution_{
      *this,
      "resolution",
      0.5 * kDegree,
      {.unit = "rad", .text = "Angle between two beams: 1 or 0.5 deg, or over 100 deg 0.25 deg."}};
  Param<std::string> unit_{*this,
                           "unit",
                           "mm",
                           {.choices = {"mm", "cm"},
                            .text = "What it counts: mm up to 32 m, or cm up to 80 m. Another one than "
                                    "it has is written into its memory."}};
  Param<std::int64_t> rate_{
      *this,
      "rate",
      0,
      {.min = 0,
       .text = "Rate of the line in baud: 9600, 19200, 38400, 500000, or 0 for the fastest possible."}};
  Param<double> patience_{*this,
                          "patience",
                          0.0,
                          {.unit = "s",
                           .min = 0.0,
                           .max = 600.0,
                           .text = "For how long a laser is waited for that was just switched on; the "
                                   "deployer gives up after 10 s."}};

  Variant variant_{};
  Scale scale_ = kMillimetres;
  std::optional<Session> session_;
  std::uint8_t measuring_mode_ = 0;  // of the laser
  std::vector<double> ranges_;       // of the last scan
  StatusByte status_{};
  bool scanning_ = false;
};

}  // namespace

ORCA_HARDWARE(SickLms, "orca.hw.SickLms")
