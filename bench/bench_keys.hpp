// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdlib.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "orca/keys/authority.hpp"

namespace orca::bench {

/// Keys for the two processes of a secured DdsLinks, in a folder that the destructor removes.
class BenchKeys {
 public:
  BenchKeys() {
    std::string name = (std::filesystem::temp_directory_path() / "orca_bench_XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for keys");
    folder_ = name;
    const auto now = std::chrono::system_clock::now();
    const Status made = keys::make_keys(folder_ + "/keys", {permit("servers"), permit("clients")},
                                        {now - std::chrono::hours(1), now + std::chrono::days(100)});
    if (!made.ok()) throw std::runtime_error(made.error().text());
  }
  ~BenchKeys() { std::filesystem::remove_all(folder_); }
  BenchKeys(const BenchKeys&) = delete;
  BenchKeys& operator=(const BenchKeys&) = delete;

  [[nodiscard]] std::string folder() const { return folder_ + "/keys/this-machine"; }

 private:
  static keys::Permit permit(const std::string& process) {
    return {"", process, {"orca/test/*", "orca-lines/test/*"}, {"orca/test/*", "orca-lines/test/*"}};
  }

  std::string folder_;
};

}  // namespace orca::bench
