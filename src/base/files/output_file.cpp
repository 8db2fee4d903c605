// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/files/open_output.hpp"
#include "used_files.hpp"

namespace orca {
namespace {

constexpr std::size_t kBuffer = 64 * 1024;
// Without O_NONBLOCK, a pipe that nobody reads would block open() for ever; with it, that is an error.
constexpr int kFlags = O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK;

Error cannot_write(const std::string& what, const std::string& path, const std::string& why) {
  return fail(Code::unavailable, "cannot write " + what + ": " + why, path);
}

// From here on, a reader that is slow holds up the writer and loses nothing.
void make_blocking(int fd) { fcntl(fd, F_SETFL, fcntl(fd, F_GETFL) & ~O_NONBLOCK); }

}  // namespace

OutputFile::~OutputFile() {
  if (is_open()) (void)close();
}

Status OutputFile::open(const std::string& path) {
  path_ = path;
  Result<OpenOutput> opened = contain_exhaustion([&] { return open_output(path, kFlags, 0666); });
  if (!opened) return cannot_write(what_, path, opened.error().message);
  created_ = opened->is_new;
  fd_ = opened->file.release();
  struct stat file {};
  if (fstat(fd_, &file) != 0) return cannot_write(what_, path, std::strerror(errno));
  const std::string use = S_ISREG(file.st_mode) ? UsedFiles::of_process().use_of(file) : "";
  if (!use.empty()) {
    ::close(std::exchange(fd_, -1));
    return fail(Code::invalid_argument, what_ + " would overwrite " + use + "; give it a name of its own",
                path);
  }
  make_blocking(fd_);
  UsedFiles::of_process().add_written(path, what_);
  return ok();
}

void OutputFile::write(std::string_view text) {
  if (!is_open()) return;
  buffer_ += text;
  if (buffer_.size() >= kBuffer) flush();
}

void OutputFile::flush() {
  begin();
  write_buffer();
}

void OutputFile::begin() {
  if (std::exchange(begun_, true)) return;
  struct stat file {};
  if (fstat(fd_, &file) == 0 && S_ISREG(file.st_mode) && ftruncate(fd_, 0) != 0) note_failure();
}

void OutputFile::write_buffer() {
  for (std::size_t at = 0; at < buffer_.size() && failure_ == 0;) {
    const ssize_t count = ::write(fd_, buffer_.data() + at, buffer_.size() - at);
    if (count > 0) {
      at += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      note_failure();
    }
  }
  buffer_.clear();
}

void OutputFile::note_failure() {
  if (failure_ == 0) failure_ = errno;
}

Status OutputFile::close() {
  if (!is_open()) return ok();
  if (!buffer_.empty()) flush();
  // Pipes and devices cannot be synchronised and say so.
  if (fsync(fd_) != 0 && errno != EINVAL && errno != EROFS && errno != ENOTSUP) note_failure();
  if (::close(std::exchange(fd_, -1)) != 0) note_failure();
  UsedFiles::of_process().remove_written(path_);
  if (created_ && !begun_) unlink(path_.c_str());
  if (failure_ == 0) return ok();
  return cannot_write(what_, path_, std::strerror(failure_));
}

}  // namespace orca
