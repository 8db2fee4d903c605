// SPDX-License-Identifier: LGPL-3.0-or-later
#include "recorder.hpp"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "lock_before.hpp"
#include "orca/host/port_taps.hpp"
#include "orca/idl/object_type.hpp"
#include "table_file.hpp"

namespace orca::host {
namespace {

constexpr std::chrono::milliseconds kCloseLimit{500};
// The thread looks for work by itself, because waking it would cost the component that pushes a system call.
constexpr std::chrono::milliseconds kWriteInterval{20};

// Returns the type of the objects that are recorded at a port.
const ObjectType& type_of(const PortContract& port) {
  const bool reply = port.pattern == Pattern::query && port.role == Role::proxy;
  return *find_object_type(reply ? port.reply->name : port.type.name);
}

}  // namespace

// The files, and the objects on their way there.
class Recorder::Desk {
 public:
  explicit Desk(const Executive& executive) : start_(executive.now()), at_once_(executive.is_virtual()) {}

  Status open(const RecordingOptions& options, const std::vector<graph::ListedPort>& ports);
  [[nodiscard]] bool records(Flow flow, std::string_view component, std::string_view port) const;
  void take(Flow flow, std::string_view component, std::string_view port, const ObjectRef& object);
  void write_until_closing();
  std::vector<Error> close();

  [[nodiscard]] bool needs_thread() const { return !at_once_ && !files_.empty(); }
  // To be called before a thread runs write_until_closing().
  void expect_thread() { has_thread_ = true; }

 private:
  struct File {
    File(const std::string& path, TimePoint start) : table(path, start) {}
    TableFile table;
    std::uint64_t left_out = 0;
  };
  struct Tap {
    graph::PortRef ref;
    std::string path;  // of the port
    Flow flow;
    File& file;
  };
  struct Row {
    const Tap* tap;
    ObjectRef object;
  };

  void put(const Tap& tap, const ObjectRef& object);
  void close_files();

  const TimePoint start_;
  const bool at_once_;
  bool has_thread_ = false;
  std::deque<File> files_;
  std::vector<Tap> taps_;

  std::mutex mutex_;
  std::condition_variable changed_;
  bool closing_ = false;  // nothing is taken any more
  bool closed_ = false;
  std::vector<Row> waiting_;
  std::vector<Error> failures_;
};

Status Recorder::Desk::open(const RecordingOptions& options, const std::vector<graph::ListedPort>& ports) {
  File& file = files_.emplace_back(options.file, start_);
  for (const std::string& path : options.ports) {
    const auto port = std::ranges::find_if(ports, [&](const auto& p) { return p.ref.text() == path; });
    if (port == ports.end())
      return fail(Code::not_found, "there is no port \"" + path + "\" to record", options.file);
    file.table.add_port(path, type_of(port->contract));
    taps_.push_back({port->ref, path, flow_of(port->contract), file});
  }
  if (!at_once_) waiting_.reserve(kMostWaiting);
  return file.table.open();
}

void Recorder::Desk::take(Flow flow, std::string_view component, std::string_view port,
                          const ObjectRef& object) {
  for (const Tap& tap : taps_)
    if (tap.flow == flow && tap.ref.port == port && tap.ref.component == component) put(tap, object);
}

bool Recorder::Desk::records(Flow flow, std::string_view component, std::string_view port) const {
  return std::ranges::any_of(taps_, [&](const Tap& tap) {
    return tap.flow == flow && tap.ref.port == port && tap.ref.component == component;
  });
}

void Recorder::Desk::put(const Tap& tap, const ObjectRef& object) {
  const std::lock_guard lock(mutex_);
  if (closing_) return;
  if (at_once_) {
    tap.file.table.add(tap.path, object);
  } else if (waiting_.size() == kMostWaiting) {
    ++tap.file.left_out;
  } else {
    waiting_.push_back({&tap, object});
  }
}

void Recorder::Desk::write_until_closing() {
  std::vector<Row> rows;
  rows.reserve(kMostWaiting);
  for (bool closing = false; !closing;) {
    {
      std::unique_lock lock(mutex_);
      closing = changed_.wait_for(lock, kWriteInterval, [this] { return closing_; });
      rows.swap(waiting_);
    }
    for (Row& row : rows) row.tap->file.table.add(row.tap->path, std::move(row.object));
    rows.clear();
  }
  close_files();
}

// Called by whoever writes.
void Recorder::Desk::close_files() {
  std::vector<Error> failures;
  for (File& file : files_) {
    if (const Status closed = file.table.close(); !closed.ok()) {
      failures.push_back(closed.error());
    } else if (file.left_out > 0) {
      failures.push_back(fail(Code::data_loss,
                              "the recording is incomplete: objects left out, because they came faster than "
                              "they could be written: " +
                                  std::to_string(file.left_out),
                              file.table.path()));
    }
  }
  const std::lock_guard lock(mutex_);
  failures_ = std::move(failures);
  closed_ = true;
  changed_.notify_all();
}

std::vector<Error> Recorder::Desk::close() {
  if (files_.empty()) return {};
  const auto limit = std::chrono::steady_clock::now() + kCloseLimit;
  const Error cut_off = fail(Code::deadline_exceeded, "the end of the recording could not be written",
                             files_.front().table.path());
  auto lock = lock_before(limit, mutex_);
  if (!lock.owns_lock()) return {cut_off};
  const bool first = !std::exchange(closing_, true);
  changed_.notify_all();
  if (first && !has_thread_) {
    lock.unlock();
    close_files();
    lock.lock();
  }
  if (!changed_.wait_until(lock, limit, [this] { return closed_; })) return {cut_off};
  return std::exchange(failures_, {});
}

Recorder::Recorder(const Executive& executive) : desk_(std::make_shared<Desk>(executive)) {}

Recorder::~Recorder() { (void)close(); }

Status Recorder::open(const std::vector<RecordingOptions>& files,
                      const std::vector<graph::ListedPort>& ports) {
  for (const RecordingOptions& options : files)
    if (Status opened = desk_->open(options, ports); !opened.ok()) return opened;
  if (!desk_->needs_thread()) return ok();
  desk_->expect_thread();
  std::thread([desk = desk_] { desk->write_until_closing(); }).detach();
  return ok();
}

bool Recorder::records_pushes(std::string_view component, std::string_view port) const {
  return desk_->records(Flow::pushed, component, port);
}

void Recorder::pushed(std::string_view component, std::string_view port, const ObjectRef& object) {
  desk_->take(Flow::pushed, component, port, object);
}

void Recorder::requested(std::string_view component, std::string_view port, const ObjectRef& object) {
  desk_->take(Flow::requested, component, port, object);
}

void Recorder::delivered(std::string_view component, std::string_view port, const ObjectRef& object) {
  desk_->take(Flow::delivered, component, port, object);
}

std::vector<Error> Recorder::close() { return desk_->close(); }

}  // namespace orca::host
