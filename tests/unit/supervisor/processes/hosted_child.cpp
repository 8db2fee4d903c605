// SPDX-License-Identifier: GPL-3.0-or-later
// A host process for tests: hosted_child WHAT [NUMBER]. It needs a control channel.
#include <fcntl.h>
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <new>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/own_process.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace {

using namespace orca;
using namespace orca::supervisor;

constexpr Duration kLong = 60s;

std::string status_line(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(name + ":")) return line;
  return {};
}

std::string description() {
  std::ostringstream text;
  text << "descriptors";
  for (int number = 0; number < 1024; ++number)
    if (fcntl(number, F_GETFD) >= 0) text << " " << number;
  text << "\nstdin " << std::filesystem::read_symlink("/proc/self/fd/0").string();
  for (const char* const name :
       {"Name", "SigBlk", "SigIgn", "SigCgt", "Cpus_allowed_list", "NoNewPrivs", "Seccomp", "CapEff"})
    text << "\n" << status_line(name);
  rlimit data{};
  getrlimit(RLIMIT_DATA, &data);
  text << "\ndata " << data.rlim_cur << "\ngroup " << getpgrp() << "\npolicy " << sched_getscheduler(0)
       << "\n";
  return text.str();
}

// Says who it is, and ends when the supervisor does.
int describe(Channel& channel) {
  set_process_name("base");
  (void)channel.send(encode(LastWordsReport{description()}), kLong);
  return channel.wait_for_message(kLong) ? 1 : 0;
}

int obey(Channel& channel) {
  for (;;) {
    auto message = channel.wait_for_message(kLong);
    if (!message) return 5;
    const std::uint64_t request = message->request;
    const auto order = decode_order(std::move(*message));
    if (!order) return 6;
    (void)channel.send(encode(Answer{}, request), kLong);
    if (std::holds_alternative<TakeDown>(*order)) return 0;
  }
}

int say_ready_and_sleep(Channel& channel, bool is_stubborn) {
  if (is_stubborn) std::signal(SIGTERM, SIG_IGN);
  (void)channel.send(encode(LastWordsReport{"ready"}), kLong);
  sleep(60);
  return 7;
}

int print() {
  std::puts("one");
  std::fflush(stdout);
  std::fputs("two\x1b[1m\n", stderr);
  std::fputs("no end", stderr);
  return 0;
}

// Nobody reads what it prints; it must not matter.
int flood(Channel& channel) {
  const std::string line(1000, 'a');
  for (int i = 0; i < 10'000; ++i) std::puts(line.c_str());
  (void)channel.send(encode(LastWordsReport{"flooded"}), kLong);
  return 0;
}

int eat() {
  std::vector<std::unique_ptr<char[]>> eaten;
  try {
    for (int i = 0; i < 4096; ++i) eaten.push_back(std::make_unique<char[]>(1 << 20));
  } catch (const std::bad_alloc&) {
    return 3;
  }
  return 0;
}

int live(const std::string& what, int number) {
  auto socket = take_channel();
  if (!socket) return std::fputs((socket.error().text() + "\n").c_str(), stderr), 8;
  Channel channel(std::move(*socket));
  if (what == "describe") return describe(channel);
  if (what == "obey") return obey(channel);
  if (what == "sleep" || what == "stubborn") return say_ready_and_sleep(channel, what == "stubborn");
  if (what == "print") return print();
  if (what == "flood") return flood(channel);
  if (what == "eat") return eat();
  if (what == "signal") raise(number);
  return number;
}

}  // namespace

int main(int argc, char** argv) {
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  return argc < 2 ? 2 : live(argv[1], argc > 2 ? std::atoi(argv[2]) : 0);
}
