// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/carmen/line.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <numbers>

#include "orca/base/text.hpp"

namespace orca::carmen {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kHalfTurn = std::numbers::pi;
constexpr double kFarthest = 1e6;  // [m] that anything is away
constexpr double kLatest = 4.6e9;  // [s] of a stamp, in the year 2115: it fits into a Duration as any other
constexpr std::size_t kMost = 100000;  // readings of a scan
constexpr std::string_view kBlanks = " \t\r\n";

Error damaged(std::string what) { return fail(Code::data_loss, std::move(what)); }

// The words of a line, one after the other. The first fault stays.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) { skip_blanks(); }

  [[nodiscard]] bool at_end() const { return rest_.empty(); }
  [[nodiscard]] const std::string& fault() const { return fault_; }
  [[nodiscard]] std::string_view rest() const { return rest_; }

  void find_fault(std::string fault) {
    if (fault_.empty()) fault_ = std::move(fault);
  }

  std::string_view word(const char* meaning) {
    if (rest_.empty()) find_fault(std::string("it ends before its ") + meaning);
    const std::string_view word = rest_.substr(0, rest_.find_first_of(kBlanks));
    rest_.remove_prefix(word.size());
    skip_blanks();
    return word;
  }

  // @param limit  of the amount.
  double number(const char* meaning, double limit = kFarthest) {
    const double value = any_number(meaning);
    if (std::isfinite(value) && std::fabs(value) <= limit) return value;
    find_fault(std::string("its ") + meaning + " cannot be so large");
    return 0.0;
  }

  std::size_t count(const char* meaning) {
    const std::string_view text = word(meaning);
    std::size_t value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem == std::errc{} && end == text.data() + text.size() && value <= kMost) return value;
    find_fault("its " + std::string(meaning) + " cannot be " + in_quotes(printable(text)));
    return 0;
  }

  Pose2 pose(const char* meaning) {
    const double x = number(meaning);
    const double y = number(meaning);
    return {x, y, wrapped(number(meaning, 1e4))};
  }

  std::vector<double> ranges(std::size_t count) {
    std::vector<double> all;
    all.reserve(std::min(count, rest_.size() / 2 + 1));  // as many as there can be in what is left
    for (std::size_t i = 0; i < count && fault_.empty(); ++i) {
      const double range = any_number("readings");
      if (range < 0.0) find_fault("a reading is negative");
      if (std::isfinite(range) && range > kFarthest) find_fault("a reading cannot be so large");
      all.push_back(range);
    }
    return all;
  }

  Duration stamp() {
    const double seconds = number("stamp", kLatest);
    if (seconds < 0.0) find_fault("its stamp is negative");
    return from_seconds(seconds);
  }

 private:
  void skip_blanks() { rest_.remove_prefix(std::min(rest_.find_first_not_of(kBlanks), rest_.size())); }

  double any_number(const char* meaning) {
    const std::string_view text = word(meaning);
    double value = 0.0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem == std::errc{} && end == text.data() + text.size()) return value;
    find_fault("its " + std::string(meaning) + " cannot be " + in_quotes(printable(text)));
    return 0.0;
  }

  std::string_view rest_;
  std::string fault_;
};

// How a scan of so many readings lies that says nothing of it. A half turn, but for the lasers whose scans have this many.
void lay(ScanLine& scan) {
  const std::size_t count = scan.ranges.size();
  scan.angle_start = count == 401 ? -100.0 * kDegree : -90.0 * kDegree;
  if (count == 401 || count == 361 || count == 360) {
    scan.angle_increment = 0.5 * kDegree;
  } else if (count == 180 || count == 181) {
    scan.angle_increment = kDegree;
  } else {
    scan.angle_increment = count > 1 ? kHalfTurn / static_cast<double>(count - 1) : kDegree;
  }
}

bool has_usual_lie(const ScanLine& scan) {
  ScanLine usual;
  usual.ranges.resize(scan.ranges.size());
  lay(usual);
  constexpr double kSlack = 1e-5;  // [rad]
  return std::fabs(usual.angle_start - scan.angle_start) < kSlack &&
         std::fabs(usual.angle_increment - scan.angle_increment) * static_cast<double>(scan.ranges.size()) <
             kSlack;
}

OdometryLine read_odometry(Words& words) {
  OdometryLine line;
  line.X_OB = words.pose("pose");
  line.speed = words.number("speed");
  line.turn_rate = words.number("turn rate");
  words.number("acceleration");
  return line;
}

ScanLine read_old_scan(Words& words, Laser laser) {
  ScanLine scan;
  scan.laser = laser;
  scan.ranges = words.ranges(words.count("number of readings"));
  lay(scan);
  scan.X_OL = words.pose("pose");
  scan.X_OB = words.pose("odometry");
  return scan;
}

ScanLine read_new_scan(Words& words, Laser laser) {
  ScanLine scan;
  scan.laser = laser;
  words.word("type of laser");
  scan.angle_start = words.number("first angle", 7.0);
  words.number("field of view", 7.0);
  scan.angle_increment = words.number("angular resolution", 7.0);
  const double max_range = words.number("largest range");
  if (max_range > 0.0) scan.max_range = max_range;
  words.number("accuracy");
  words.word("remission mode");
  scan.ranges = words.ranges(words.count("number of readings"));
  for (std::size_t left = words.count("number of remissions"); left > 0 && words.fault().empty(); --left)
    words.word("remissions");
  scan.X_OL = words.pose("pose");
  scan.X_OB = words.pose("odometry");
  scan.speed = words.number("speed");
  scan.turn_rate = words.number("turn rate");
  for (const char* const unused : {"safety distance", "safety distance", "turn axis"}) words.number(unused);
  return scan;
}

// PARAM name value host time; a value may have several words, and old logs have nothing behind it.
ParamLine read_param(Words& words) {
  ParamLine line{std::string(words.word("name")), ""};
  std::vector<std::string> all;
  while (!words.at_end()) all.emplace_back(words.word("value"));
  if (all.size() > 2) all.resize(all.size() - 2);
  line.value = joined(all, " ");
  return line;
}

bool is_kind(std::string_view word) {
  return !word.empty() && word.size() <= 40 && std::ranges::all_of(word, [](char c) {
    return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  }) && (word.front() < '0' || word.front() > '9');
}

// Takes a stamp, a host and the time at which the line was logged.
void read_end(Words& words, Line& line) {
  line.stamp = words.stamp();
  words.word("host");
  line.logged = from_seconds(words.number("time of logging", kLatest));
  if (!words.at_end()) words.find_fault("there is more behind its end");
}

bool read_content(std::string_view kind, Words& words, Line& line) {
  if (kind == "ODOM")
    line.content = read_odometry(words);
  else if (kind == "FLASER" || kind == "RLASER")
    line.content = read_old_scan(words, kind == "FLASER" ? Laser::front : Laser::rear);
  else if (kind == "ROBOTLASER1" || kind == "ROBOTLASER2")
    line.content = read_new_scan(words, kind == "ROBOTLASER1" ? Laser::front : Laser::rear);
  else
    return false;
  read_end(words, line);
  return true;
}

std::string numbers(std::initializer_list<double> values, int decimals = 6) {
  std::string text;
  for (const double value : values) {
    char digits[48];
    std::snprintf(digits, sizeof digits, " %.*f", decimals, value);
    text += digits;
  }
  return text;
}

std::string text_of(const Pose2& at) { return numbers({at.x, at.y, at.yaw}); }

// The end of each line: when it was sensed, on which host, and when it was logged.
std::string ending(Duration stamp) {
  const std::string time = numbers({to_seconds(stamp)});
  return time + " orca" + time + "\n";
}

std::string text_of(const ScanLine& scan) {
  constexpr int kOfAngles = 9;  // decimals: the last of a thousand beams must not be off
  std::string ranges = " " + std::to_string(scan.ranges.size());
  for (const double range : scan.ranges) ranges += numbers({range}, 3);
  const char* const number = scan.laser == Laser::front ? "1" : "2";
  const std::string poses = text_of(scan.X_OL) + text_of(scan.X_OB);
  if (has_usual_lie(scan)) return (scan.laser == Laser::front ? "FLASER" : "RLASER") + ranges + poses;
  const double view =
      scan.angle_increment * static_cast<double>(std::max<std::size_t>(scan.ranges.size(), 1) - 1);
  return std::string("ROBOTLASER") + number + " 0" +
         numbers({scan.angle_start, view, scan.angle_increment}, kOfAngles) +
         numbers({scan.max_range.value_or(0.0), 0.0}) + " 0" + ranges + " 0" + poses +
         numbers({scan.speed, scan.turn_rate, 0.0, 0.0, 0.0});
}

std::vector<std::string_view> split(std::string_view text) {
  std::vector<std::string_view> all;
  for (Words words(text); !words.at_end();) all.push_back(words.word(""));
  return all;
}

}  // namespace

Result<Line> read_line(std::string_view text) {
  Words words(text);
  if (words.at_end() || words.rest().front() == '#') return Line{};
  const std::string_view kind = words.word("kind");
  if (!is_kind(kind))
    return damaged("it begins with " + in_quotes(printable(kind)) + ", which is no kind of line");
  Line line;
  if (kind == "PARAM") {
    line.content = read_param(words);
  } else if (!read_content(kind, words, line)) {
    line.content = OtherLine{std::string(kind)};
  }
  if (words.fault().empty()) return line;
  return damaged("a line " + std::string(kind) + ": " + words.fault());
}

std::string to_text(const Line& line) {
  if (const auto* const odometry = std::get_if<OdometryLine>(&line.content))
    return "ODOM" + text_of(odometry->X_OB) + numbers({odometry->speed, odometry->turn_rate, 0.0}) +
           ending(line.stamp);
  if (const auto* const scan = std::get_if<ScanLine>(&line.content))
    return text_of(*scan) + ending(line.stamp);
  if (const auto* const param = std::get_if<ParamLine>(&line.content))
    return "PARAM " + param->name + " " + param->value + " orca 0\n";
  return "";
}

std::optional<ScanTable> ScanTable::begins_with(std::string_view line) {
  if (!line.starts_with("# ")) return std::nullopt;
  line = line.substr(0, line.find(';'));  // remarks follow
  const std::vector<std::string_view> names = split(line.substr(2));
  const auto column = [&](std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  ScanTable table;
  table.t_ = column("t");
  table.x_ = column("odom_x");
  table.y_ = column("odom_y");
  table.yaw_ = column("odom_theta");
  const auto readings = std::ranges::find_if(names, [](auto name) { return name.starts_with("r0.."); });
  table.readings_ = static_cast<std::size_t>(readings - names.begin());
  const std::size_t last = std::max({table.t_, table.x_, table.y_, table.yaw_});
  if (readings == names.end() || last >= table.readings_) return std::nullopt;
  return table;
}

Result<Line> ScanTable::read_row(std::string_view text) const {
  Words words(text);
  if (words.at_end() || words.rest().front() == '#') return Line{};
  Line line;
  ScanLine scan;
  for (std::size_t i = 0; i < readings_; ++i) {
    if (i == t_)
      line.stamp = words.stamp();
    else if (i == x_)
      scan.X_OB.x = words.number("pose");
    else if (i == y_)
      scan.X_OB.y = words.number("pose");
    else if (i == yaw_)
      scan.X_OB.yaw = wrapped(words.number("pose", 1e4));
    else
      words.number("other columns", kLatest);
  }
  std::size_t count = 0;
  for (Words rest = words; !rest.at_end() && count <= kMost; ++count) rest.word("readings");
  if (count == 0) words.find_fault("it has no readings");
  if (count > kMost) words.find_fault("it has too many readings");
  scan.ranges = words.ranges(count);
  if (!words.fault().empty()) return damaged("a row of scans: " + words.fault());
  lay(scan);
  scan.X_OL = scan.X_OB;
  line.content = std::move(scan);
  return line;
}

}  // namespace orca::carmen
