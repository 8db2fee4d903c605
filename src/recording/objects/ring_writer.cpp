// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/objects/ring_writer.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <system_error>
#include <utility>

#include "orca/idl/object_type.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/recording/writer.hpp"

namespace orca::recording {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kWaiting = std::size_t{64} << 20;  // [bytes] that wait for the disk
constexpr const char* kTimeForm = "%Y%m%dT%H%M%SZ";
constexpr std::size_t kDigits = 6;  // of a number, at least

std::string name_of(std::uint64_t number, std::string_view row, TimePoint begun) {
  const std::time_t seconds =
      std::chrono::duration_cast<std::chrono::seconds>(begun.time_since_epoch()).count();
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char time[32];
  std::strftime(time, sizeof time, kTimeForm, &parts);
  std::string digits = std::to_string(number);
  if (digits.size() < kDigits) digits.insert(0, kDigits - digits.size(), '0');
  return digits + "-" + std::string(row) + "-" + time + ".mcap";
}

std::optional<RingFile> file_of(const fs::directory_entry& entry) {
  const std::string name = entry.path().filename().string();
  char* rest = nullptr;
  RingFile file{std::strtoull(name.c_str(), &rest, 10), {}, {}, entry.path(), 0};
  if (rest < name.c_str() + kDigits || !name.ends_with(".mcap")) return std::nullopt;
  const std::string_view tail(rest);
  if (tail.starts_with("-small-")) file.row = "small";
  if (tail.starts_with("-rest-")) file.row = "rest";
  if (file.row.empty()) return std::nullopt;
  std::tm parts{};
  if (strptime(rest + file.row.size() + 2, kTimeForm, &parts) != nullptr)
    file.begun = TimePoint(std::chrono::seconds(timegm(&parts)));
  std::error_code gone;
  file.size = entry.file_size(gone);
  return gone ? std::nullopt : std::optional(std::move(file));
}

std::uint64_t messages_in(const fs::path& path) {
  const Result<Reader> reader = Reader::open(path.string());
  return reader ? reader->statistics().messages : 0;
}

// Returns how many messages had gone when a file was begun.
std::uint64_t dropped_before(const fs::path& path) {
  const Result<Reader> reader = Reader::open(path.string());
  return reader ? std::strtoull(fact(facts_of(*reader), "dropped").c_str(), nullptr, 10) : 0;
}

}  // namespace

std::vector<RingFile> ring_files(const fs::path& folder) {
  std::vector<RingFile> files;
  std::error_code absent;
  for (auto entry = fs::directory_iterator(folder, absent); !absent && entry != fs::directory_iterator();
       entry.increment(absent))
    if (std::optional<RingFile> file = file_of(*entry)) files.push_back(*std::move(file));
  std::ranges::sort(files, {}, &RingFile::number);
  return files;
}

RingWriter::RingWriter(std::string folder, std::uint64_t room)
    : folder_(std::move(folder)), row_room_(std::max(room, kLeast) / 2) {}

RingWriter::~RingWriter() { (void)close({}, {}); }

Status RingWriter::begin(const Origin& origin) {
  origin_ = origin;
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) return fail(Code::unavailable, "cannot make the folder: " + error.message(), folder_.string());
  const std::vector<RingFile> files = ring_files(folder_);
  for (Row& row : rows_) {
    const auto newest = std::find_if(files.rbegin(), files.rend(),
                                     [&](const RingFile& file) { return file.row == row.name; });
    if (newest != files.rend()) row.dropped = dropped_before(newest->path);
  }
  return ok();
}

Status RingWriter::attach_graph(const std::string& graph) {
  graph_ = graph;
  return ok();
}

Status RingWriter::attach_json(const std::string& name, const std::string& text) {
  texts_[name] = text;
  return ok();
}

Status RingWriter::add(std::string_view row, const ObjectRef& object, TimePoint passed) {
  const bool is_small = object.type().write(object.get(), {}) <= kSmall;
  Row& files = rows_[is_small ? 0 : 1];
  if (Status ready = make_ready(files, passed); !ready.ok()) return ready;
  return files.file->add(row, object, passed);
}

// Sees to it that a file is open and has room.
Status RingWriter::make_ready(Row& row, TimePoint now) {
  const bool is_full = row.file && (row.file->size() - row.head >= row_room_ / kFiles ||
                                    now - row.begun >= kFileTime || now < row.begun - kFileTime);
  if (row.file && !is_full) return ok();
  if (Status finished = finish(row, {}, {}); !finished.ok()) return finished;
  if (Status room = make_room(row, now); !room.ok()) return room;
  const std::vector<RingFile> files = ring_files(folder_);
  const std::uint64_t number = files.empty() ? 1 : files.back().number + 1;
  const fs::path path = folder_ / name_of(number, row.name, now);
  Result<std::unique_ptr<Output>> output = open_file_in_background(path.string(), kWaiting);
  if (!output) return output.error();
  row.file = std::make_unique<ObjectWriter>(*std::move(output));
  row.begun = now;
  return write_head(row);
}

// Each file says what it is of; the graph is in those of the small row, which are there longest.
Status RingWriter::write_head(Row& row) {
  Origin origin = origin_;
  origin.more["row"] = row.name;
  origin.more["dropped"] = std::to_string(row.dropped);
  if (Status begun = row.file->begin(origin); !begun.ok()) return begun;
  if (&row == rows_.data() && !graph_.empty()) {
    if (Status attached = row.file->attach_graph(graph_); !attached.ok()) return attached;
    for (const auto& [name, text] : texts_)
      if (Status attached = row.file->attach_json(name, text); !attached.ok()) return attached;
  }
  row.head = row.file->size();
  return ok();
}

// Removes the oldest files of a row until another one fits, and those that are too old.
Status RingWriter::make_room(Row& row, TimePoint now) {
  std::vector<RingFile> files = ring_files(folder_);
  std::erase_if(files, [&](const RingFile& file) { return file.row != row.name; });
  std::erase_if(files, [](const RingFile& file) {  // of a recorder that found no room on the disk
    std::error_code ignored;
    return file.size == 0 && fs::remove(file.path, ignored);
  });
  std::uint64_t taken = row_room_ / kFiles + Writer::kChunkBytes;  // by the next one
  for (const RingFile& file : files) taken += file.size;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const TimePoint end = i + 1 < files.size() ? files[i + 1].begun : now;  // a file ends before the next one
    if (taken <= row_room_ && now - end < kAge) break;
    const std::uint64_t messages = messages_in(files[i].path);
    std::error_code error;
    fs::remove(files[i].path, error);
    if (error)
      return fail(Code::unavailable, "cannot remove the recording: " + error.message(),
                  files[i].path.string());
    row.dropped += messages;
    taken -= files[i].size;
  }
  return ok();
}

Status RingWriter::finish(Row& row, const std::map<std::string, std::uint64_t>& lost, const Values& more) {
  if (!row.file) return ok();
  const Status closed = row.file->close(lost, more);
  messages_ += row.file->messages();
  size_ += row.file->size();
  row.file = nullptr;
  return closed;
}

Status RingWriter::flush() {
  Status all = ok();
  for (const Row& row : rows_) {
    if (!row.file) continue;
    if (Status flushed = row.file->flush(); !flushed.ok()) all = flushed;
  }
  return all;
}

Status RingWriter::close(const std::map<std::string, std::uint64_t>& lost, const Values& more) {
  Status all = ok();
  for (Row& row : rows_)
    if (Status closed = finish(row, lost, more); !closed.ok()) all = closed;
  return all;
}

std::uint64_t RingWriter::messages() const {
  std::uint64_t sum = messages_;
  for (const Row& row : rows_) sum += row.file ? row.file->messages() : 0;
  return sum;
}

std::uint64_t RingWriter::size() const {
  std::uint64_t sum = size_;
  for (const Row& row : rows_) sum += row.file ? row.file->size() : 0;
  return sum;
}

}  // namespace orca::recording
