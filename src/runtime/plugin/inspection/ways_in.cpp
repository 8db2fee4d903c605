// SPDX-License-Identifier: LGPL-3.0-or-later
#include "inspection/ways_in.hpp"

#include <signal.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string_view>

#include "orca/base/system/signal_name.hpp"

namespace orca::plugin {
namespace {

// The handlers are one member of a union, whichever of them it is.
std::uintptr_t handler_of(int signal) {
  struct sigaction action {};
  return sigaction(signal, nullptr, &action) == 0 ? reinterpret_cast<std::uintptr_t>(action.sa_handler) : 0;
}

}  // namespace

std::vector<std::string> ways_into(std::uintptr_t start, std::uintptr_t end) {
  std::vector<std::string> ways;
  const auto note = [&](const auto* there, const std::string& way) {
    const auto address = reinterpret_cast<std::uintptr_t>(there);
    if (address >= start && address < end) ways.push_back(way);
  };
  for (int signal = 1; signal <= SIGRTMAX; ++signal)
    note(reinterpret_cast<const void*>(handler_of(signal)), "the handler of SIG" + signal_name(signal));
  note(reinterpret_cast<const void*>(std::get_new_handler()), "std::set_new_handler()");
  note(reinterpret_cast<const void*>(std::get_terminate()), "std::set_terminate()");
  for (char** text = environ; text != nullptr && *text != nullptr; ++text)
    note(*text,
         "the environment variable " + std::string(*text).substr(0, std::string_view(*text).find('=')));
  note(stdin->_IO_buf_base, "the buffer of stdin");
  note(stdout->_IO_buf_base, "the buffer of stdout");
  note(stderr->_IO_buf_base, "the buffer of stderr");
  return ways;
}

}  // namespace orca::plugin
