// SPDX-License-Identifier: GPL-3.0-or-later
#include <sys/resource.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <string>

#include "log_server/log_file.hpp"
#include "orca/base/input_file.hpp"
#include "temp_folder.hpp"

using orca::logs::LogFile;
using orca::test::read_text;
using orca::test::TempFolder;

namespace {

// Lets no file of this process grow beyond that many bytes, as a full disk does, while this object lives.
class FullDisk {
 public:
  explicit FullDisk(rlim_t most_bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit full{most_bytes, before_.rlim_max};
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &full);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

}  // namespace

TEST_CASE("lines are added at the end of what is there", "[components][log]") {
  const TempFolder folder;
  const std::string path = folder.file("log");
  for (const char* text : {"one", "two"}) {
    LogFile file(path, 1000, 2);
    REQUIRE(file.open().ok());
    CHECK(file.append(text));
  }
  CHECK(read_text(path) == "one\ntwo\n");
}

TEST_CASE("a line stays one line, whatever it holds", "[components][log]") {
  const TempFolder folder;
  LogFile file(folder.file("log"), 1000, 2);
  REQUIRE(file.open().ok());
  CHECK(file.append("a\nb\r\nc"));
  CHECK(read_text(folder.file("log")) == "a\\nb\\r\\nc\n");
}

TEST_CASE("a file that would grow too large becomes an old one, and the oldest goes", "[components][log]") {
  const TempFolder folder;
  const std::string path = folder.file("log");
  LogFile file(path, 12, 2);
  REQUIRE(file.open().ok());
  for (int i = 1; i <= 9; ++i) CHECK(file.append("line" + std::to_string(i)));  // 6 bytes each
  CHECK(read_text(path) == "line9\n");
  CHECK(read_text(path + ".1") == "line7\nline8\n");
  CHECK(read_text(path + ".2") == "line5\nline6\n");
  CHECK_FALSE(std::filesystem::exists(path + ".3"));
  CHECK(file.written() == 9);
  CHECK(file.lost() == 0);
}

TEST_CASE("with no old files to keep the file begins anew", "[components][log]") {
  const TempFolder folder;
  LogFile file(folder.file("log"), 12, 0);
  REQUIRE(file.open().ok());
  for (int i = 1; i <= 3; ++i) CHECK(file.append("line" + std::to_string(i)));
  CHECK(read_text(folder.file("log")) == "line3\n");
  CHECK_FALSE(std::filesystem::exists(folder.file("log.1")));
}

TEST_CASE("a line longer than a file may be is kept in a file of its own", "[components][log]") {
  const TempFolder folder;
  LogFile file(folder.file("log"), 12, 1);
  REQUIRE(file.open().ok());
  CHECK(file.append("short"));
  CHECK(file.append(std::string(40, 'x')));
  CHECK(read_text(folder.file("log")) == std::string(40, 'x') + "\n");
  CHECK(read_text(folder.file("log.1")) == "short\n");
}

TEST_CASE("on a full disk lines are lost whole and counted, and a later line gives their number",
          "[components][log]") {
  const TempFolder folder;
  const std::string path = folder.file("log");
  LogFile file(path, 10000, 1);
  REQUIRE(file.open().ok());
  CHECK(file.append("before"));
  {
    const FullDisk full(10);
    CHECK_FALSE(file.append("lost one"));
    CHECK_FALSE(file.append("lost two"));
  }
  CHECK(file.append("after"));
  CHECK(read_text(path) == "before\n2 lines were lost: they could not be written\nafter\n");
  CHECK(file.lost() == 2);
}

TEST_CASE("on a device that accepts no data every line is lost, and nothing stops", "[components][log]") {
  LogFile file("/dev/full", 10000, 1);
  REQUIRE(file.open().ok());
  for (int i = 0; i < 100; ++i) CHECK_FALSE(file.append("line"));
  CHECK(file.lost() == 100);
}

TEST_CASE("no line is added to a file that has been read, such as the graph", "[components][log]") {
  const TempFolder folder;
  const std::string path = folder.write("graph.xml", "<graph/>");
  REQUIRE(orca::read_input_file(path, 100));
  LogFile file(path, 1000, 2);
  REQUIRE_FALSE(file.open().ok());
  CHECK_FALSE(file.append("a line"));
  CHECK(read_text(path) == "<graph/>");
}

TEST_CASE("a place that cannot be written is an error that names it", "[components][log]") {
  LogFile file("/no/such/folder/log", 1000, 1);
  const orca::Status opened = file.open();
  REQUIRE_FALSE(opened.ok());
  CHECK_THAT(opened.error().text(), Catch::Contains("/no/such/folder/log"));
}
