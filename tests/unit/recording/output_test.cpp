// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/recording/output.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <filesystem>
#include <fstream>

#include "memory_output.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::recording;
using namespace orca::test;

namespace {

namespace fs = std::filesystem;

test::Bytes piece_of(std::size_t size) { return test::Bytes(size, std::byte{7}); }

// Files of this process may not grow beyond a size, as on a full disk.
struct FullDisk {
  explicit FullDisk(rlim_t size) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{size, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
    old = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, old);
  }
  rlimit before{};
  void (*old)(int) = SIG_DFL;
};

}  // namespace

TEST_CASE("a recording overwrites nothing", "[recording][output]") {
  const TempFolder folder;
  const std::string path = folder.file("run.mcap");
  std::ofstream(path) << "precious";
  const auto opened = open_file(path);
  REQUIRE_FALSE(opened);
  CHECK(opened.error().code == Code::already_exists);
  CHECK(open_file_in_background(path, 1000).error().code == Code::already_exists);
  CHECK(fs::file_size(path) == 8);
}

TEST_CASE("what is appended in the background is all there at the end", "[recording][output]") {
  const TempFolder folder;
  const std::string path = folder.file("run.mcap");
  auto output = open_file_in_background(path, 5000);
  REQUIRE(output);
  for (int i = 0; i < 100; ++i) REQUIRE((*output)->append(piece_of(1000)).ok());
  REQUIRE((*output)->finish().ok());
  CHECK(fs::file_size(path) == 100'000);
}

TEST_CASE("a piece that finds no room is taken back whole, and the failure is reported",
          "[recording][output][fault]") {
  const TempFolder folder;
  const std::string path = folder.file("run.mcap");
  const FullDisk disk(2500);
  const bool in_background = GENERATE(false, true);
  auto output = in_background ? open_file_in_background(path, 100) : open_file(path);
  REQUIRE(output);
  for (int i = 0; i < 3; ++i) (void)(*output)->append(piece_of(1000));
  const Status finished = (*output)->finish();
  REQUIRE_FALSE(finished.ok());
  CHECK(finished.error().text() == path + ": the recording cannot be written: File too large");
  CHECK(fs::file_size(path) == 2000);
}
