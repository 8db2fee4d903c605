// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>

#include "containment/descriptors.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::host;
using orca::test::TempFolder;

namespace {

// Lets the process open nothing more while this object lives.
class NoDescriptorsLeft {
 public:
  NoDescriptorsLeft() {
    getrlimit(RLIMIT_NOFILE, &before_);
    const int lowest_free = dup(STDIN_FILENO);
    close(lowest_free);
    const rlimit none{static_cast<rlim_t>(lowest_free), before_.rlim_max};
    setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoDescriptorsLeft() { setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("open descriptors are reported with their names, and stay the same after a rename",
          "[host][descriptors]") {
  const TempFolder folder;
  const std::string name = folder.file("log");
  const int fd = open(name.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  REQUIRE(fd >= 0);
  const auto before = open_descriptors();
  REQUIRE(before);
  REQUIRE(before->contains(fd));
  CHECK(names_of({{fd, before->at(fd)}}) == std::to_string(fd) + " (" + name + ")");
  REQUIRE(std::rename(name.c_str(), folder.file("log.1").c_str()) == 0);
  const auto after = open_descriptors();
  REQUIRE(after);
  CHECK(after->at(fd) == before->at(fd));
  CHECK(names_of({{fd, after->at(fd)}}) == std::to_string(fd) + " (" + folder.file("log.1") + ")");
  close(fd);
  CHECK_FALSE(open_descriptors()->contains(fd));
}

TEST_CASE("open descriptors cannot be listed when no descriptor is free", "[host][descriptors]") {
  REQUIRE(open_descriptors());
  const NoDescriptorsLeft none;
  CHECK_FALSE(open_descriptors());
}

TEST_CASE("only the first of many descriptors are named", "[host][descriptors]") {
  std::vector<int> opened;
  Descriptors many;
  for (int i = 0; i < 97; ++i) {
    opened.push_back(open("/dev/null", O_RDONLY | O_CLOEXEC));
    REQUIRE(opened.back() >= 0);
    many[opened.back()] = {};
    if (i != 1) continue;
    CHECK(names_of(many) ==
          std::to_string(opened[0]) + " (/dev/null), " + std::to_string(opened[1]) + " (/dev/null)");
  }
  std::string first;
  for (int i = 0; i < 8; ++i) first += (i == 0 ? "" : ", ") + std::to_string(opened[i]) + " (/dev/null)";
  CHECK(names_of(many) == first + " and 89 more");
  for (const int fd : opened) close(fd);
}

TEST_CASE("a standard stream that was redirected is named with its new file, and restored",
          "[host][descriptors]") {
  const TempFolder folder;
  const std::string name = folder.file("stolen");
  OwnDescriptors own;
  own.remember();
  CHECK(own.restore_redirected().empty());
  const int fd = open(name.c_str(), O_CREAT | O_WRONLY | O_CLOEXEC, 0600);
  dup2(fd, STDOUT_FILENO);
  CHECK(own.restore_redirected() == "stdout to " + name);
  CHECK(own.restore_redirected().empty());
  CHECK(open_descriptors()->at(STDOUT_FILENO) != open_descriptors()->at(fd));
  close(fd);
}

TEST_CASE("a redirected stream whose copy is gone, too, is named once and stays as it is",
          "[host][descriptors]") {
  const int kept = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0);
  OwnDescriptors own;
  own.remember();
  const int fd = open("/dev/zero", O_RDONLY | O_CLOEXEC);
  for (int high = 900; high < 1000; ++high) close(high);
  dup2(fd, STDIN_FILENO);
  const std::string said = own.restore_redirected();
  const std::string again = own.restore_redirected();
  own.release();
  dup2(kept, STDIN_FILENO);
  close(kept);
  close(fd);
  CHECK(said == "stdin to /dev/zero, and the way back is closed");
  CHECK(again.empty());
}

TEST_CASE("the lowest free descriptor may be that of a closed standard input, and stays free",
          "[host][descriptors]") {
  OwnDescriptors own;
  own.remember();
  const int kept = dup(STDIN_FILENO);
  close(STDIN_FILENO);
  const int lowest = own.lowest_free();
  const bool is_free = fcntl(STDIN_FILENO, F_GETFD) < 0;
  const bool all_open = own.all_open();
  dup2(kept, STDIN_FILENO);
  close(kept);
  CHECK(lowest == STDIN_FILENO);
  CHECK(is_free);
  CHECK_FALSE(all_open);
  CHECK(own.all_open());
  own.release();
}
