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
#include "orca/recording/objects/object_writer.hpp"
#include "table_file.hpp"

namespace orca::host {
namespace {

constexpr std::chrono::milliseconds kCloseLimit{2000};
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
  explicit Desk(const Executive& executive)
      : executive_(executive), start_(executive.now()), at_once_(executive.is_virtual()) {}

  Status open(const RecordingOptions& options, const std::vector<graph::ListedPort>& ports,
              const BagOrigin& run);
  [[nodiscard]] bool records(Flow flow, std::string_view component, std::string_view port) const;
  void take(Flow flow, std::string_view component, std::string_view port, const ObjectRef& object);
  // Takes an object for a row of all files that have rows besides those of ports.
  void take(const std::string& row, const ObjectRef& object);
  void note(const log::Line& line);
  void conclude(std::map<std::string, std::string> facts);
  void write_until_closing();
  std::vector<Error> close();

  [[nodiscard]] bool needs_thread() const { return !at_once_ && !files_.empty(); }
  [[nodiscard]] bool has_bags() const { return std::ranges::any_of(files_, &File::is_bag); }
  // To be called before a thread runs write_until_closing().
  void expect_thread() { has_thread_ = true; }

 private:
  struct File {
    File(const std::string& path, TimePoint start)
        : is_bag(is_bag_file(path)), table(path, start), bag(path) {}
    void add(const std::string& row, ObjectRef object, TimePoint passed) {
      is_bag ? bag.add(row, object, passed) : table.add(row, std::move(object));
    }
    const bool is_bag;
    TableFile table;  // unless it is a bag
    BagFile bag;
    std::map<std::string, std::uint64_t> left_out;  // by row
  };
  struct Tap {
    graph::PortRef ref;
    std::string path;  // of the port
    Flow flow;
    File& file;
  };
  struct Row {
    File* file;
    const std::string* name;
    ObjectRef object;
    TimePoint passed;
  };

  Status open_bag(File& file, const RecordingOptions& options, const std::vector<graph::ListedPort>& ports,
                  const BagOrigin& run);
  void put(File& file, const std::string& row, const ObjectRef& object);
  [[nodiscard]] Status close(File& file, const std::map<std::string, std::string>& facts) const;
  void close_files();

  const Executive& executive_;
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
  std::map<std::string, std::string> facts_;  // of the run, in the end
};

Status Recorder::Desk::open(const RecordingOptions& options, const std::vector<graph::ListedPort>& ports,
                            const BagOrigin& run) {
  File& file = files_.emplace_back(options.file, start_);
  if (file.is_bag) return open_bag(file, options, ports, run);
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

Status Recorder::Desk::open_bag(File& file, const RecordingOptions& options,
                                const std::vector<graph::ListedPort>& ports, const BagOrigin& run) {
  std::vector<std::string> recorded;
  for (const graph::ListedPort& port : ports) {
    const std::string path = port.ref.text();
    const bool is_named = std::ranges::find(options.ports, path) != options.ports.end();
    if (!is_named && !(options.ports.empty() && is_source(port.contract))) continue;
    taps_.push_back({port.ref, path, flow_of(port.contract), file});
    recorded.push_back(path);
  }
  if (!at_once_) waiting_.reserve(kMostWaiting);
  return file.bag.open(run, recorded, at_once_);
}

void Recorder::Desk::take(const std::string& row, const ObjectRef& object) {
  for (File& file : files_)
    if (file.is_bag) put(file, row, object);
}

void Recorder::Desk::note(const log::Line& line) {
  static const std::string row(recording::kLogRow);
  take(row,
       recording::log_record(line.level, std::string(line.who), std::string(line.text), executive_.now()));
}

void Recorder::Desk::conclude(std::map<std::string, std::string> facts) {
  const std::lock_guard lock(mutex_);
  facts_ = std::move(facts);
}

void Recorder::Desk::take(Flow flow, std::string_view component, std::string_view port,
                          const ObjectRef& object) {
  for (const Tap& tap : taps_)
    if (tap.flow == flow && tap.ref.port == port && tap.ref.component == component)
      put(tap.file, tap.path, object);
}

bool Recorder::Desk::records(Flow flow, std::string_view component, std::string_view port) const {
  return std::ranges::any_of(taps_, [&](const Tap& tap) {
    return tap.flow == flow && tap.ref.port == port && tap.ref.component == component;
  });
}

void Recorder::Desk::put(File& file, const std::string& row, const ObjectRef& object) {
  const TimePoint now = executive_.now();
  const std::lock_guard lock(mutex_);
  if (closing_) return;
  if (at_once_) {
    file.add(row, object, now);
  } else if (waiting_.size() == kMostWaiting) {
    ++file.left_out[row];
  } else {
    waiting_.push_back({&file, &row, object, now});
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
    for (Row& row : rows) row.file->add(*row.name, std::move(row.object), row.passed);
    rows.clear();
  }
  close_files();
}

// Called by whoever writes.
void Recorder::Desk::close_files() {
  std::vector<Error> failures;
  std::map<std::string, std::string> facts;
  {
    const std::lock_guard lock(mutex_);
    facts = facts_;
  }
  for (File& file : files_)
    if (const Status closed = close(file, facts); !closed.ok()) failures.push_back(closed.error());
  const std::lock_guard lock(mutex_);
  failures_ = std::move(failures);
  closed_ = true;
  changed_.notify_all();
}

Status Recorder::Desk::close(File& file, const std::map<std::string, std::string>& facts) const {
  if (Status closed = file.is_bag ? file.bag.close(file.left_out, facts) : file.table.close(); !closed.ok())
    return closed;
  std::uint64_t left_out = 0;
  for (const auto& [row, count] : file.left_out) left_out += count;
  if (left_out == 0) return ok();
  return fail(Code::data_loss,
              "the recording is incomplete: objects left out, because they came faster than they could be "
              "written: " +
                  std::to_string(left_out),
              file.table.path());
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

Status Recorder::open(const std::vector<RecordingOptions>& files, const std::vector<graph::ListedPort>& ports,
                      const BagOrigin& run) {
  for (const RecordingOptions& options : files)
    if (Status opened = desk_->open(options, ports, run); !opened.ok()) return opened;
  if (desk_->has_bags()) log_.emplace([this](const log::Line& line) { desk_->note(line); });
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

void Recorder::alarmed(const idl::Alarm& alarm) {
  static const std::string row(recording::kAlarmRow);
  if (desk_->has_bags()) desk_->take(row, std::move(make_object(alarm)).seal());
}

void Recorder::conclude(std::map<std::string, std::string> facts) { desk_->conclude(std::move(facts)); }

std::vector<Error> Recorder::close() { return desk_->close(); }

}  // namespace orca::host
