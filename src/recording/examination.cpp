// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <utility>

#include "mapped_file.hpp"
#include "orca/recording/reader.hpp"
#include "scan.hpp"
#include "storage.hpp"

namespace orca::recording {
namespace {

// The numbers of the messages of each channel, which count from one to the next where the writer numbers them.
class Numbers {
 public:
  void add(const Message& message) {
    auto [last, is_first] = last_.try_emplace(message.channel, message.sequence);
    if (!is_first && message.sequence > last->second + 1)
      missing_[message.channel] += message.sequence - last->second - 1;
    last->second = message.sequence;
  }

  [[nodiscard]] std::vector<std::string> remarks(const std::map<std::uint16_t, Channel>& channels) const {
    std::vector<std::string> all;
    for (const auto& [id, count] : missing_)
      all.push_back(channels.at(id).topic + ": " + std::to_string(count) +
                    " numbers are missing between its messages");
    return all;
  }

 private:
  std::map<std::uint16_t, std::uint32_t> last_;
  std::map<std::uint16_t, std::uint64_t> missing_;
};

// Compares the index with the data.
void compare(std::span<const std::byte> bytes, Scanned& scanned) {
  const auto note = [&](const std::string& text) { scanned.findings.push_back({scanned.whole, text}); };
  const Result<Reader> reader = Reader::of(bytes);
  if (!reader || !reader->has_index()) return note("the file has no index, or a damaged one");
  const Statistics& said = reader->statistics();
  const Statistics& counted = scanned.summary.statistics;
  if (said.messages != counted.messages || said.by_channel != counted.by_channel)
    note("the index counts " + std::to_string(said.messages) + " messages, and there are " +
         std::to_string(counted.messages));
  const auto place = [](const ChunkIndex& chunk) { return std::pair(chunk.offset, chunk.length); };
  if (!std::ranges::equal(reader->chunks(), scanned.summary.chunks, {}, place, place))
    note("the index names other chunks than there are");
  if (reader->attachments().size() != scanned.summary.attachments.size() ||
      reader->metadata().size() != scanned.summary.metadata.size())
    note("the index names other attachments or metadata than there are");
}

Examination examination_of(Scanned&& scanned, const Numbers& numbers) {
  return {std::move(scanned.findings), scanned.summary.statistics, scanned.whole,
          numbers.remarks(scanned.summary.channels)};
}

// A file in the making, from records of another one.
class Copy {
 public:
  explicit Copy(std::unique_ptr<Output> to) : to_(std::move(to)) { put_magic(piece_); }

  Status add(std::span<const std::byte> bytes, const Record& record, const OpenChunk* chunk) {
    const auto whole = bytes.subspan(record.offset, record.end() - record.offset);
    const IndexEntry place{offset_ + piece_.size(), whole.size(), {}, {}, 0, 0, 0};
    if (chunk != nullptr) {
      summary_.chunks.push_back(put_chunk(piece_, offset_, whole, *chunk));
    } else {
      put(piece_, whole);
    }
    if (record.op == Op::attachment) summary_.attachments.push_back(place);
    if (record.op == Op::metadata) summary_.metadata.push_back(place);
    return write();
  }

  // Writes the end. @param found  what is in the file, with other places.
  Status finish(const Summary& found) {
    summary_.schemas = found.schemas;
    summary_.channels = found.channels;
    summary_.statistics = found.statistics;
    const auto name = [](std::vector<IndexEntry>& to, const std::vector<IndexEntry>& from) {
      for (std::size_t i = 0; i < to.size(); ++i) {
        const IndexEntry place = std::exchange(to[i], from[i]);
        to[i].offset = place.offset;
      }
    };
    name(summary_.attachments, found.attachments);
    name(summary_.metadata, found.metadata);
    piece_ = summary_.encode(offset_);
    if (Status written = write(); !written.ok()) return written;
    return to_->finish();
  }

 private:
  Status write() {
    offset_ += piece_.size();
    return to_->append(std::exchange(piece_, {}));
  }

  const std::unique_ptr<Output> to_;
  Summary summary_;
  Bytes piece_;
  std::uint64_t offset_ = 0;
};

}  // namespace

Result<Examination> check(std::span<const std::byte> bytes) {
  Numbers numbers;
  Result<Scanned> scanned = scan(bytes, {.message = [&](const Message& message) { numbers.add(message); }});
  if (!scanned) return scanned.error();
  if (scanned->has_end) compare(bytes, *scanned);
  return examination_of(*std::move(scanned), numbers);
}

Result<Examination> recover(std::span<const std::byte> bytes, std::unique_ptr<Output> to) {
  Numbers numbers;
  Copy copy(std::move(to));
  Result<Scanned> scanned = scan(
      bytes,
      {.record = [&](const Record& record, const OpenChunk* chunk) { return copy.add(bytes, record, chunk); },
       .message = [&](const Message& message) { numbers.add(message); }});
  if (!scanned) return scanned.error();
  if (scanned->has_end && scanned->findings.empty()) compare(bytes, *scanned);
  if (const Status finished = copy.finish(scanned->summary); !finished.ok()) return finished.error();
  return examination_of(*std::move(scanned), numbers);
}

namespace {

Result<Examination> check_file(const std::string& path) {
  const Result<MappedFile> file = MappedFile::open(path);
  if (!file) return file.error();
  if (is_database(file->bytes())) return check_database(path);
  Result<Examination> examined = check(file->bytes());
  return examined ? examined : fail(examined.error().code, examined.error().message, path);
}

}  // namespace

Result<Examination> check(const std::string& path) {
  const Result<std::vector<std::string>> files = files_of(path);
  if (!files) return files.error();
  if (files->size() == 1) return check_file(files->front());
  Examination all;
  for (const std::string& name : *files) {
    Result<Examination> examined = check_file(name);
    if (!examined) return examined;
    for (Finding& finding : examined->findings) {
      finding.text = name + ": " + finding.text;
      all.findings.push_back(std::move(finding));
    }
    for (const std::string& remark : examined->remarks) all.remarks.push_back(name + ": " + remark);
    all.statistics.messages += examined->statistics.messages;
    all.statistics.chunks += examined->statistics.chunks;
    all.whole += examined->whole;
  }
  return all;
}

Result<Examination> recover(const std::string& path, std::unique_ptr<Output> to) {
  const Result<MappedFile> file = MappedFile::open(path);
  if (!file) return file.error();
  if (is_database(file->bytes()))
    return fail(Code::unimplemented, "a bag in SQLite is saved by SQLite: " + rescue_of(path), path);
  return recover(file->bytes(), std::move(to));
}

}  // namespace orca::recording
