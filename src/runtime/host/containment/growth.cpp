// SPDX-License-Identifier: LGPL-3.0-or-later
#include "growth.hpp"

#include <algorithm>
#include <fstream>

namespace orca::host {

void Growth::start(int taken) {
  first_ = last_ = taken;
  by_who_.clear();
}

int Growth::take(const std::string& who, int taken) {
  int& own = by_who_[who];
  own = std::max(0, own + taken - last_);
  last_ = taken;
  return own;
}

int count_memory_pages() {
  // proc(5): size, resident, shared, text, lib, data.
  std::ifstream sizes("/proc/self/statm");
  long fields[6] = {};
  for (long& field : fields) sizes >> field;
  return static_cast<int>(fields[5]);
}

}  // namespace orca::host
