// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"

namespace {

constexpr std::int64_t kBinUs = 10;  // width of a class of gaps [us]

/// Laps on what a teller says, and logs the gaps between its laps: "gaps of PHASE: COUNT, 99.9 % below MICROSECONDS us" whenever
/// `phase` gets a new value. Logs each count that does not follow on the one before.
class Gauge final : public orca::Component {
 public:
  explicit Gauge(orca::ComponentHost& host) : Component(host) { lap_on(in_); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Status params_changed() override {
    log_debug("gaps of " + present_ + ": " + std::to_string(count_) + ", 99.9 % below " +
              std::to_string(gap_at_999()) + " us");
    present_ = *phase_;
    gaps_.fill(0);
    count_ = 0;
    last_lap_.reset();
    return orca::ok();
  }

  orca::Outcome work() override {
    const orca::TimePoint lap = now();
    if (last_lap_) add(lap - *last_lap_);
    last_lap_ = lap;
    while (in_.new_data_arrived()) {
      const std::string word(in_.get_update()->name());
      const std::int64_t said = std::stoll(word.substr(word.find(':') + 1));
      if (last_ != 0 && said != last_ + 1)
        log_debug("heard " + std::to_string(said) + " after " + std::to_string(last_));
      last_ = said;
    }
    return orca::again();
  }

  void add(orca::Duration gap) {
    const auto bin = static_cast<std::size_t>(orca::to_seconds(gap) * 1e6 / kBinUs);
    ++gaps_[std::min(bin, gaps_.size() - 1)];
    ++count_;
  }

  // Returns the end of the class in which 99.9 % of the gaps are reached [us].
  [[nodiscard]] std::int64_t gap_at_999() const {
    std::int64_t below = 0;
    for (std::size_t bin = 0; bin < gaps_.size(); ++bin)
      if ((below += gaps_[bin]) * 1000 >= count_ * 999) return static_cast<std::int64_t>(bin + 1) * kBinUs;
    return 0;
  }

  orca::PushProxy<orca::idl::GoalPoint> in_{*this, "in"};
  orca::Param<std::string> phase_{*this, "phase", "start", {.text = "What the next gaps are of."}};
  std::string present_ = "start";
  std::array<std::int64_t, 100'000> gaps_{};  // how many of each class; the last one has all longer ones
  std::int64_t count_ = 0;
  std::optional<orca::TimePoint> last_lap_;
  std::int64_t last_ = 0;
};

}  // namespace

ORCA_COMPONENT(Gauge, "test.Gauge")
