// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <mutex>
#include <utility>
#include <vector>

#include "orca/base/live_line.hpp"
#include "orca/base/log_mute.hpp"
#include "orca/base/system/wall_time.hpp"
#include "orca/base/text.hpp"

namespace orca::log {
namespace {

struct State {
  std::mutex mutex;
  std::function<TimePoint()> now;
  std::shared_ptr<spdlog::logger> logger;
  std::vector<const Listener*> listeners;
  std::atomic<bool> has_listeners{false};  // spares lines that nobody wants the mutex

  State()
      : logger(std::make_shared<spdlog::logger>("orca", std::make_shared<spdlog::sinks::stderr_sink_mt>())) {
    logger->set_pattern("%v");
    logger->flush_on(spdlog::level::debug);
  }
};

// Never destroyed: threads may log while the process ends.
State& state() {
  static State* const instance = new State;
  return *instance;
}

spdlog::level::level_enum to_spdlog(Level level) {
  switch (level) {
    case Level::debug: return spdlog::level::debug;
    case Level::info: return spdlog::level::info;
    case Level::warning: return spdlog::level::warn;
    case Level::error: return spdlog::level::err;
    case Level::off: break;
  }
  return spdlog::level::off;
}

std::string text_of(std::chrono::system_clock::time_point time) {
  const auto ms = std::chrono::floor<std::chrono::milliseconds>(time.time_since_epoch()).count();
  const std::time_t seconds = ms / 1000;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  std::array<char, 40> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &utc);
  std::snprintf(text.data() + size, text.size() - size, ".%03dZ", static_cast<int>(ms % 1000));
  return text.data();
}

std::string_view name(Level level) {
  constexpr std::string_view kNames[] = {"debug", "info", "warning", "error", "off"};
  return kNames[static_cast<int>(level)];
}

}  // namespace

Result<Level> parse_level(std::string_view text) {
  for (const Level level : {Level::debug, Level::info, Level::warning, Level::error, Level::off})
    if (text == name(level)) return level;
  return fail(Code::invalid_argument,
              "unknown log level '" + std::string(text) + "'; it is one of debug, info, warning, error, off");
}

void set_level(Level level) { state().logger->set_level(to_spdlog(level)); }

void set_clock(std::function<TimePoint()> now) {
  const std::lock_guard lock(state().mutex);
  state().now = std::move(now);
}

std::string wall_time_text() { return text_of(std::chrono::system_clock::now()); }

std::string wall_time_text(TimePoint moment) {
  const std::lock_guard lock(state().mutex);
  const Duration age = state().now ? state().now() - moment : Duration{0};
  return text_of(std::chrono::system_clock::now() -
                 std::chrono::duration_cast<std::chrono::system_clock::duration>(age));
}

Listener::Listener(std::function<void(const Line&)> heard) : heard_(std::move(heard)) {
  const std::lock_guard lock(state().mutex);
  state().listeners.push_back(this);
  state().has_listeners = true;
}

Listener::~Listener() {
  const std::lock_guard lock(state().mutex);
  std::erase(state().listeners, this);
  state().has_listeners = !state().listeners.empty();
}

void write(Level level, std::string_view who, std::string_view words) {
  if (is_muted()) return;
  constexpr std::size_t kMost = 64 * 1024;  // [bytes] of a line; whoever writes more has made a mistake
  const std::string cut = words.size() > kMost ? shortened(words, kMost) : std::string();
  if (!cut.empty()) words = cut;
  State& s = state();
  const bool shown = s.logger->should_log(to_spdlog(level));
  if (!shown && !s.has_listeners) return;
  const std::string text = shown ? printable(words) : std::string();
  const std::lock_guard lock(s.mutex);
  const TimePoint now = s.now ? s.now() : TimePoint{};
  for (const Listener* listener : s.listeners) listener->heard_({level, who, words, now});
  if (!shown) return;
  const LiveLine::Pause room;
  if (s.now) {
    s.logger->log(to_spdlog(level), "[{:10.3f}] {:<7} {}: {}", to_seconds(now), name(level), who, text);
  } else {
    s.logger->log(to_spdlog(level), "{}: {}: {}", name(level), who, text);
  }
}

}  // namespace orca::log
