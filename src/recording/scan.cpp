// SPDX-License-Identifier: LGPL-3.0-or-later
#include "scan.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace orca::recording {
namespace {

class Scan {
 public:
  Scan(std::span<const std::byte> bytes, const Onlookers& onlookers) : bytes_(bytes), onlookers_(onlookers) {}

  Result<Scanned> run() {
    RecordWalk walk(bytes_, sizeof kMagic);
    const std::optional<Record> first = walk.next();
    const std::optional<Header> header =
        first && first->op == Op::header ? read_header(first->content) : std::nullopt;
    if (!header) return fail(Code::invalid_argument, "this is no MCAP file: it has no header");
    found_.header = *header;
    Status status = pass_on(*first, nullptr);
    while (status.ok() && !found_.has_end) {
      found_.whole = walk.offset();
      const std::optional<Record> record = walk.next();
      if (!record) break;
      status = take(*record);
    }
    if (!status.ok()) return status.error();
    if (!found_.has_end) note(walk.offset(), end_text(walk));
    return std::move(found_);
  }

 private:
  [[nodiscard]] std::string end_text(const RecordWalk& walk) const {
    if (walk.is_at_end()) return "the file has no end: whoever wrote it was interrupted";
    return "the file ends in the middle of a record, of which " +
           std::to_string(bytes_.size() - walk.offset()) +
           " bytes are there: whoever wrote it was interrupted";
  }

  void note(std::uint64_t offset, std::string text) { found_.findings.push_back({offset, std::move(text)}); }

  Status pass_on(const Record& record, const OpenChunk* chunk) const {
    return onlookers_.record ? onlookers_.record(record, chunk) : ok();
  }

  Status take(const Record& record) {
    switch (record.op) {
      case Op::data_end: found_.has_end = true; return ok();
      case Op::chunk: return take_chunk(record);
      case Op::schema:
      case Op::channel:
        if (found_.summary.take(record)) return pass_on(record, nullptr);
        note(record.offset, "a schema or channel is damaged");
        return ok();
      case Op::message:
        if (!take_message(record)) return ok();
        found_.loose.push_back(record);
        return pass_on(record, nullptr);
      case Op::attachment:
      case Op::metadata: return take_extra(record);
      default: return ok();  // indexes, and what this reader does not know
    }
  }

  // Returns false if the message is of no use.
  bool take_message(const Record& record) {
    const std::optional<Message> message = read_message(record.content);
    if (!message || !found_.summary.channels.contains(message->channel)) {
      note(record.offset, message ? "a message is of channel " + std::to_string(message->channel) +
                                        ", which the file does not have"
                                  : "a message is damaged");
      return false;
    }
    found_.summary.count(*message);
    if (onlookers_.message) onlookers_.message(*message);
    return true;
  }

  Status take_chunk(const Record& record) {
    const Result<OpenChunk> chunk = open_chunk(record.content);
    if (!chunk) {
      note(record.offset, chunk.error().message);
      return ok();
    }
    ChunkIndex index{chunk->start,
                     chunk->end,
                     record.offset,
                     record.end() - record.offset,
                     {},
                     0,
                     chunk->compression,
                     chunk->compressed_size,
                     chunk->content.size()};
    bool is_first = true;
    RecordWalk walk(chunk->content);
    while (const std::optional<Record> inner = walk.next()) {
      if (inner->op == Op::message) {
        if (take_message({inner->op, record.offset, inner->content}))
          widen(index, read_message(inner->content)->log_time, std::exchange(is_first, false));
      } else if (!take_definition(*inner)) {
        note(record.offset, "a schema or channel in a chunk is damaged");
      }
    }
    found_.summary.chunks.push_back(std::move(index));
    ++found_.summary.statistics.chunks;
    if (!walk.is_at_end()) note(record.offset, "a chunk ends in the middle of a record");
    return pass_on(record, &*chunk);
  }

  // Takes a record in a chunk, where nothing but schemas and channels counts besides messages. Returns false if it is damaged.
  bool take_definition(const Record& inner) {
    return (inner.op != Op::schema && inner.op != Op::channel) || found_.summary.take(inner);
  }

  // The times of a chunk are those of its messages, whatever it says of itself.
  static void widen(ChunkIndex& index, Stamp time, bool is_first) {
    index.start = is_first ? time : std::min(index.start, time);
    index.end = is_first ? time : std::max(index.end, time);
  }

  Status take_extra(const Record& record) {
    IndexEntry entry{record.offset, record.end() - record.offset, {}, {}, 0, 0, 0};
    if (record.op == Op::attachment) {
      const std::optional<Attachment> attachment = read_attachment(record.content);
      if (!attachment) return note(record.offset, "an attachment is damaged"), ok();
      entry.name = attachment->name;
      entry.media_type = attachment->media_type;
      entry.data_size = attachment->data.size();
      entry.log_time = attachment->log_time;
      entry.create_time = attachment->create_time;
      found_.summary.attachments.push_back(std::move(entry));
    } else {
      const std::optional<Metadata> metadata = read_metadata(record.content);
      if (!metadata) return note(record.offset, "metadata are damaged"), ok();
      entry.name = metadata->name;
      found_.summary.metadata.push_back(std::move(entry));
    }
    return pass_on(record, nullptr);
  }

  const std::span<const std::byte> bytes_;
  const Onlookers& onlookers_;
  Scanned found_;
};

}  // namespace

Result<Scanned> scan(std::span<const std::byte> bytes, const Onlookers& onlookers) {
  if (bytes.size() < sizeof kMagic || std::memcmp(bytes.data(), kMagic, sizeof kMagic) != 0)
    return fail(Code::invalid_argument, "this is no MCAP file: it does not begin like one");
  return Scan(bytes, onlookers).run();
}

}  // namespace orca::recording
