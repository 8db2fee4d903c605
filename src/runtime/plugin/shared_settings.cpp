// SPDX-License-Identifier: LGPL-3.0-or-later
#include "shared_settings.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <clocale>
#include <iterator>

namespace orca::plugin {
namespace {

// Returns the umask, which the system reports only to whoever sets it.
mode_t present_umask() {
  const mode_t present = umask(077);
  umask(present);
  return present;
}

std::string present_locale() {
  const char* const name = std::setlocale(LC_ALL, nullptr);
  return name != nullptr ? name : "C";
}

}  // namespace

SharedSettings::SharedSettings()
    : folder_(open(".", O_PATH | O_DIRECTORY | O_CLOEXEC)),
      umask_(present_umask()),
      locale_(present_locale()) {}

std::vector<std::string> SharedSettings::put_back() const {
  std::vector<std::string> changed;
  struct stat before {
  }, now{};
  const bool has_moved = folder_ && fstat(folder_.number(), &before) == 0 && stat(".", &now) == 0 &&
                         (before.st_ino != now.st_ino || before.st_dev != now.st_dev);
  if (has_moved && fchdir(folder_.number()) == 0) changed.emplace_back("the working folder");
  if (umask(umask_) != umask_) changed.emplace_back("the umask");
  if (present_locale() != locale_) {
    (void)std::setlocale(LC_ALL, locale_.c_str());
    changed.emplace_back("the locale");
  }
  std::ranges::move(streams_.changes(), std::back_inserter(changed));
  streams_.restore();
  return changed;
}

}  // namespace orca::plugin
