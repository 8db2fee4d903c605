// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are written while somebody waits for them.
#include "control/code_watch.hpp"

#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "temp_folder.hpp"

using namespace orca::supervisor;
using namespace std::chrono_literals;
using orca::test::TempFolder;

namespace {

using Files = std::vector<std::string>;

// A watch over one file, at moments that the test chooses.
class Watched {
 public:
  Watched() : file_(folder_.write("plugin.so", "old")) { CHECK(look(0ms).empty()); }

  Files look(Moment::duration later) {
    now_ += later;
    return watch_.changed({file_}, now_);
  }
  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  TempFolder folder_;
  std::string file_;
  CodeWatch watch_;
  Moment now_{1h};
};

}  // namespace

TEST_CASE("a file that was written counts as changed once, when it has stayed as it is for a while",
          "[watch]") {
  Watched watched;
  std::ofstream(watched.file()) << "another";
  CHECK(watched.look(1s).empty());
  CHECK(watched.look(50ms).empty());
  CHECK(watched.look(60ms) == Files{watched.file()});
  CHECK(watched.look(1s).empty());
}

TEST_CASE("a file that somebody has still open to write it has not changed yet, however long that takes",
          "[watch]") {
  Watched watched;
  std::ofstream linker(watched.file());
  linker << "half a" << std::flush;
  for (int i = 0; i < 100; ++i) CHECK(watched.look(100ms).empty());
  linker << " library";
  linker.close();
  CHECK(watched.look(100ms).empty());
  CHECK(watched.look(100ms) == Files{watched.file()});
}

TEST_CASE("a file that was exchanged for another one has changed, and one that is gone has not", "[watch]") {
  Watched watched;
  std::filesystem::remove(watched.file());
  CHECK(watched.look(1s).empty());
  CHECK(watched.look(1s).empty());
  const std::string fresh = watched.file() + ".new";
  std::ofstream(fresh) << "new";
  std::filesystem::rename(fresh, watched.file());
  CHECK(watched.look(1s).empty());
  CHECK(watched.look(1s) == Files{watched.file()});
}
