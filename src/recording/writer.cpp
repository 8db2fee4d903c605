// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/recording/writer.hpp"

#include <algorithm>
#include <utility>

#include "records.hpp"
#include "summary.hpp"

namespace orca::recording {

struct Writer::Inside {
  // Writes what is collected outside the chunk.
  Status write_out() {
    if (!status.ok() || collected.empty()) return status;
    offset += collected.size();
    status = output->append(std::exchange(collected, {}));
    return status;
  }
  [[nodiscard]] std::uint64_t here() const { return offset + collected.size(); }

  std::unique_ptr<Output> output;
  Summary summary;
  ChunkBuilder chunk;
  Bytes collected;           // records that follow what is written
  std::uint64_t offset = 0;  // [bytes] that are written
  Status status = ok();
  bool is_closed = false;
};

Writer::Writer(std::unique_ptr<Output> output, const std::string& profile, const std::string& library)
    : inside_(std::make_unique<Inside>()) {
  inside_->output = std::move(output);
  put_magic(inside_->collected);
  put_record(inside_->collected, Header{profile, library});
}

Writer::~Writer() { (void)close(); }

std::uint16_t Writer::add_schema(const std::string& name, const std::string& encoding,
                                 const std::string& data) {
  auto& schemas = inside_->summary.schemas;
  const auto same = std::ranges::find_if(schemas, [&](const auto& entry) {
    return entry.second.name == name && entry.second.encoding == encoding && entry.second.data == data;
  });
  if (same != schemas.end()) return same->first;
  const auto id = static_cast<std::uint16_t>(schemas.size() + 1);
  put_record(inside_->collected, schemas[id] = Schema{id, name, encoding, data});
  return id;
}

std::uint16_t Writer::add_channel(std::uint16_t schema, const std::string& topic,
                                  const std::string& message_encoding, const Values& metadata) {
  const auto id = static_cast<std::uint16_t>(inside_->summary.channels.size() + 1);
  put_record(inside_->collected,
             inside_->summary.channels[id] = Channel{id, schema, topic, message_encoding, metadata});
  return id;
}

Status Writer::write(const Message& message) {
  if (!inside_->status.ok()) return inside_->status;
  ChunkBuilder& chunk = inside_->chunk;
  if (!chunk.is_empty() && message.log_time >= chunk.start() + kChunkTime)
    if (const Status flushed = flush(); !flushed.ok()) return flushed;
  chunk.add(message);
  inside_->summary.count(message);
  return chunk.size() >= kChunkBytes ? flush() : ok();
}

Status Writer::attach(const Attachment& attachment) {
  const std::uint64_t offset = inside_->here();
  put_record(inside_->collected, attachment);
  inside_->summary.attachments.push_back({offset, inside_->here() - offset, attachment.name,
                                          attachment.media_type, attachment.data.size(), attachment.log_time,
                                          attachment.create_time});
  return inside_->write_out();
}

Status Writer::note(const Metadata& metadata) {
  const std::uint64_t offset = inside_->here();
  put_record(inside_->collected, metadata);
  inside_->summary.metadata.push_back({offset, inside_->here() - offset, metadata.name, {}, 0, 0, 0});
  return inside_->write_out();
}

Status Writer::flush() {
  if (!inside_->status.ok()) return inside_->status;
  if (!inside_->chunk.is_empty()) {
    Result<ChunkIndex> index = inside_->chunk.close(inside_->collected, inside_->offset);
    if (!index) return inside_->status = index.error();
    inside_->summary.chunks.push_back(*std::move(index));
    ++inside_->summary.statistics.chunks;
  }
  return inside_->write_out();
}

Status Writer::close() {
  if (std::exchange(inside_->is_closed, true)) return inside_->status;
  if (const Status flushed = flush(); !flushed.ok()) return flushed;
  inside_->collected = inside_->summary.encode(inside_->offset);
  if (const Status written = inside_->write_out(); !written.ok()) return written;
  return inside_->status = inside_->output->finish();
}

const Statistics& Writer::statistics() const { return inside_->summary.statistics; }

std::uint64_t Writer::size() const { return inside_->offset; }

}  // namespace orca::recording
