// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plugin_threads.hpp"

#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

namespace orca::plugin {
namespace {

struct Where {
  std::uintptr_t stack = 0;
  std::uintptr_t code = 0;
};

// Returns where a thread sleeps; nothing while it runs, or after its end.
std::optional<Where> where_asleep(const std::string& task) {
  std::ifstream file(task + "/syscall");  // "NUMBER ARGUMENTS... STACK CODE", "-1 STACK CODE" or "running"
  std::string line;
  std::getline(file, line);
  std::istringstream words(line);
  std::vector<std::string> all;
  for (std::string word; words >> word;) all.push_back(word);
  if (all.size() < 3) return std::nullopt;
  return Where{std::stoul(all[all.size() - 2], nullptr, 16), std::stoul(all.back(), nullptr, 16)};
}

// Returns the end of the mapping that contains an address.
std::uintptr_t end_of_mapping(std::uintptr_t address) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::size_t dash = 0;
    const std::uintptr_t start = std::stoul(line, &dash, 16);
    const std::uintptr_t end = std::stoul(line.substr(dash + 1), nullptr, 16);
    if (address >= start && address < end) return end;
  }
  return address;
}

// Returns the words of a stack, from its top. The thread may go on or end meanwhile, so the system copies
// what is there.
std::vector<std::uintptr_t> stack_of(const Where& where) {
  constexpr std::size_t kMost = 1024 * 1024;
  const std::size_t size = std::min<std::size_t>(end_of_mapping(where.stack) - where.stack, kMost);
  std::vector<std::uintptr_t> words(size / sizeof(std::uintptr_t));
  const iovec to{words.data(), words.size() * sizeof(std::uintptr_t)};
  const iovec from{reinterpret_cast<void*>(where.stack), to.iov_len};
  const ssize_t copied = process_vm_readv(getpid(), &to, 1, &from, 1, 0);
  words.resize(copied > 0 ? static_cast<std::size_t>(copied) / sizeof(std::uintptr_t) : 0);
  return words;
}

bool may_run_in(const std::string& task, std::uintptr_t start, std::uintptr_t end) {
  constexpr int kPatienceMs = 100;
  const auto inside = [&](std::uintptr_t address) { return address >= start && address < end; };
  for (int i = 0; i < kPatienceMs; ++i) {
    if (const auto where = where_asleep(task))
      return inside(where->code) || std::ranges::any_of(stack_of(*where), inside);
    if (!std::filesystem::exists(task)) return false;
    usleep(1000);
  }
  return std::ifstream(task + "/syscall").good();  // it has never slept
}

}  // namespace

bool threads_may_run_in(std::uintptr_t start, std::uintptr_t end) {
  std::error_code unused;
  const std::string own = std::to_string(gettid());
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", unused))
    if (task.path().filename() != own && may_run_in(task.path().string(), start, end)) return true;
  return false;
}

}  // namespace orca::plugin
