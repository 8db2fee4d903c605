// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/carmen/log.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "orca/base/text.hpp"

namespace orca::carmen {
namespace {

constexpr std::size_t kLongest = std::size_t{4} << 20;  // [bytes] of a line
constexpr Duration kLittle = 1s;
constexpr Duration kMuch = 3600s;
constexpr int kGap = 10;  // usual intervals

// Splits pieces of text into lines.
class Lines {
 public:
  explicit Lines(const std::function<std::string_view()>& next) : next_(next) {}

  // Returns the next line, valid until the next call; nothing: there is none. Of a line that is too long, its beginning.
  std::optional<std::string_view> take() {
    line_.clear();
    for (bool any = false;; any = true) {
      if (piece_.empty()) piece_ = next_();
      if (piece_.empty()) return any ? std::optional<std::string_view>(line_) : std::nullopt;
      const std::size_t end = piece_.find('\n');
      const std::string_view part = piece_.substr(0, end);
      line_.append(part.substr(0, kLongest - std::min(kLongest, line_.size())));
      piece_.remove_prefix(end == std::string_view::npos ? piece_.size() : end + 1);
      if (end != std::string_view::npos) return line_;
    }
  }

 private:
  const std::function<std::string_view()>& next_;
  std::string_view piece_;
  std::string line_;
};

const ScanLine* scan_of(const Entry& entry) { return std::get_if<ScanLine>(&entry.what.content); }

bool is_jump(Duration step) { return step <= -kLittle || step >= kMuch; }

// Sets the times of the entries one after the other, as their stamps say.
class TimeLine {
 public:
  explicit TimeLine(Flaws& flaws) : flaws_(flaws) {}

  // @param next  the entry that follows; null: there is none.
  void set(Entry& entry, const Entry* next) {
    if (has_begun_ && is_wrong(entry.what.stamp, next)) {
      flaws_.wrong.note(entry.line, seconds_text(entry.what.stamp));
      entry.what.stamp = last_;
    }
    const Duration stamp = entry.what.stamp;
    if (has_begun_) look_at(stamp, entry.line);
    Duration& newest = newest_[device_of(entry)];
    if (has_begun_ && stamp + shift_ < newest)
      flaws_.back.note(entry.line, "by " + seconds_text(newest - stamp - shift_));
    newest = std::max(newest, stamp + shift_);
    has_begun_ = true;
    last_ = stamp;
    entry.sensed = stamp + shift_;
    passed_ = std::max(passed_, entry.sensed);
    entry.passed = passed_;
  }

 private:
  // Whether the clock cannot have been there, since it was where it should be before and after.
  [[nodiscard]] bool is_wrong(Duration stamp, const Entry* next) const {
    if (stamp == Duration{0}) return last_ > Duration{0};
    if (next == nullptr || is_jump(next->what.stamp - last_)) return false;
    return is_jump(stamp - last_) || stamp - next->what.stamp >= kLittle;
  }

  void look_at(Duration stamp, std::size_t line) {
    if (!is_jump(stamp - last_)) return;
    flaws_.clock_jumps.note(line, "by " + seconds_text(stamp - last_));
    shift_ = passed_ - stamp;
  }

  static std::size_t device_of(const Entry& entry) {
    const ScanLine* const scan = scan_of(entry);
    return scan == nullptr ? 0 : scan->laser == Laser::front ? 1 : 2;
  }

  Flaws& flaws_;
  bool has_begun_ = false;
  Duration last_{0};  // stamp
  Duration shift_{0};
  Duration passed_ = Duration::min();
  std::array<Duration, 3> newest_{Duration::min(), Duration::min(), Duration::min()};  // of each device
};

// Notes the pauses in the times at which entries of one kind passed.
template <class IsOne>
void find_gaps(const Log& log, IsOne is_one, Flaw& gaps) {
  std::vector<Duration> steps;
  const auto for_each_step = [&](auto take) {
    const Entry* last = nullptr;
    for (const Entry& entry : log.entries) {
      if (!is_one(entry)) continue;
      if (last != nullptr) take(entry, entry.passed - last->passed);
      last = &entry;
    }
  };
  for_each_step([&](const Entry&, Duration step) { steps.push_back(step); });
  if (steps.empty()) return;
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  const Duration least = std::max<Duration>(kLittle, kGap * *middle);
  for_each_step([&](const Entry& entry, Duration step) {
    if (step >= least) gaps.note(entry.line, "of " + seconds_text(step));
  });
}

// Leaves out the rows of a table whose number of readings is not that of most.
void leave_out_cut_rows(Log& log) {
  std::map<std::size_t, std::size_t> rows;
  for (const Entry& entry : log.entries) ++rows[scan_of(entry)->ranges.size()];
  if (rows.size() < 2) return;
  const std::size_t usual =
      std::ranges::max_element(rows, {}, [](const auto& row) { return row.second; })->first;
  std::erase_if(log.entries, [&](const Entry& entry) {
    const std::size_t count = scan_of(entry)->ranges.size();
    if (count == usual) return false;
    log.flaws.damaged.note(entry.line, "a row of " + std::to_string(count) + " readings, where most have " +
                                           std::to_string(usual));
    return true;
  });
}

// Programs that convert logs write the stamp 0 in all lines; when each was logged is behind it.
void take_times_of_logging(Log& log) {
  const auto any = [&](Duration Line::*time) {
    return std::ranges::any_of(log.entries,
                               [&](const Entry& entry) { return entry.what.*time > Duration{0}; });
  };
  if (any(&Line::stamp) || !any(&Line::logged)) return;
  for (Entry& entry : log.entries) entry.what.stamp = entry.what.logged;
  log.flaws.stamps =
      "all stamps are 0, so each line has the time at which it was logged, the last number in it";
}

// A log in which no time passes is over at once, and nobody would know why.
void find_standing_clock(Log& log) {
  constexpr std::size_t kLeast = 3;  // that one moment can hardly have
  if (log.entries.size() < kLeast || log.entries.front().passed != log.entries.back().passed) return;
  log.flaws.stamps =
      "all " + std::to_string(log.entries.size()) +
      " lines have the same stamp, so no time passes in it; give each line the time at which it was sensed";
}

// Returns about what a line takes in memory once it is read, with what maps and heaps add [bytes].
std::size_t memory_of(const Line& line) {
  constexpr std::size_t kAdded = 128;
  const auto* const scan = std::get_if<ScanLine>(&line.content);
  const auto* const param = std::get_if<ParamLine>(&line.content);
  std::size_t more = kAdded;
  if (scan != nullptr) more += scan->ranges.capacity() * sizeof(double);
  if (param != nullptr) more += param->name.size() + param->value.size();
  return std::holds_alternative<NoLine>(line.content) ? 0 : sizeof(Entry) + more;
}

void take(Line line, std::size_t number, Log& log) {
  if (const auto* const param = std::get_if<ParamLine>(&line.content))
    log.params[param->name] = param->value;
  else if (const auto* const other = std::get_if<OtherLine>(&line.content))
    ++log.others[other->kind];
  else if (!std::holds_alternative<NoLine>(line.content))
    log.entries.push_back({.line = number, .what = std::move(line)});
}

std::optional<double> number_param(const Log& log, std::initializer_list<const char*> names) {
  for (const char* const name : names) {
    const auto found = log.params.find(name);
    if (found == log.params.end()) continue;
    const std::string& text = found->second;
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem == std::errc{} && std::isfinite(value)) return value;
  }
  return std::nullopt;
}

struct Close {
  void operator()(gzFile file) const { gzclose(file); }
};

// Returns the reason why reading ended early, or nothing.
std::string fault_of(gzFile file) {
  int code = Z_OK;
  const char* const text = gzerror(file, &code);
  if (code == Z_OK || code == Z_STREAM_END) return {};
  return code == Z_ERRNO ? std::strerror(errno) : text;
}

std::string sentence(const Flaw& flaw, const std::string& one, const std::string& many) {
  return std::to_string(flaw.count) + " " + (flaw.count == 1 ? one : many) + ", the first in line " +
         std::to_string(flaw.first_line) + ": " + flaw.first;
}

}  // namespace

void Flaw::note(std::size_t line, std::string_view text) {
  if (count++ > 0 && line > first_line) return;
  first_line = line;
  first = text;
}

std::vector<std::string> Flaws::texts() const {
  std::vector<std::string> all;
  if (damaged.count > 0)
    all.push_back(sentence(damaged, "damaged line is left out", "damaged lines are left out"));
  if (back.count > 0) all.push_back(sentence(back, "stamp runs backwards", "stamps run backwards"));
  if (wrong.count > 0)
    all.push_back(sentence(wrong, "stamp is wrong, so its line has the time of the one before",
                           "stamps are wrong, so their lines have the time of the one before"));
  if (clock_jumps.count > 0) all.push_back(sentence(clock_jumps, "jump of the clock", "jumps of the clock"));
  if (gaps.count > 0) all.push_back(sentence(gaps, "gap", "gaps"));
  if (!stamps.empty()) all.push_back(stamps);
  if (!cut.empty()) all.push_back("the file ends early: " + cut);
  return all;
}

Result<Log> read_log(const std::function<std::string_view()>& next, std::size_t most) {
  Log log;
  Lines lines(next);
  std::optional<ScanTable> table;
  std::size_t number = 0;
  while (const auto text = lines.take()) {
    if (++number == 1) table = ScanTable::begins_with(*text);
    Result<Line> line = text->size() < kLongest ? table ? table->read_row(*text) : read_line(*text)
                                                : fail(Code::data_loss, "it is longer than 4 MiB");
    if (line) {
      const std::size_t more = memory_of(*line);
      if (more > most)
        return fail(Code::invalid_argument,
                    "it is too large from line " + std::to_string(number) + " on; cut it into pieces");
      most -= more;
      take(*std::move(line), number, log);
    } else {
      log.flaws.damaged.note(number, line.error().message);
    }
  }
  if (log.entries.empty())
    return fail(Code::data_loss,
                "there is no line ODOM, FLASER, RLASER, ROBOTLASER1 or ROBOTLASER2 in it that can be read" +
                    (log.flaws.damaged.count > 0 ? "; line " + std::to_string(log.flaws.damaged.first_line) +
                                                       ": " + log.flaws.damaged.first
                                                 : ""));
  if (table) leave_out_cut_rows(log);
  take_times_of_logging(log);
  TimeLine times(log.flaws);
  for (std::size_t i = 0; i < log.entries.size(); ++i)
    times.set(log.entries[i], i + 1 < log.entries.size() ? &log.entries[i + 1] : nullptr);
  find_standing_clock(log);
  find_gaps(
      log, [](const Entry& entry) { return scan_of(entry) == nullptr; }, log.flaws.gaps);
  find_gaps(
      log, [](const Entry& entry) { return scan_of(entry) != nullptr; }, log.flaws.gaps);
  return log;
}

Result<Log> read_log_file(const std::string& path) {
  std::error_code unused;
  // zlib would wait for ever for the writer of a pipe.
  if (std::filesystem::is_directory(path, unused) || std::filesystem::is_other(path, unused))
    return fail(Code::invalid_argument, "this is no regular file", path);
  errno = 0;
  const std::unique_ptr<gzFile_s, Close> file(gzopen(path.c_str(), "rb"));
  if (file == nullptr)
    return fail(Code::invalid_argument, std::string("cannot read the file: ") + std::strerror(errno), path);
  std::vector<char> buffer(std::size_t{1} << 16);
  Result<Log> log = read_log([&]() -> std::string_view {
    const int got = gzread(file.get(), buffer.data(), static_cast<unsigned>(buffer.size()));
    return {buffer.data(), static_cast<std::size_t>(std::max(got, 0))};
  });
  if (!log) return fail(log.error().code, log.error().message, path);
  log->flaws.cut = fault_of(file.get());
  return log;
}

double max_range_of(const Log& log, Laser laser) {
  if (const auto said = laser == Laser::front
                            ? number_param(log, {"robot_front_laser_max", "robot_frontlaser_max"})
                            : number_param(log, {"robot_rear_laser_max", "robot_rearlaser_max"});
      said && *said > 0.0)
    return *said;
  double largest = 0.0;
  std::size_t count = 0;
  for (const Entry& entry : log.entries) {
    const ScanLine* const scan = scan_of(entry);
    if (scan == nullptr || scan->laser != laser) continue;
    if (scan->max_range) return *scan->max_range;
    for (const double range : scan->ranges) {
      if (!std::isfinite(range) || range < largest) continue;
      count = range > largest ? 1 : count + 1;
      largest = range;
    }
  }
  constexpr double kAbove = 0.1;  // [m]
  return count > 1 ? largest : largest + kAbove;
}

Pose2 mount_of(const Log& log, Laser laser) {
  const double back = laser == Laser::front ? 0.0 : std::numbers::pi;
  if (const auto said =
          number_param(log, {laser == Laser::front ? "robot_frontlaser_offset" : "robot_rearlaser_offset"}))
    return {laser == Laser::front ? *said : -*said, 0.0, back};
  constexpr double kPlace = 0.01;                           // [m]
  constexpr double kTurn = 0.5 * std::numbers::pi / 180.0;  // [rad]
  std::optional<Pose2> first;
  for (const Entry& entry : log.entries) {
    const ScanLine* const scan = scan_of(entry);
    if (scan == nullptr || scan->laser != laser) continue;
    const Pose2 X_BL = seen_from(scan->X_OB, scan->X_OL);
    if (!first) first = X_BL;
    const Pose2 off = seen_from(*first, X_BL);
    if (norm(off.position()) > kPlace || std::fabs(off.yaw) > kTurn) return {0.0, 0.0, back};
  }
  return first.value_or(Pose2{0.0, 0.0, back});
}

}  // namespace orca::carmen
