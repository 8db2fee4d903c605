// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/recorded_run.hpp"

#include <cstdint>
#include <cstdio>
#include <optional>
#include <utility>

#include "orca/idl/object_type.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time_shift.hpp"
#include "orca/recording/objects/carmen_reader.hpp"

namespace orca::recording {
namespace {

// A robot takes a moment before its first reading, too; so whoever waits for it has subscribed by then.
constexpr Duration kLead = 100ms;

TimePoint instant(std::uint64_t ns) { return TimePoint(Duration(static_cast<Duration::rep>(ns))); }

// Stamps that are older than this when they pass are of another clock.
constexpr Duration kOtherClock = 10s;

class ObjectRun final : public RecordedRun {
 public:
  explicit ObjectRun(ObjectReader reader) : reader_(std::move(reader)) {
    if (std::string damage = damage_of(reader_.file()); !damage.empty()) flaws_.push_back(std::move(damage));
  }

  const std::map<std::string, RecordedRow>& rows() const override { return reader_.rows(); }
  std::map<std::string, std::string> others() const override { return reader_.others(); }
  // In virtual time a run begins at 0, though its first object may come later.
  TimePoint begin() const override {
    return reader_.is_virtual() ? TimePoint{} : instant(reader_.file().statistics().start) - kLead;
  }
  Duration length() const override {
    return instant(reader_.file().statistics().end) - instant(reader_.file().statistics().start);
  }
  Status take_objects(const std::set<std::string>& rows,
                      const std::function<void(const RecordedObject&)>& take) override {
    const auto pass_on = [&](const RecordedObject& one) {
      return take(reader_.is_bag() ? RecordedObject{one.row, dated(one), one.passed} : one), true;
    };
    return reader_.objects(rows, pass_on, &flaws_);
  }
  std::vector<std::string> flaws() const override { return flaws_; }

 private:
  // The first reading of a sensor says how far apart the two clocks are. A map may be old.
  ObjectRef dated(const RecordedObject& one) {
    const Duration behind = one.passed - one.object.stamp();
    const ObjectType& type = one.object.type();
    const bool is_reading =
        is_a(type, object_type<idl::RangeReadings>()) || is_a(type, object_type<idl::Odometry>());
    if (!behind_ && is_reading) {
      behind_ = behind > kOtherClock ? behind : Duration{0};
      if (behind > kOtherClock) flaws_.push_back(clock_text(behind));
    }
    if (!behind_ || *behind_ == Duration{0} || behind < *behind_ - kOtherClock ||
        behind > *behind_ + kOtherClock)
      return one.object;
    ObjectLoan moved = copy_value(one.object);
    shift_times(moved, *behind_);
    return std::move(moved).seal();
  }

  static std::string clock_text(Duration behind) {
    char text[120];
    std::snprintf(
        text, sizeof text,
        "its stamps are of a clock that is %.1f s behind that of the recording, and are moved by that",
        to_seconds(behind));
    return text;
  }

  const ObjectReader reader_;
  std::optional<Duration> behind_;  // of the clock of the stamps; 0: it is the same
  std::vector<std::string> flaws_;
};

class CarmenRun final : public RecordedRun {
 public:
  explicit CarmenRun(CarmenReader reader) : reader_(std::move(reader)) {}

  const std::map<std::string, RecordedRow>& rows() const override { return reader_.rows(); }
  TimePoint begin() const override { return reader_.begin() - kLead; }
  Duration length() const override { return reader_.end() - reader_.begin(); }
  Status take_objects(const std::set<std::string>& /*rows*/,
                      const std::function<void(const RecordedObject&)>& take) override {
    reader_.take_objects(take);
    return ok();
  }
  std::vector<std::string> flaws() const override { return reader_.log().flaws.texts(); }

 private:
  CarmenReader reader_;
};

template <class Run, class Reader>
Result<std::unique_ptr<RecordedRun>> run_of(Result<Reader> reader) {
  if (!reader) return reader.error();
  return std::unique_ptr<RecordedRun>(std::make_unique<Run>(*std::move(reader)));
}

}  // namespace

Result<std::unique_ptr<RecordedRun>> RecordedRun::open(const std::string& path) {
  if (is_recording(path)) return run_of<ObjectRun>(ObjectReader::open(path));
  auto run = run_of<CarmenRun>(CarmenReader::open(path));
  if (run || run.error().code != Code::data_loss) return run;
  return fail(Code::data_loss,
              "it is neither an MCAP file nor a CARMEN log, nor a bag in SQLite: " + run.error().message,
              path);
}

}  // namespace orca::recording
