// SPDX-License-Identifier: LGPL-3.0-or-later
#include <mutex>
#include <set>
#include <string>

#include "orca/base/log.hpp"
#include "orca/base/mutex.hpp"
#include "orca/dds/gate.hpp"

namespace orca::dds {
namespace {

constexpr std::size_t kMostComplaints = 100;

// Returns whether a complaint is a new one. A stranger who tries again and again would otherwise fill the log.
bool is_new(const std::string& message) {
  static Mutex mutex;
  static std::set<std::string> known;
  const MutexLock lock(mutex);
  return known.size() < kMostComplaints && known.insert(message).second;
}

}  // namespace

void log_complaint(const std::string& category, const std::string& message) {
  if (category.starts_with("SECURITY") && is_new(message))
    log::warning("security", "Fast DDS says: " + message);
  else
    log::debug("Fast DDS", message);
}

}  // namespace orca::dds
