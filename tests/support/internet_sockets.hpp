// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Which Internet sockets a process holds.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace orca::test {

/// Returns the local ports of the UDP or TCP sockets of this network namespace, by the name that their descriptors have in /proc.
inline std::map<std::string, std::uint16_t> sockets_of_network(const std::string& table) {
  std::map<std::string, std::uint16_t> ports;
  std::ifstream file("/proc/net/" + table);
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    const std::vector<std::string> fields{std::istream_iterator<std::string>(words), {}};
    const std::size_t colon = fields.size() > 9 ? fields[1].find(':') : std::string::npos;
    if (colon == std::string::npos) continue;
    ports["socket:[" + fields[9] + "]"] =
        static_cast<std::uint16_t>(std::stoul(fields[1].substr(colon + 1), nullptr, 16));
  }
  return ports;
}

/// Returns the local ports of a process's sockets of one kind: udp, udp6, tcp or tcp6.
inline std::vector<std::uint16_t> ports_of(pid_t pid, const std::string& table) {
  const auto sockets = sockets_of_network(table);
  std::vector<std::uint16_t> ports;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/" + std::to_string(pid) + "/fd")) {
    std::error_code gone;
    const auto found = sockets.find(std::filesystem::read_symlink(entry.path(), gone).string());
    if (found != sockets.end()) ports.push_back(found->second);
  }
  return ports;
}

}  // namespace orca::test
