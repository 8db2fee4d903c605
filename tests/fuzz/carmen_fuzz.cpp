// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give an error or a log; its times never run backwards, and what is written of it is read again as the same.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "orca/recording/carmen/log.hpp"

namespace {

using namespace orca::carmen;

orca::Result<Log> read(std::string_view text) {
  return read_log([&, rest = text]() mutable {
    const std::string_view next = rest.substr(0, 61);
    rest.remove_prefix(next.size());
    return next;
  });
}

void demand(bool what) {
  if (!what) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const orca::Result<Log> log = read({reinterpret_cast<const char*>(data), size});
  if (!log) {
    demand(!log.error().message.empty());
    return 0;
  }
  orca::Duration last = orca::Duration::min();
  std::size_t line = 0;
  for (const Entry& entry : log->entries) {
    demand(entry.passed >= last && entry.sensed <= entry.passed && entry.line > line);
    last = entry.passed;
    line = entry.line;
    // Directions are wrapped where they are read, so the first text may lie beyond the half turn.
    const orca::Result<Line> once = read_line(to_text(entry.what));
    demand(once.has_value());
    const orca::Result<Line> twice = read_line(to_text(*once));
    demand(twice && to_text(*twice) == to_text(*once));
  }
  for (const Laser laser : {Laser::front, Laser::rear}) {
    demand(std::isfinite(max_range_of(*log, laser)));
    demand(std::isfinite(mount_of(*log, laser).x));
  }
  (void)log->flaws.texts();
  return 0;
}
