// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <vector>

#include "containment/descriptor_watch.hpp"
#include "temp_folder.hpp"

using namespace orca::host;
using orca::test::TempFolder;

namespace {

// Descriptors of one file, closed at the end at the latest.
class Opened {
 public:
  Opened(const std::string& file, int count) {
    while (count-- > 0) fds_.push_back(open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600));
  }
  ~Opened() { close_all(); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  void close_all() {
    for (const int fd : fds_) close(fd);
    fds_.clear();
  }

 private:
  std::vector<int> fds_;
};

// Takes away a descriptor of the process while it lives.
class Missing {
 public:
  explicit Missing(int fd) : fd_(fd), copy_(fcntl(fd, F_DUPFD_CLOEXEC, 100)) { close(fd); }
  ~Missing() {
    dup2(copy_, fd_);
    close(copy_);
  }
  Missing(const Missing&) = delete;
  Missing& operator=(const Missing&) = delete;

 private:
  int fd_;
  int copy_;
};

}  // namespace

TEST_CASE("descriptors count for whoever opens them while many are open already", "[host][descriptors]") {
  const TempFolder folder;
  const std::string who = "camera";
  DescriptorWatch watch;
  watch.keep();
  const Opened outside(folder.file("outside"), 40);
  CHECK_FALSE(watch.look(&who));  // from now on each one counts
  CHECK(watch.is_crowded());
  const Opened few(folder.file("few"), 31);
  CHECK_FALSE(watch.look(&who));
  const Opened one(folder.file("one"), 1);
  const auto found = watch.look(&who);
  REQUIRE(found);
  CHECK_THAT(found->deed, Catch::Contains("opened 32 descriptors and not closed them"));
  watch.let_go();
}

TEST_CASE("once the many are closed, counting begins anew with the next many", "[host][descriptors]") {
  const TempFolder folder;
  const std::string who = "camera";
  DescriptorWatch watch;
  watch.keep();
  Opened before(folder.file("before"), 40);
  CHECK_FALSE(watch.look(nullptr));
  before.close_all();
  CHECK_FALSE(watch.look(&who));
  const Opened after(folder.file("after"), 40);  // nobody can tell in whose turn all of these came
  CHECK_FALSE(watch.look(&who));
  CHECK_FALSE(watch.look(&who));
  watch.let_go();
}

TEST_CASE("a standard descriptor that somebody closes is missed", "[host][descriptors]") {
  OwnDescriptors own;
  own.remember();
  CHECK(own.all_open());
  {
    const Missing input(STDIN_FILENO);
    CHECK_FALSE(own.all_open());
  }
  CHECK(own.all_open());
  own.release();
}

TEST_CASE(
    "what is opened to look with is closed again, also when it takes the place of a standard descriptor",
    "[host][descriptors]") {
  const Missing input(STDIN_FILENO);
  OwnDescriptors own;
  own.remember();
  CHECK(fcntl(STDIN_FILENO, F_GETFD) >= 0);
  CHECK(own.all_open());
  own.release();
  CHECK(fcntl(STDIN_FILENO, F_GETFD) < 0);
}
