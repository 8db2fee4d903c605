// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <unistd.h>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/log.hpp"

using namespace orca;
using Catch::Contains;

namespace {

const std::vector<std::string> kLevels{"debug", "info", "warning", "error"};

// Returns what is written to stderr meanwhile.
template <class Action>
std::string captured(Action act) {
  const std::unique_ptr<FILE, int (*)(FILE*)> file(std::tmpfile(), std::fclose);
  const int before = dup(STDERR_FILENO);
  dup2(fileno(file.get()), STDERR_FILENO);
  act();
  std::fflush(stderr);
  dup2(before, STDERR_FILENO);
  close(before);
  std::rewind(file.get());
  std::string text(10'000, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), file.get()));
  return text;
}

void write_at_all_levels() {
  for (const std::string& level : kLevels) log::write(*log::parse_level(level), "avoid", "at " + level);
}

}  // namespace

TEST_CASE("every log level is read by its name, and others are refused with these names", "[base][log]") {
  CHECK(*log::parse_level("debug") == log::Level::debug);
  CHECK(*log::parse_level("info") == log::Level::info);
  CHECK(*log::parse_level("warning") == log::Level::warning);
  CHECK(*log::parse_level("error") == log::Level::error);
  CHECK(*log::parse_level("off") == log::Level::off);
  CHECK_THAT(log::parse_level("warn").error().text(), Contains("'warn'") && Contains("debug, info, warning"));
}

TEST_CASE("a line has its level, the name of who wrote it, and the time of the run if there is a clock",
          "[base][log]") {
  CHECK(captured([] { log::warning("avoid", "deaf"); }) == "warning: avoid: deaf\n");
  log::set_clock([] { return TimePoint(1500ms); });
  CHECK(captured([] { log::error("avoid", "deaf"); }) == "[     1.500] error   avoid: deaf\n");
  log::set_clock(nullptr);
}

TEST_CASE("only lines of the chosen level and above are written", "[base][log]") {
  for (std::size_t lowest = 0; lowest < kLevels.size(); ++lowest) {
    log::set_level(*log::parse_level(kLevels[lowest]));
    const std::string text = captured(write_at_all_levels);
    for (std::size_t i = 0; i < kLevels.size(); ++i)
      CHECK((text.find("at " + kLevels[i]) != std::string::npos) == (i >= lowest));
  }
  log::set_level(log::Level::off);
  CHECK(captured(write_at_all_levels).empty());
  log::set_level(log::Level::info);
}

TEST_CASE("a listener hears every line while it lives, whatever level is written", "[base][log]") {
  std::vector<std::string> heard;
  log::set_level(log::Level::off);
  log::set_clock([] { return TimePoint(2s); });
  {
    const log::Listener listener([&](const log::Line& line) {
      heard.push_back(std::string(line.who) + ": " + std::string(line.text) + " " +
                      std::to_string(static_cast<int>(line.level)) + " " +
                      std::to_string(to_seconds(line.time)));
    });
    CHECK(captured([] { log::debug("avoid", "deaf"); }).empty());
  }
  log::debug("avoid", "too late");
  log::set_clock(nullptr);
  log::set_level(log::Level::info);
  CHECK(heard == std::vector<std::string>{"avoid: deaf 0 2.000000"});
}
