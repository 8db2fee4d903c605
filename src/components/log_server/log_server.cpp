// SPDX-License-Identifier: LGPL-3.0-or-later
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "log_file.hpp"
#include "orca/base/distant_log.hpp"
#include "orca/base/system/wall_time.hpp"
#include "orca/component.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::Status;

using orca::idl::LogRecord;
using orca::log::Level;

const std::vector<std::string> kLevels{"debug", "info", "warning", "error"};

orca::idl::LogLevel level_of(Level level) {
  switch (level) {
    case Level::debug: return orca::idl::LEVEL_DEBUG;
    case Level::info: return orca::idl::LEVEL_INFO;
    case Level::warning: return orca::idl::LEVEL_WARNING;
    case Level::error:
    case Level::off: break;
  }
  return orca::idl::LEVEL_ERROR;
}

/// A component that collects log records in a file and passes them on to its subscribers (thesis, list of
/// components): every line that the processes of the run write to the log, and what other components send. A full disk stops no
/// component: lines that cannot be written are counted, and a line gives their number when there is room again.
class LogServer final : public orca::Component {
 public:
  explicit LogServer(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(100));
  }
  // Lines that are logged while the system is taken down are written as well.
  ~LogServer() override {
    listener_.reset();
    distant_.reset();
    if (file_) write_heard();
  }

 private:
  Status configure() override {
    file_.emplace(*path_, static_cast<std::uint64_t>(*most_bytes_), static_cast<int>(*keep_));
    if (const Status opened = file_->open(); !opened.ok()) return path_.refuse(opened.error());
    if (*own_lines_) {
      heard_.emplace(*orca::log::parse_level(*lowest_level_));
      listener_.emplace([this](const orca::log::Line& line) { heard_->hear(line); });
      if (*other_processes_) distant_.emplace([this](const orca::log::Line& line) { heard_->hear(line); });
      stay_active(true);
    }
    return orca::ok();
  }

  orca::Outcome work() override {
    for (const auto& [record, time] : heard_records()) pass_on(record, time);
    return orca::again();
  }

  // A record, and its absolute time.
  struct Dated {
    orca::ObjectPtr<LogRecord> record;
    std::string time;
  };

  // Returns what this process has logged since the last call.
  std::vector<Dated> heard_records() {
    std::vector<Dated> records;
    if (!heard_) return records;
    for (const orca::logs::HeardLines::Line& line : heard_->take()) {
      auto record = orca::make_object<LogRecord>();
      record->level(level_of(line.level));
      record->source() = line.who;
      record->text() = line.text;
      record->stamp(orca::to_time_value(line.time));
      records.push_back({std::move(record).seal(), orca::log::wall_time_text(line.time)});
    }
    if (const std::size_t lost = heard_->take_lost(); lost > 0)
      log_warning(std::to_string(lost) + " lines came too fast and are not in " + *path_);
    return records;
  }

  void write_heard() {
    for (const auto& [record, time] : heard_records()) write(*record, time);
  }

  Status on_record(const orca::ObjectPtr<LogRecord>& record) {
    pass_on(record, orca::log::wall_time_text());
    return orca::ok();
  }

  void pass_on(const orca::ObjectPtr<LogRecord>& record, const std::string& wall_time) {
    const bool kept = write(*record, wall_time);
    if (!kept && !failing_)
      raise_alarm("LOG_INCOMPLETE", orca::idl::ALARM_WARNING,
                  "cannot write to " + *path_ + ": records are being lost, " + std::to_string(file_->lost()) +
                      " so far; is the disk full?");
    if (kept && failing_)
      clear_alarm("LOG_INCOMPLETE", "writes to " + *path_ + " again; " + std::to_string(file_->lost()) +
                                        " records were lost in total");
    failing_ = !kept;
    if (passed_on_.subscriber_count() == 0) return;
    auto copy = passed_on_.loan();
    *copy = *record;
    passed_on_.push(std::move(copy));
  }

  bool write(const LogRecord& record, const std::string& wall_time) {
    if (!std::exchange(is_begun_, true))
      (void)file_->append(wall_time + " 0 info " + name() + ": ==== the log of a run begins ====");
    char time[32];
    std::snprintf(time, sizeof time, "%.6f", orca::to_seconds(orca::to_time_point(record.stamp())));
    const std::string& source = record.source().empty() ? record.origin() : record.source();
    return file_->append(wall_time + ' ' + time + ' ' + kLevels.at(record.level()) + ' ' + source + ": " +
                         record.text());
  }

  orca::SendServer<LogRecord> records_{
      *this, "LogRecordSend", &LogServer::on_record, {.text = "Log records to write.", .depth = 1024}};
  orca::PushServer<LogRecord> passed_on_{
      *this, "LogRecordPush", {.text = "Each record that is written, one object each."}};

  orca::Param<std::string> path_{
      *this,
      "file",
      "orca.log",
      {.file = true, .fixed = true, .text = "File to which the lines are appended."}};
  orca::Param<bool> own_lines_{
      *this,
      "own_lines",
      true,
      {.fixed = true, .text = "Whether every line of this process's log is a record."}};
  orca::Param<bool> other_processes_{*this,
                                     "other_processes",
                                     true,
                                     {.fixed = true,
                                      .text = "With own_lines: whether the lines of all other processes, the "
                                              "deployer's too, are records as well."}};
  orca::Param<std::string> lowest_level_{
      *this,
      "lowest_level",
      "info",
      {.choices = kLevels,
       .fixed = true,
       .text = "Lowest level of these lines; --log has no influence on those of this process."}};
  orca::Param<std::int64_t> most_bytes_{
      *this,
      "most_bytes",
      10'000'000,
      {.min = 1000,
       .max = 1e12,
       .fixed = true,
       .text = "Size [bytes] beyond which the file becomes FILE.1 and a new one begins."}};
  orca::Param<std::int64_t> keep_{
      *this, "keep", 5, {.min = 0, .max = 1000, .fixed = true, .text = "Number of old files to keep."}};

  std::optional<orca::logs::LogFile> file_;
  std::optional<orca::logs::HeardLines> heard_;
  std::optional<orca::log::Listener> listener_;
  std::optional<orca::log::DistantListener> distant_;
  bool failing_ = false;
  bool is_begun_ = false;  // the head of this run is written
};

}  // namespace

ORCA_COMPONENT(LogServer, "orca.LogServer")
