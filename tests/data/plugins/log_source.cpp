// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace {

/// Sends log records, one a lap, and is done.
class LogSource final : public orca::Component {
 public:
  explicit LogSource(orca::ComponentHost& host) : Component(host) {
    lap_every(std::chrono::milliseconds(10));
  }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    auto record = log_.loan();
    record->level(orca::idl::LEVEL_WARNING);
    record->source() = "wheels";
    record->text() = "record " + std::to_string(++sent_) + "\nof several lines";
    record->stamp(orca::to_time_value(now()));
    if (const orca::Status sent = log_.send(std::move(record)); !sent.ok())
      return orca::failed(sent.error().text());
    return sent_ < *count_ ? orca::again() : orca::done();
  }

  orca::SendProxy<orca::idl::LogRecord> log_{*this, "log"};
  orca::Param<std::int64_t> count_{*this, "count", 100, {.min = 1}};
  std::int64_t sent_ = 0;
};

}  // namespace

ORCA_COMPONENT(LogSource, "test.LogSource")
