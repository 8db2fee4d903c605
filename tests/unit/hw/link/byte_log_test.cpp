// SPDX-License-Identifier: GPL-3.0-or-later
// What goes over a link is in its log, and the log never costs the link anything.
#include <catch2/catch.hpp>

#include <mutex>

#include "link_talk.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/log.hpp"
#include "orca/hw/link/byte_log.hpp"
#include "orca/hw/link/logged_link.hpp"
#include "orca/hw/link/memory_link.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::ByteLog;
using hw::link::ByteRecord;
using hw::link::LoggedLink;

namespace {

constexpr std::size_t kPlenty = std::size_t{1} << 24;

// A logged link in memory, on a clock of the test's own.
struct LoggedLine {
  TimePoint time{1000s};
  std::unique_ptr<hw::link::MemoryLink> device;
  std::unique_ptr<LoggedLink> link;

  explicit LoggedLine(const std::string& file, std::size_t most_bytes = kPlenty) {
    auto [near_end, far_end] = make_memory_ends();
    auto log = ByteLog::create({file, most_bytes, [this] { return time; }}, "a device");
    if (!log) FAIL("no log: " << log.error().text());
    link = std::make_unique<LoggedLink>(std::move(near_end), std::move(*log));
    device = std::move(far_end);
    must_open(*device);
  }
};

// Hears the warnings of this process.
class Warnings {
 public:
  [[nodiscard]] std::vector<std::string> all() const {
    const std::lock_guard lock(mutex_);
    return heard_;
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> heard_;
  const log::Listener listener_{[this](const log::Line& line) {
    const std::lock_guard lock(mutex_);
    if (line.level == log::Level::warning) heard_.emplace_back(line.text);
  }};
};

}  // namespace

TEST_CASE("the log of a link holds all that was read and written, with the times", "[hw][link][log]") {
  const TempFolder folder;
  {
    LoggedLine line(folder.file("bytes"));
    must_open(*line.link);
    line.time += 214us;
    must_write(*line.link, {0xFA, 0xFB, 3});
    line.time += 10ms;
    must_write(*line.device, {0xFA});
    CHECK(read_some(*line.link) == Bytes{0xFA});
    CHECK(read_some(*line.link).empty());
    line.time += 1s;
    must_write(*line.device, {0x55});
    line.link->discard_input();
    line.device->close();
    CHECK(error_of_reading(*line.link) == Code::unavailable);
    CHECK(error_of_reading(*line.link) == Code::unavailable);
    line.link->close();
  }
  CHECK(read_text(folder.file("bytes")) ==
        "# orca byte log 1\n"
        "# a device\n"
        "0.000000 open\n"
        "0.000214 out  fa fb 03\n"
        "0.010214 in   fa\n"
        "1.010214 dropped 55\n"
        "1.010214 gone the other end of the line is closed\n"
        "1.010214 close\n");
}

TEST_CASE("what the log of a link holds can be read again, whatever the bytes", "[hw][link][log]") {
  const TempFolder folder;
  Bytes all(256);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  {
    LoggedLine line(folder.file("bytes"));
    must_open(*line.link);
    must_write(*line.device, all);
    CHECK(read_some(*line.link) == all);
    REQUIRE(line.link->set_line({38400}).ok());
  }
  const auto records = hw::link::read_byte_log(read_text(folder.file("bytes")));
  REQUIRE(records.has_value());
  Bytes read;
  for (const ByteRecord& record : *records) read.insert(read.end(), record.bytes.begin(), record.bytes.end());
  CHECK(read == all);
}

TEST_CASE("a clock that is set back does not make a log unreadable", "[hw][link][log]") {
  const TempFolder folder;
  {
    LoggedLine line(folder.file("bytes"));
    line.time += 5s;
    must_open(*line.link);
    line.time -= 20s;
    must_write(*line.link, {1});
  }
  CHECK(hw::link::read_byte_log(read_text(folder.file("bytes"))).has_value());
}

TEST_CASE("a log ends at its limit with a line that says so, and the link goes on", "[hw][link][log]") {
  const TempFolder folder;
  constexpr std::size_t kLimit = 1000;
  {
    LoggedLine line(folder.file("bytes"), kLimit);
    must_open(*line.link);
    for (int i = 0; i < 100; ++i) {
      must_write(*line.link, {1, 2, 3, 4});
      CHECK(read_some(*line.device).size() == 4);
    }
    CHECK_FALSE(line.link->is_logging());
  }
  const std::string text = read_text(folder.file("bytes"));
  CHECK(text.size() <= kLimit);
  CHECK(text.size() > kLimit / 2);
  const auto records = hw::link::read_byte_log(text);
  REQUIRE(records.has_value());
  CHECK(records->back().kind == ByteRecord::Kind::full);
  CHECK_THAT(records->back().text, Contains("limit of 1000 bytes"));
}

TEST_CASE("a full disk ends the log, not the link, and is said once", "[hw][link][log]") {
  const Warnings warnings;
  {
    LoggedLine line("/dev/full");
    must_open(*line.link);
    CHECK(soon([&] { return !line.link->is_logging(); }));
    for (int i = 0; i < 100; ++i) {
      must_write(*line.link, {1, 2, 3, 4});
      CHECK(read_some(*line.device).size() == 4);
    }
  }
  REQUIRE(warnings.all().size() == 1);
  CHECK_THAT(warnings.all()[0], Contains("/dev/full ends here: No space left on device"));
}

TEST_CASE("a log that cannot be begun says why", "[hw][link][log]") {
  const TempFolder folder;
  const auto now = [] { return TimePoint(); };
  const auto nowhere = ByteLog::create({folder.file("no/folder"), kPlenty, now}, "x");
  REQUIRE_FALSE(nowhere.has_value());
  CHECK(nowhere.error().code == Code::unavailable);
  CHECK_THAT(nowhere.error().text(), Contains("no/folder") && Contains("No such file"));
  const std::string input = folder.write("input", "something");
  REQUIRE(read_input_file(input, 100).has_value());
  const auto over = ByteLog::create({input, kPlenty, now}, "x");
  REQUIRE_FALSE(over.has_value());
  CHECK(over.error().code == Code::invalid_argument);
  CHECK(read_text(input) == "something");
}
