// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cstdio>
#include <optional>
#include <string>

#include "log_file.hpp"
#include "orca/component.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::Status;

const char* name_of(orca::idl::LogLevel level) {
  switch (level) {
    case orca::idl::LEVEL_DEBUG: return "debug";
    case orca::idl::LEVEL_INFO: return "info";
    case orca::idl::LEVEL_WARNING: return "warning";
    case orca::idl::LEVEL_ERROR: return "error";
  }
  return "?";
}

/// A component that collects the log records of others in a file (thesis, list of components). A full disk
/// stops no component: lines that cannot be written are counted, and a line gives their number when there is
/// room again.
class LogServer final : public orca::Component {
 public:
  using Component::Component;

 private:
  Status configure() override {
    file_.emplace(*path_, static_cast<std::uint64_t>(*most_bytes_), static_cast<int>(*keep_));
    if (const Status opened = file_->open(); !opened.ok()) return path_.refuse(opened.error());
    return orca::ok();
  }

  // Records are handled between laps, so a lap has nothing to do.
  orca::Outcome work() override { return orca::done(); }

  Status on_record(const orca::ObjectPtr<orca::idl::LogRecord>& record) {
    char time[32];
    std::snprintf(time, sizeof time, "%.6f", orca::to_seconds(orca::to_time_point(record->stamp())));
    const std::string& source = record->source().empty() ? record->origin() : record->source();
    const bool kept = file_->append(std::string(time) + ' ' + name_of(record->level()) + ' ' + source + ": " +
                                    record->text());
    if (!kept && !failing_)
      log_warning("cannot write to " + *path_ + ": records are being lost, " + std::to_string(file_->lost()) +
                  " so far");
    if (kept && failing_)
      log_info("writes to " + *path_ + " again; " + std::to_string(file_->lost()) +
               " records were lost in total");
    failing_ = !kept;
    return orca::ok();
  }

  orca::SendServer<orca::idl::LogRecord> records_{
      *this, "LogRecordSend", &LogServer::on_record, {.text = "Log records to write.", .depth = 1024}};

  orca::Param<std::string> path_{
      *this,
      "file",
      "orca.log",
      {.file = true, .fixed = true, .text = "File to which the lines are appended."}};
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
  bool failing_ = false;
};

}  // namespace

ORCA_COMPONENT(LogServer, "orca.LogServer")
