// SPDX-License-Identifier: LGPL-3.0-or-later
#include "log_writer.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "orca/base/log.hpp"

namespace orca::hw::link {
namespace {

constexpr std::size_t kMostQueued = std::size_t{1} << 20;  // [bytes]: minutes of a serial line

}  // namespace

LogWriter::LogWriter(Descriptor file, std::string path)
    : file_(std::move(file)), path_(std::move(path)), thread_([this] { run(); }) {}

LogWriter::~LogWriter() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void LogWriter::add(const std::string& lines) {
  if (!is_writing()) return;
  bool fits = true;
  {
    const std::lock_guard lock(mutex_);
    fits = queue_.size() + lines.size() <= kMostQueued;
    if (fits) queue_ += lines;
  }
  fits ? changed_.notify_one() : give_up("the disk is too slow");
}

void LogWriter::run() {
  for (;;) {
    std::string text;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return ending_ || !queue_.empty(); });
      if (queue_.empty()) return;
      text = std::exchange(queue_, {});
    }
    write_all(text);
  }
}

void LogWriter::write_all(const std::string& text) {
  for (std::size_t at = 0; at < text.size() && is_writing();) {
    const ssize_t count = ::write(file_.number(), text.data() + at, text.size() - at);
    if (count > 0) {
      at += static_cast<std::size_t>(count);
    } else if (count == 0 || errno != EINTR) {
      give_up(std::strerror(errno));
    }
  }
}

void LogWriter::give_up(const std::string& why) {
  if (given_up_.exchange(true)) return;
  log::warning("byte log", path_ + " ends here: " + why + ". The device goes on without it");
}

}  // namespace orca::hw::link
