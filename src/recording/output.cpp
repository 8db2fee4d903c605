// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "orca/base/descriptor.hpp"

namespace orca::recording {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::seconds kSyncInterval{1};

Error failed(const std::string& path, int reason) {
  return fail(Code::unavailable, std::string("the recording cannot be written: ") + std::strerror(reason),
              path);
}

class File final : public Output {
 public:
  File(std::string path, Descriptor file) : path_(std::move(path)), file_(std::move(file)) {}

  Status append(std::vector<std::byte> piece) override {
    if (failure_) return *failure_;
    std::size_t done = 0;
    while (done < piece.size()) {
      const ssize_t written = write(file_.number(), piece.data() + done, piece.size() - done);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) return cut_back(errno);
      done += static_cast<std::size_t>(written);
    }
    size_ += static_cast<off_t>(piece.size());
    return ok();
  }

  Status sync() {
    if (failure_) return *failure_;
    if (fdatasync(file_.number()) == 0 || errno == EINVAL || errno == EROFS)
      return ok();  // a pipe has no disk
    failure_ = failed(path_, errno);
    return *failure_;
  }

  Status finish() override { return sync(); }

 private:
  // Takes back the half of a piece that found room.
  Status cut_back(int reason) {
    failure_ = failed(path_, reason);
    (void)!ftruncate(file_.number(), size_);
    return *failure_;
  }

  const std::string path_;
  const Descriptor file_;
  off_t size_ = 0;  // [bytes] of whole pieces
  std::optional<Error> failure_;
};

class BackgroundFile final : public Output {
 public:
  BackgroundFile(std::unique_ptr<File> file, std::size_t bound)
      : file_(std::move(file)), bound_(bound), thread_([this] { write_until_end(); }) {}
  ~BackgroundFile() override { (void)finish(); }

  Status append(std::vector<std::byte> piece) override {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return failure_ || waiting_bytes_ < bound_; });
    if (failure_) return *failure_;
    waiting_bytes_ += piece.size();
    waiting_.push_back(std::move(piece));
    changed_.notify_all();
    return ok();
  }

  Status finish() override {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
      changed_.notify_all();
    }
    if (thread_.joinable()) thread_.join();
    return failure_ ? Status(*failure_) : ok();
  }

 private:
  void write_until_end() {
    Clock::time_point synced = Clock::now();
    bool is_dirty = false;
    for (;;) {
      std::optional<std::vector<std::byte>> piece;
      {
        std::unique_lock lock(mutex_);
        changed_.wait_until(lock, synced + kSyncInterval, [&] { return ending_ || !waiting_.empty(); });
        if (waiting_.empty() && ending_) break;
        if (!waiting_.empty()) {
          piece = std::move(waiting_.front());
          waiting_.pop_front();
          waiting_bytes_ -= piece->size();
          changed_.notify_all();
        }
      }
      is_dirty = is_dirty || piece;
      if (piece) note(file_->append(*std::move(piece)));
      if (Clock::now() - synced < kSyncInterval) continue;
      if (std::exchange(is_dirty, false)) note(file_->sync());
      synced = Clock::now();
    }
    note(file_->finish());
  }

  void note(const Status& status) {
    if (status.ok()) return;
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = status.error();
    changed_.notify_all();
  }

  const std::unique_ptr<File> file_;
  const std::size_t bound_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::vector<std::byte>> waiting_;
  std::size_t waiting_bytes_ = 0;
  bool ending_ = false;
  std::optional<Error> failure_;
  std::thread thread_;  // the last member: it uses the others
};

Result<std::unique_ptr<File>> open_new(const std::string& path) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644));
  if (file.number() >= 0) return std::make_unique<File>(path, std::move(file));
  const int reason = errno;
  if (reason == EEXIST)
    return fail(Code::already_exists,
                "there is something of this name already, and recordings overwrite nothing; "
                "choose another name",
                path);
  return fail(Code::invalid_argument, std::string("cannot open the recording: ") + std::strerror(reason),
              path);
}

}  // namespace

Result<std::unique_ptr<Output>> open_file(const std::string& path) {
  Result<std::unique_ptr<File>> file = open_new(path);
  if (!file) return file.error();
  return std::unique_ptr<Output>(*std::move(file));
}

Result<std::unique_ptr<Output>> open_file_in_background(const std::string& path, std::size_t bound) {
  Result<std::unique_ptr<File>> file = open_new(path);
  if (!file) return file.error();
  return std::unique_ptr<Output>(std::make_unique<BackgroundFile>(*std::move(file), bound));
}

}  // namespace orca::recording
