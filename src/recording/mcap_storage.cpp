// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cstring>
#include <memory>
#include <utility>

#include "mapped_file.hpp"
#include "scan.hpp"
#include "storage.hpp"

namespace orca::recording {
namespace {

// Returns whether chunks lie in the file one after the other. Whoever names one of them again and again makes a small file a
// large one.
bool lie_apart(const std::vector<ChunkIndex>& chunks, std::uint64_t size) {
  std::uint64_t end = 0;
  for (const ChunkIndex& chunk : chunks) {
    if (chunk.offset < end || chunk.offset > size || chunk.length == 0 || chunk.length > size - chunk.offset)
      return false;
    end = chunk.offset + chunk.length;
  }
  return true;
}

bool is_of_use(const Summary& summary, std::uint64_t size) {
  return lie_apart(summary.chunks, size) && (!summary.chunks.empty() || summary.statistics.messages == 0);
}

// Reads the summary at the end of a file; nothing if there is none, or if it is damaged.
std::optional<Summary> read_summary(std::span<const std::byte> bytes) {
  constexpr std::size_t kEnd = kRecordHead + kFooterBytes + sizeof kMagic;
  if (bytes.size() < kEnd + sizeof kMagic) return std::nullopt;
  const auto tail = bytes.last(kEnd);
  if (std::memcmp(tail.data() + tail.size() - sizeof kMagic, kMagic, sizeof kMagic) != 0) return std::nullopt;
  const std::uint64_t footer_at = bytes.size() - kEnd;
  const std::optional<Record> record =
      RecordWalk(bytes.first(bytes.size() - sizeof kMagic), footer_at).next();
  if (!record || record->op != Op::footer) return std::nullopt;
  const std::optional<Footer> footer = read_footer(record->content);
  if (!footer || footer->summary_start == 0 || footer->summary_start > footer_at) return std::nullopt;
  // The checksum covers everything before itself, the beginning of the footer included.
  const auto covered =
      bytes.subspan(footer->summary_start, footer_at + kEnd - sizeof kMagic - 4 - footer->summary_start);
  if (footer->summary_crc != 0 && footer->summary_crc != crc_of(covered)) return std::nullopt;
  Summary summary;
  RecordWalk walk(bytes.first(footer_at), footer->summary_start);
  while (const std::optional<Record> part = walk.next())
    if (!summary.take(*part)) return std::nullopt;
  if (!walk.is_at_end() || !is_of_use(summary, footer_at)) return std::nullopt;
  return summary;
}

// Returns the messages outside chunks of a file with an index. Where the index says that there is a chunk, or indexes of its
// messages, nothing is looked at.
std::vector<Record> loose_messages(std::span<const std::byte> bytes, const Summary& summary) {
  std::vector<Record> loose;
  std::uint64_t at = sizeof kMagic;
  const auto look = [&](std::uint64_t end) {
    RecordWalk walk(bytes.first(end), at);
    while (const std::optional<Record> record = walk.next()) {
      if (record->op == Op::data_end) break;
      if (record->op == Op::message && read_message(record->content)) loose.push_back(*record);
    }
  };
  for (const ChunkIndex& chunk : summary.chunks) {
    if (chunk.offset > at) look(chunk.offset);
    const std::uint64_t end = chunk.offset + chunk.length;
    at = end + std::min(chunk.message_index_length, bytes.size() - end);
  }
  look(bytes.size());
  return loose;
}

// A part of a file that is read as a whole: a chunk, or a message outside chunks.
struct Piece {
  Stamp start = 0;
  std::uint64_t offset = 0;
  std::uint64_t end = 0;
};

constexpr std::size_t kMostKept = std::size_t{512} << 20;  // [bytes] that wait when another chunk is opened

// Messages on their way into the order of time.
class Sorter {
 public:
  Sorter(std::set<std::uint16_t> channels, Stamp from, const std::function<bool(const Message&)>& take)
      : channels_(std::move(channels)), from_(from), take_(take) {}

  // Takes over the content of a chunk, which is kept until its last message is passed on.
  std::shared_ptr<const Bytes> keep(Bytes content) {
    kept_ += content.size();
    return {new Bytes(std::move(content)), [this](const Bytes* bytes) {
              kept_ -= bytes->size();
              delete bytes;
            }};
  }
  [[nodiscard]] bool has_room() const { return kept_ + waiting_.size() * sizeof(Waiting) <= kMostKept; }

  void add(const std::shared_ptr<const Bytes>& content, std::span<const std::byte> record) {
    const std::optional<Message> message = read_message(record);
    if (message && message->log_time >= from_ && channels_.contains(message->channel))
      waiting_.push_back({*message, content});
  }

  // Passes on what is earlier than a time. Returns false if no more is wanted.
  bool pass_on(Stamp before) {
    std::ranges::stable_sort(waiting_, {}, [](const Waiting& one) { return one.message.log_time; });
    std::size_t i = 0;
    for (; i < waiting_.size() && waiting_[i].message.log_time < before; ++i)
      if (!take_(waiting_[i].message)) return false;
    waiting_.erase(waiting_.begin(), waiting_.begin() + static_cast<std::ptrdiff_t>(i));
    return true;
  }
  bool pass_on_rest() {
    return pass_on(UINT64_MAX) && std::ranges::all_of(waiting_, take_, &Waiting::message);
  }

 private:
  struct Waiting {
    Message message;
    std::shared_ptr<const Bytes> content;  // which it is in; null: the file itself
  };
  const std::set<std::uint16_t> channels_;
  const Stamp from_;
  const std::function<bool(const Message&)>& take_;
  std::size_t kept_ = 0;  // [bytes] of contents
  std::vector<Waiting> waiting_;
};

// An MCAP file.
class McapStorage final : public Storage {
 public:
  Status messages(const std::set<std::uint16_t>& channels, const std::function<bool(const Message&)>& take,
                  Stamp from) const override;
  void keep(MappedFile file) { file_ = std::move(file); }

  std::vector<Record> loose;

 private:
  Status add(const Piece& piece, Sorter& sorter) const {
    const std::optional<Record> record = RecordWalk(bytes.first(piece.end), piece.offset).next();
    if (record && record->op == Op::message) return sorter.add(nullptr, record->content), ok();
    if (!record || record->op != Op::chunk)
      return fail(Code::data_loss,
                  "the index names a chunk at byte " + std::to_string(piece.offset) +
                      ", and there is none; read the file without its index: orcactl bag recover");
    if (!sorter.has_room())
      return fail(Code::data_loss,
                  "the chunk at byte " + std::to_string(piece.offset) + " is of the same time as more than " +
                      std::to_string(kMostKept >> 20) + " MiB before it, which is too much to sort");
    Result<OpenChunk> chunk = open_chunk(record->content);
    if (!chunk) return chunk.error();
    const std::shared_ptr<const Bytes> content = sorter.keep(std::move(chunk->content));
    RecordWalk walk(*content);
    while (const std::optional<Record> inner = walk.next())
      if (inner->op == Op::message) sorter.add(content, inner->content);
    return ok();
  }

  [[nodiscard]] std::vector<Piece> pieces(const std::set<std::uint16_t>& channels, Stamp from) const {
    std::vector<Piece> all;
    for (const ChunkIndex& chunk : summary.chunks) {
      const auto& in_it = chunk.message_index_offsets;
      const bool is_wanted = channels.empty() || in_it.empty() ||
                             std::ranges::any_of(channels, [&](auto id) { return in_it.contains(id); });
      if (is_wanted && chunk.end >= from)
        all.push_back({chunk.start, chunk.offset, chunk.offset + chunk.length});
    }
    for (const Record& record : loose)
      all.push_back({read_message(record.content)->log_time, record.offset, record.end()});
    std::ranges::stable_sort(all, {}, &Piece::start);
    return all;
  }

  MappedFile file_;
};

Status McapStorage::messages(const std::set<std::uint16_t>& channels,
                             const std::function<bool(const Message&)>& take, Stamp from) const {
  std::set<std::uint16_t> wanted = channels;
  if (channels.empty())
    for (const auto& [id, channel] : summary.channels) wanted.insert(id);
  Sorter sorter(std::move(wanted), from, take);
  for (const Piece& piece : pieces(channels, from)) {
    if (!sorter.pass_on(piece.start)) return ok();
    if (Status added = add(piece, sorter); !added.ok()) {
      (void)sorter.pass_on_rest();
      return added;
    }
  }
  (void)sorter.pass_on_rest();
  return ok();
}

Result<std::unique_ptr<McapStorage>> storage_of(std::span<const std::byte> bytes) {
  auto storage = std::make_unique<McapStorage>();
  storage->bytes = bytes;
  storage->size = bytes.size();
  if (!is_mcap(bytes))
    return fail(Code::invalid_argument, "this is no MCAP file: it does not begin like one");
  const std::optional<Record> first = RecordWalk(bytes, sizeof kMagic).next();
  std::optional<Header> header =
      first && first->op == Op::header ? read_header(first->content) : std::nullopt;
  if (std::optional<Summary> summary = read_summary(bytes); summary && header) {
    storage->library = std::move(header->library);
    storage->loose = loose_messages(bytes, *summary);
    storage->summary = *std::move(summary);
    storage->has_index = true;
    return storage;
  }
  Result<Scanned> scanned = scan(bytes, {});
  if (!scanned) return scanned.error();
  storage->library = std::move(scanned->header.library);
  storage->summary = std::move(scanned->summary);
  storage->loose = std::move(scanned->loose);
  storage->findings = std::move(scanned->findings);
  return storage;
}

}  // namespace

bool is_mcap(std::span<const std::byte> bytes) {
  return bytes.size() >= sizeof kMagic && std::memcmp(bytes.data(), kMagic, sizeof kMagic) == 0;
}

Result<std::unique_ptr<Storage>> read_mcap(std::span<const std::byte> bytes) {
  Result<std::unique_ptr<McapStorage>> storage = storage_of(bytes);
  if (!storage) return storage.error();
  return std::unique_ptr<Storage>(*std::move(storage));
}

Result<std::unique_ptr<Storage>> open_mcap(MappedFile file) {
  Result<std::unique_ptr<McapStorage>> storage = storage_of(file.bytes());
  if (!storage) return storage.error();
  (*storage)->keep(std::move(file));
  return std::unique_ptr<Storage>(*std::move(storage));
}

}  // namespace orca::recording
