// SPDX-License-Identifier: LGPL-3.0-or-later
#include "log_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/files/open_output.hpp"
#include "orca/base/input_file.hpp"

namespace orca::logs {
namespace {

std::string one_line(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\n') {
      line += "\\n";
    } else if (c == '\r') {
      line += "\\r";
    } else {
      line += c;
    }
  }
  return line + '\n';
}

}  // namespace

LogFile::LogFile(std::string path, std::uint64_t most_bytes, int keep)
    : path_(std::move(path)), most_bytes_(most_bytes), keep_(keep) {}

LogFile::~LogFile() {
  if (fd_ >= 0) close(fd_);
}

Status LogFile::open() {
  if (has_been_read(path_))
    return fail(Code::invalid_argument, "the log would be written into a file that has been read", path_);
  // Said without opening anything, so that a check of the graph can say it too.
  const std::size_t slash = path_.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path_.substr(0, slash + 1);
  if (access(folder.c_str(), X_OK) != 0)
    return fail(Code::unavailable, std::string("cannot be written: ") + std::strerror(errno), path_);
  Result<OpenOutput> opened = contain_exhaustion(
      [&] { return open_output(path_, O_WRONLY | O_APPEND | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0644); });
  if (!opened) return fail(Code::unavailable, "cannot be written: " + opened.error().message, path_);
  fd_ = opened->file.release();
  struct stat about {};
  regular_ = fstat(fd_, &about) == 0 && S_ISREG(about.st_mode);
  size_ = regular_ ? static_cast<std::uint64_t>(about.st_size) : 0;
  return ok();
}

bool LogFile::append(std::string_view text) {
  const std::string line = one_line(text);
  if (regular_ && size_ > 0 && size_ + line.size() > most_bytes_) rotate();
  if (lost_ > told_lost_ && fd_ >= 0 &&
      write_line(std::to_string(lost_ - told_lost_) + " lines were lost: they could not be written\n"))
    told_lost_ = lost_;
  const bool good = (fd_ >= 0 || open().ok()) && write_line(line);
  ++(good ? written_ : lost_);
  return good;
}

bool LogFile::write_line(const std::string& line) {
  const ssize_t done = write(fd_, line.data(), line.size());
  if (done == static_cast<ssize_t>(line.size())) {
    size_ += line.size();
    return true;
  }
  // Half a line is worse than none, so it is cut off. It stays only if that fails as well.
  if (done > 0 && (!regular_ || ftruncate(fd_, static_cast<off_t>(size_)) != 0))
    size_ += static_cast<std::uint64_t>(done);
  return false;
}

void LogFile::rotate() {
  close(fd_);
  fd_ = -1;
  if (keep_ == 0) std::remove(path_.c_str());
  for (int number = keep_ - 1; number >= 1; --number)
    std::rename(old_name(number).c_str(), old_name(number + 1).c_str());
  if (keep_ > 0) std::rename(path_.c_str(), old_name(1).c_str());
  if (!open().ok()) size_ = 0;
}

}  // namespace orca::logs
