// SPDX-License-Identifier: GPL-3.0-or-later
#include "executives.hpp"

#include <catch2/catch.hpp>

#include <exception>

namespace orca::test {
namespace {

#if defined(__SANITIZE_THREAD__)
constexpr bool kFibersWork = false;
#else
constexpr bool kFibersWork = true;
#endif

void say_what_is_left_out() {
  static bool said = false;
  if (kFibersWork || said) return;
  said = true;
  WARN("fibers are left out: ThreadSanitizer does not support them; batons run, which are scheduled alike");
}

}  // namespace

std::vector<ExecutiveOptions> all_executives() {
  std::vector<ExecutiveOptions> kinds{{ClockKind::steady, Backend::thread},
                                      {ClockKind::steady, Backend::baton},
                                      {ClockKind::virtual_time, Backend::baton}};
  if (kFibersWork) {
    kinds.push_back({ClockKind::steady, Backend::fiber});
    kinds.push_back({ClockKind::virtual_time, Backend::fiber});
  }
  say_what_is_left_out();
  return kinds;
}

std::vector<ExecutiveOptions> virtual_executives() {
  std::vector<ExecutiveOptions> kinds = all_executives();
  std::erase_if(kinds, [](const ExecutiveOptions& kind) { return kind.clock == ClockKind::steady; });
  return kinds;
}

std::vector<ExecutiveOptions> steady_executives() {
  std::vector<ExecutiveOptions> kinds = all_executives();
  std::erase_if(kinds, [](const ExecutiveOptions& kind) { return kind.clock != ClockKind::steady; });
  return kinds;
}

std::string name_of(const ExecutiveOptions& options) {
  const char* const backend = options.backend == Backend::thread  ? "thread"
                              : options.backend == Backend::fiber ? "fiber"
                                                                  : "baton";
  return std::string(backend) + (options.clock == ClockKind::steady ? ", steady" : ", virtual");
}

void run_on(const ExecutiveOptions& options, const std::function<void(Executive&)>& body) {
  const auto executive = make_executive(options).value();
  // A task must not throw, so the exception of a REQUIRE is carried out of it.
  std::exception_ptr thrown;
  executive->run([&] {
    try {
      body(*executive);
    } catch (...) {
      thrown = std::current_exception();
    }
  });
  if (thrown) std::rethrow_exception(thrown);
}

void run_on_each(const std::vector<ExecutiveOptions>& kinds, const std::function<void(Executive&)>& body) {
  for (const ExecutiveOptions& kind : kinds) {
    INFO("on the executive: " << name_of(kind));
    run_on(kind, body);
  }
}

bool eventually(Executive& executive, const std::function<bool()>& condition) {
  const TimePoint deadline = executive.now() + 5s;
  while (!condition()) {
    if (executive.now() >= deadline) return false;
    sleep(executive, 1ms);
  }
  return true;
}

}  // namespace orca::test
