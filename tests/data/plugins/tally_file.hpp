// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <string>

#include "orca/base/result.hpp"

/// A file of numbers, 8 bytes each. A number that was written stays when the process is killed.
class TallyFile {
 public:
  TallyFile() = default;
  ~TallyFile() { end(); }
  TallyFile(const TallyFile&) = delete;
  TallyFile& operator=(const TallyFile&) = delete;

  orca::Status open_at(const std::string& path) {
    fd_ = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    return fd_ < 0 ? orca::fail(orca::Code::unavailable, "cannot open " + path) : orca::ok();
  }

  orca::Status add(std::int64_t number) const {
    if (write(fd_, &number, sizeof number) == sizeof number) return orca::ok();
    return orca::fail(orca::Code::internal, "the number cannot be written");
  }

  void end() {
    if (fd_ >= 0) close(fd_);
    fd_ = -1;
  }

 private:
  int fd_ = -1;
};
