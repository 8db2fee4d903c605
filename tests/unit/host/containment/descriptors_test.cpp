// SPDX-License-Identifier: GPL-3.0-or-later
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
  CHECK(before->at(fd).name == name);
  REQUIRE(std::rename(name.c_str(), folder.file("log.1").c_str()) == 0);
  const auto after = open_descriptors();
  REQUIRE(after);
  CHECK(after->at(fd) == before->at(fd));
  CHECK(after->at(fd).name == folder.file("log.1"));
  close(fd);
  CHECK_FALSE(open_descriptors()->contains(fd));
}

TEST_CASE("open descriptors cannot be listed when no descriptor is free", "[host][descriptors]") {
  REQUIRE(open_descriptors());
  const NoDescriptorsLeft none;
  CHECK_FALSE(open_descriptors());
}

TEST_CASE("only the first of many descriptors are named", "[host][descriptors]") {
  Descriptors many;
  for (int fd = 3; fd < 5; ++fd) many[fd] = {0, 0, "/dev/null"};
  CHECK(names_of(many) == "3 (/dev/null), 4 (/dev/null)");
  for (int fd = 5; fd < 100; ++fd) many[fd] = {0, 0, "x"};
  CHECK(names_of(many) ==
        "3 (/dev/null), 4 (/dev/null), 5 (x), 6 (x), 7 (x), 8 (x), 9 (x), 10 (x) and 89 more");
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
