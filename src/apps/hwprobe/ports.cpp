// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "ports.hpp"

#include <fcntl.h>
#include <linux/serial.h>
#include <sys/ioctl.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>
#include <string_view>

#include "orca/base/descriptor.hpp"

namespace orca::hwprobe {
namespace {

namespace fs = std::filesystem;

// Returns the paths in a folder, sorted; none if there is no such folder.
std::vector<fs::path> entries(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code failure;
  for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end; entry.increment(failure))
    found.push_back(entry->path());
  std::sort(found.begin(), found.end());
  return found;
}

bool is_adapter(const std::string& name) {
  constexpr std::array<std::string_view, 3> kNames{"ttyUSB", "ttyACM", "rfcomm"};
  return std::ranges::any_of(kNames, [&](std::string_view begin) { return name.starts_with(begin); });
}

// The system has files for ports that the board does not have. One that may not be opened is told by whoever tries.
bool is_port_of_board(const fs::path& path) {
  if (!path.filename().string().starts_with("ttyS")) return false;
  const Descriptor port(::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC));
  serial_struct facts{};
  return port && ioctl(port.number(), TIOCGSERIAL, &facts) == 0 && facts.type != PORT_UNKNOWN;
}

}  // namespace

std::vector<std::string> serial_ports(const std::string& folder) {
  std::vector<std::string> ports;
  std::set<fs::path> known;
  std::error_code failure;
  for (const fs::path& name : entries(fs::path(folder) / "serial/by-id")) {
    ports.push_back(name.string());
    known.insert(fs::canonical(name, failure));
  }
  for (const fs::path& path : entries(folder)) {
    const bool counts = is_adapter(path.filename().string()) || is_port_of_board(path);
    if (counts && !known.contains(fs::canonical(path, failure))) ports.push_back(path.string());
  }
  return ports;
}

}  // namespace orca::hwprobe
