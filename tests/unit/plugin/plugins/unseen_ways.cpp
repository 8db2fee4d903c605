// SPDX-License-Identifier: GPL-3.0-or-later
// The ways to the machine's time, chance and identity that cannot be seen in a plugin's file.
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "orca/component.hpp"

namespace {

long time_of_a_file() {
  struct stat file {};
  return stat("/tmp", &file) + file.st_mtim.tv_nsec;
}

long path_made_at_run_time() {
  std::string path = "modnaru/ved/";
  return std::ifstream(std::string(path.rbegin(), path.rend())).get();
}

long address_in_memory() { return reinterpret_cast<long>(std::malloc(1)); }

long environment_variable() { return std::getenv("INVOCATION_ID") != nullptr ? 1 : 0; }

long device_that_blocks() {
  char got = 0;
  return read(STDIN_FILENO, &got, 1) + got;
}

#if defined(__x86_64__)
long system_call_in_assembler() {
  long result = SYS_getpid;
  asm volatile("syscall" : "+a"(result) : : "rcx", "r11", "memory");
  return result;
}

long clock_in_assembler() {
  unsigned low = 0;
  asm volatile("rdtsc" : "=a"(low) : : "edx");
  return low;
}
#else
long system_call_in_assembler() { return 0; }
long clock_in_assembler() { return 0; }
#endif

class Sneaker final : public orca::Component {
 public:
  using Component::Component;
  orca::Outcome work() override {
    const long sum = time_of_a_file() + path_made_at_run_time() + address_in_memory() +
                     environment_variable() + device_that_blocks() + system_call_in_assembler() +
                     clock_in_assembler();
    return sum == 0 ? orca::again() : orca::done();
  }
};

}  // namespace

ORCA_COMPONENT(Sneaker, "test.Sneaker")
