// SPDX-License-Identifier: LGPL-3.0-or-later
#include "summary.hpp"

#include <algorithm>
#include <utility>

#include "compression.hpp"

namespace orca::recording {
namespace {

using Places = std::map<std::uint16_t, std::vector<std::pair<Stamp, std::uint64_t>>>;

void put_record(Bytes& out, const ChunkIndex& index) {
  put_record(
      out, Op::chunk_index,
      encoded(index.start, index.end, index.offset, index.length, index.message_index_offsets,
              index.message_index_length, index.compression, index.compressed_size, index.uncompressed_size));
}

void put_attachment_index(Bytes& out, const IndexEntry& entry) {
  put_record(out, Op::attachment_index,
             encoded(entry.offset, entry.length, entry.log_time, entry.create_time, entry.data_size,
                     entry.name, entry.media_type));
}

void put_metadata_index(Bytes& out, const IndexEntry& entry) {
  put_record(out, Op::metadata_index, encoded(entry.offset, entry.length, entry.name));
}

void put_statistics(Bytes& out, const Summary& summary) {
  const Statistics& numbers = summary.statistics;
  Bytes content = encoded(numbers.messages, static_cast<std::uint16_t>(summary.schemas.size()));
  for (const std::size_t count :
       {summary.channels.size(), summary.attachments.size(), summary.metadata.size(), summary.chunks.size()})
    put(content, static_cast<std::uint32_t>(count));
  put(content, numbers.start, numbers.end, numbers.by_channel);
  put_record(out, Op::statistics, content);
}

// Appends the message indexes of a chunk.
void put_places(Bytes& out, std::uint64_t offset, const Places& places, ChunkIndex& index) {
  const std::size_t begin = out.size();
  for (const auto& [channel, list] : places) {
    index.message_index_offsets[channel] = offset + out.size();
    Bytes content = encoded(channel, static_cast<std::uint32_t>(list.size() * 16));
    for (const auto& [time, place] : list) put(content, time, place);
    put_record(out, Op::message_index, content);
  }
  index.message_index_length = out.size() - begin;
}

Places places_in(std::span<const std::byte> content) {
  Places places;
  RecordWalk walk(content);
  while (const std::optional<Record> record = walk.next()) {
    if (record->op != Op::message) continue;
    if (const std::optional<Message> message = read_message(record->content))
      places[message->channel].emplace_back(message->log_time, record->offset);
  }
  return places;
}

std::optional<ChunkIndex> read_chunk_index(std::span<const std::byte> content) {
  return read_members(content, &ChunkIndex::start, &ChunkIndex::end, &ChunkIndex::offset, &ChunkIndex::length,
                      &ChunkIndex::message_index_offsets, &ChunkIndex::message_index_length,
                      &ChunkIndex::compression, &ChunkIndex::compressed_size, &ChunkIndex::uncompressed_size);
}

std::optional<IndexEntry> read_attachment_index(std::span<const std::byte> content) {
  return read_members(content, &IndexEntry::offset, &IndexEntry::length, &IndexEntry::log_time,
                      &IndexEntry::create_time, &IndexEntry::data_size, &IndexEntry::name,
                      &IndexEntry::media_type);
}

std::optional<IndexEntry> read_metadata_index(std::span<const std::byte> content) {
  return read_members(content, &IndexEntry::offset, &IndexEntry::length, &IndexEntry::name);
}

std::optional<Statistics> read_statistics(std::span<const std::byte> content) {
  Cursor cursor(content);
  Statistics numbers;
  cursor.get(numbers.messages);
  (void)cursor.take(2 + 4 + 4 + 4);  // how many schemas, channels, attachments and metadata there are
  numbers.chunks = cursor.number<std::uint32_t>();
  cursor.get(numbers.start);
  cursor.get(numbers.end);
  cursor.get(numbers.by_channel);
  return cursor.is_good() ? std::optional(std::move(numbers)) : std::nullopt;
}

template <class T>
bool append(std::vector<T>& list, std::optional<T> value) {
  if (value) list.push_back(*std::move(value));
  return value.has_value();
}

template <class T>
bool insert(std::map<std::uint16_t, T>& all, std::optional<T> value) {
  if (value) all[value->id] = *value;
  return value.has_value();
}

}  // namespace

void Summary::count(const Message& message) {
  statistics.start =
      statistics.messages == 0 ? message.log_time : std::min(statistics.start, message.log_time);
  statistics.end = std::max(statistics.end, message.log_time);
  ++statistics.messages;
  ++statistics.by_channel[message.channel];
}

Bytes Summary::encode(std::uint64_t offset) const {
  Bytes out;
  put_record(out, Op::data_end, Bytes(4));  // no checksum of all data: it would be known only at the end
  const std::size_t summary = out.size();
  Bytes offsets;
  std::size_t begin = out.size();
  const auto end_group = [&](Op op) {
    if (out.size() > begin)
      put_record(offsets, Op::summary_offset,
                 encoded(static_cast<std::uint8_t>(op), offset + begin,
                         static_cast<std::uint64_t>(out.size() - begin)));
    begin = out.size();
  };
  for (const auto& [id, schema] : schemas) recording::put_record(out, schema);
  end_group(Op::schema);
  for (const auto& [id, channel] : channels) recording::put_record(out, channel);
  end_group(Op::channel);
  put_statistics(out, *this);
  end_group(Op::statistics);
  for (const ChunkIndex& chunk : chunks) put_record(out, chunk);
  end_group(Op::chunk_index);
  for (const IndexEntry& entry : attachments) put_attachment_index(out, entry);
  end_group(Op::attachment_index);
  for (const IndexEntry& entry : metadata) put_metadata_index(out, entry);
  end_group(Op::metadata_index);
  const std::size_t offsets_at = out.size();
  put(out, offsets);
  put(out, static_cast<std::uint8_t>(Op::footer), static_cast<std::uint64_t>(kFooterBytes));
  put(out, offset + summary, offset + offsets_at);
  put(out, crc_of(std::span(out).subspan(summary)));
  put_magic(out);
  return out;
}

bool Summary::take(const Record& record) {
  switch (record.op) {
    case Op::schema: return insert(schemas, read_schema(record.content));
    case Op::channel: return insert(channels, read_channel(record.content));
    case Op::chunk_index: return append(chunks, read_chunk_index(record.content));
    case Op::attachment_index: return append(attachments, read_attachment_index(record.content));
    case Op::metadata_index: return append(metadata, read_metadata_index(record.content));
    case Op::statistics: {
      const std::optional<Statistics> numbers = read_statistics(record.content);
      if (numbers) statistics = *numbers;
      return numbers.has_value();
    }
    default: return true;
  }
}

void ChunkBuilder::add(const Message& message) {
  start_ = is_empty() ? message.log_time : std::min(start_, message.log_time);
  end_ = is_empty() ? message.log_time : std::max(end_, message.log_time);
  places_[message.channel].emplace_back(message.log_time, content_.size());
  recording::put_record(content_, message);
}

Result<ChunkIndex> ChunkBuilder::close(Bytes& out, std::uint64_t offset) {
  const Result<Bytes> compressed = compress(content_);
  if (!compressed) return compressed.error();
  const Bytes& frame = *compressed;
  ChunkIndex index{start_,       end_,           offset + out.size(), 0, {}, 0, std::string(kZstd),
                   frame.size(), content_.size()};
  const Bytes head = encoded(start_, end_, static_cast<std::uint64_t>(content_.size()), crc_of(content_),
                             kZstd, static_cast<std::uint64_t>(frame.size()));
  put(out, static_cast<std::uint8_t>(Op::chunk), static_cast<std::uint64_t>(head.size() + frame.size()));
  put(out, head, frame);
  index.length = kRecordHead + head.size() + frame.size();
  put_places(out, offset, places_, index);
  content_.clear();
  places_.clear();
  return index;
}

ChunkIndex put_chunk(Bytes& out, std::uint64_t offset, std::span<const std::byte> chunk_record,
                     const OpenChunk& chunk) {
  ChunkIndex index{chunk.start, chunk.end,         offset + out.size(),   chunk_record.size(), {},
                   0,           chunk.compression, chunk.compressed_size, chunk.content.size()};
  put(out, chunk_record);
  const Places places = places_in(chunk.content);
  std::vector<Stamp> times;
  for (const auto& [channel, list] : places)
    for (const auto& [time, place] : list) times.push_back(time);
  if (!times.empty()) index.start = *std::ranges::min_element(times);
  if (!times.empty()) index.end = *std::ranges::max_element(times);
  put_places(out, offset, places, index);
  return index;
}

}  // namespace orca::recording
