// SPDX-License-Identifier: GPL-3.0-or-later
#include "process_table.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

namespace orca::test {
namespace {

namespace fs = std::filesystem;

struct Entry {
  std::string name;
  char state = 'Z';
  pid_t parent = 0;
  pid_t group = 0;
};

std::string folder_of(pid_t process) { return "/proc/" + std::to_string(process); }

std::optional<Entry> entry_of(pid_t process) {
  std::ifstream file(folder_of(process) + "/stat");
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  const std::size_t begin = line.find('(');
  const std::size_t end = line.rfind(')');  // the name may hold any character
  Entry entry;
  entry.name = line.substr(begin + 1, end - begin - 1);
  std::istringstream rest(line.substr(end + 1));
  rest >> entry.state >> entry.parent >> entry.group;
  return entry;
}

std::size_t count(const std::string& folder) {
  std::error_code error;
  const fs::directory_iterator files(folder, error);
  return error ? 0 : static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

}  // namespace

std::map<std::string, pid_t> children_of(pid_t parent) {
  std::map<std::string, pid_t> children;
  std::ifstream file(folder_of(parent) + "/task/" + std::to_string(parent) + "/children");
  for (pid_t child = 0; file >> child;)
    if (const auto entry = entry_of(child); entry && entry->state != 'Z') children[entry->name] = child;
  return children;
}

std::vector<std::string> living_in_group(pid_t group) {
  std::vector<std::string> names;
  for (const fs::directory_entry& folder : fs::directory_iterator("/proc")) {
    const pid_t process = std::atoi(folder.path().filename().c_str());
    const auto entry = process > 0 ? entry_of(process) : std::nullopt;
    if (entry && entry->group == group && entry->state != 'Z')
      names.push_back(entry->name + " " + std::to_string(process));
  }
  return names;
}

bool is_alive(pid_t process) {
  const auto entry = entry_of(process);
  return entry && entry->state != 'Z';
}

std::size_t descriptors_of(pid_t process) { return count(folder_of(process) + "/fd"); }

std::size_t threads_of(pid_t process) { return count(folder_of(process) + "/task"); }

Seconds cpu_time_of(pid_t process) {
  std::error_code error;
  double nanoseconds = 0.0;
  for (const fs::directory_entry& thread : fs::directory_iterator(folder_of(process) + "/task", error)) {
    double own = 0.0;
    if (std::ifstream(thread.path() / "schedstat") >> own) nanoseconds += own;
  }
  return Seconds(1e-9 * nanoseconds);
}

std::vector<std::string> kept_by_system() {
  std::vector<std::string> kept;
  std::error_code error;
  for (const fs::directory_entry& file : fs::directory_iterator("/dev/shm", error))
    kept.push_back(file.path().string());
  std::erase_if(kept, [](const std::string& name) { return name.find("orca") == std::string::npos; });
  // Other test programs run beside this one, each with a folder of its own.
  const char* const own = std::getenv("XDG_RUNTIME_DIR");
  std::ifstream sockets("/proc/net/unix");
  for (std::string line; own != nullptr && std::getline(sockets, line);)
    if (line.find(std::string(own) + "/orca/") != std::string::npos)
      kept.push_back(line.substr(line.find('/')));
  std::ranges::sort(kept);
  return kept;
}

}  // namespace orca::test
