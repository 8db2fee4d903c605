// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/shared_memory.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace orca;

TEST_CASE("two mappings of a memory file show the same bytes, zero at first", "[base][shared_memory]") {
  const MemoryFile file = MemoryFile::create("test", 10'000).value();
  const SharedMemory one = SharedMemory::map(file.descriptor()).value();
  const SharedMemory other = SharedMemory::map(file.descriptor()).value();
  REQUIRE(one.bytes().size() == 10'000);
  REQUIRE(other.bytes().size() == 10'000);
  CHECK(one.bytes().data() != other.bytes().data());
  CHECK(std::all_of(one.bytes().begin(), one.bytes().end(), [](std::byte b) { return b == std::byte{0}; }));
  one.bytes()[9'999] = std::byte{7};
  CHECK(other.bytes()[9'999] == std::byte{7});
}

TEST_CASE("nobody can change the size of a memory file, or take that promise back", "[base][shared_memory]") {
  const MemoryFile file = MemoryFile::create("test", 8192).value();
  CHECK(ftruncate(file.descriptor(), 4096) == -1);
  CHECK(ftruncate(file.descriptor(), 16384) == -1);
  CHECK(fcntl(file.descriptor(), F_ADD_SEALS, F_SEAL_WRITE) == -1);
  CHECK((fcntl(file.descriptor(), F_GETFD) & FD_CLOEXEC) != 0);
}

TEST_CASE("a program whose standard input is closed has memory files, too", "[base][shared_memory]") {
  const int input = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
  if (input >= 0) close(STDIN_FILENO);
  {
    const auto file = MemoryFile::create("test", 4096);
    CHECK(file);
    if (file) CHECK(file->descriptor() == STDIN_FILENO);
  }
  CHECK(fcntl(STDIN_FILENO, F_GETFD) == -1);  // it was closed
  if (input >= 0) REQUIRE(dup2(input, STDIN_FILENO) == STDIN_FILENO);
  if (input >= 0) close(input);
}

TEST_CASE("a mapping outlives the descriptor and a move", "[base][shared_memory]") {
  auto file = std::make_optional(MemoryFile::create("test", 4096).value());
  const int descriptor = file->descriptor();
  SharedMemory first = SharedMemory::map(descriptor).value();
  file.reset();
  CHECK(fcntl(descriptor, F_GETFD) == -1);
  const std::byte* const place = first.bytes().data();
  const SharedMemory second = std::move(first);
  CHECK(second.bytes().data() == place);
  second.bytes()[0] = std::byte{1};
}

TEST_CASE("what could shrink is not mapped", "[base][shared_memory]") {
  const auto refused = [](int descriptor) {
    const auto mapped = SharedMemory::map(descriptor);
    return !mapped && mapped.error().code == Code::invalid_argument;
  };
  const int unsealed = memfd_create("unsealed", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  REQUIRE(ftruncate(unsealed, 4096) == 0);
  CHECK(refused(unsealed));
  REQUIRE(fcntl(unsealed, F_ADD_SEALS, F_SEAL_GROW) == 0);
  CHECK(refused(unsealed));
  REQUIRE(fcntl(unsealed, F_ADD_SEALS, F_SEAL_SHRINK) == 0);
  CHECK_FALSE(refused(unsealed));
  close(unsealed);
  int ends[2];
  REQUIRE(pipe2(ends, O_CLOEXEC) == 0);
  CHECK(refused(ends[0]));
  close(ends[0]);
  close(ends[1]);
  CHECK(refused(ends[0]));
  CHECK(refused(-1));
}

TEST_CASE("a copy of the process, in which code is tried out, cannot reach shared memory",
          "[base][shared_memory]") {
  const auto file = MemoryFile::create("test", 4096);
  REQUIRE(file);
  const auto memory = SharedMemory::map(file->descriptor());
  REQUIRE(memory);
  const pid_t copy = fork();
  if (copy == 0) {
    signal(SIGSEGV, SIG_DFL);
    *static_cast<volatile std::byte*>(memory->bytes().data()) = std::byte{1};
    _exit(0);
  }
  int status = 0;
  REQUIRE(waitpid(copy, &status, 0) == copy);
  CHECK_FALSE((WIFEXITED(status) && WEXITSTATUS(status) == 0));
  CHECK(memory->bytes()[0] == std::byte{0});
}
