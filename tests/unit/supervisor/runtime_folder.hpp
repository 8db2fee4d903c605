// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <string>

namespace orca::test {

/// A runtime folder of one test.
class RuntimeFolder {
 public:
  RuntimeFolder() {
    char path[] = "/tmp/orca-test-XXXXXX";
    REQUIRE(mkdtemp(path) != nullptr);
    path_ = path;
    setenv("XDG_RUNTIME_DIR", path, 1);
  }
  ~RuntimeFolder() {
    unsetenv("XDG_RUNTIME_DIR");
    std::filesystem::remove_all(path_);
  }
  RuntimeFolder(const RuntimeFolder&) = delete;
  RuntimeFolder& operator=(const RuntimeFolder&) = delete;
  [[nodiscard]] std::filesystem::path socket(const std::string& system) const {
    return path_ / "orca" / (system + ".sock");
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline unsigned mode_of(const std::filesystem::path& path) {
  struct stat found {};
  REQUIRE(lstat(path.c_str(), &found) == 0);
  return found.st_mode & 0777;
}

}  // namespace orca::test
