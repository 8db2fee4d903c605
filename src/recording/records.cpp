// SPDX-License-Identifier: LGPL-3.0-or-later
#include "records.hpp"

#include "compression.hpp"

namespace orca::recording {

void put_magic(Bytes& out) { put(out, std::as_bytes(std::span(kMagic))); }

void put_record(Bytes& out, Op op, std::span<const std::byte> content) {
  put(out, static_cast<std::uint8_t>(op), static_cast<std::uint64_t>(content.size()), content);
}

void put_record(Bytes& out, const Header& header) {
  put_record(out, Op::header, encoded(header.profile, header.library));
}

void put_record(Bytes& out, const Schema& schema) {
  put_record(out, Op::schema, encoded(schema.id, schema.name, schema.encoding, schema.data));
}

void put_record(Bytes& out, const Channel& channel) {
  put_record(out, Op::channel,
             encoded(channel.id, channel.schema, channel.topic, channel.message_encoding, channel.metadata));
}

void put_record(Bytes& out, const Message& message) {
  constexpr std::uint64_t kHead = 2 + 4 + 8 + 8;
  put(out, static_cast<std::uint8_t>(Op::message), kHead + message.payload.size());
  put(out, message.channel, message.sequence, message.log_time, message.publish_time, message.payload);
}

void put_record(Bytes& out, const Attachment& attachment) {
  Bytes content = encoded(attachment.log_time, attachment.create_time, attachment.name, attachment.media_type,
                          static_cast<std::uint64_t>(attachment.data.size()), attachment.data);
  put(content, crc_of(content));
  put_record(out, Op::attachment, content);
}

void put_record(Bytes& out, const Metadata& metadata) {
  put_record(out, Op::metadata, encoded(metadata.name, metadata.values));
}

std::optional<Header> read_header(std::span<const std::byte> content) {
  return read_members(content, &Header::profile, &Header::library);
}

std::optional<Schema> read_schema(std::span<const std::byte> content) {
  auto schema = read_members(content, &Schema::id, &Schema::name, &Schema::encoding, &Schema::data);
  return schema && schema->id != 0 ? schema : std::nullopt;
}

std::optional<Channel> read_channel(std::span<const std::byte> content) {
  return read_members(content, &Channel::id, &Channel::schema, &Channel::topic, &Channel::message_encoding,
                      &Channel::metadata);
}

std::optional<Message> read_message(std::span<const std::byte> content) {
  Cursor cursor(content);
  Message message;
  cursor.get(message.channel);
  cursor.get(message.sequence);
  cursor.get(message.log_time);
  cursor.get(message.publish_time);
  message.payload = cursor.left();
  return cursor.is_good() ? std::optional(message) : std::nullopt;
}

std::optional<Attachment> read_attachment(std::span<const std::byte> content) {
  Cursor cursor(content);
  Attachment attachment;
  cursor.get(attachment.log_time);
  cursor.get(attachment.create_time);
  cursor.get(attachment.name);
  cursor.get(attachment.media_type);
  const auto data = cursor.take(cursor.number<std::uint64_t>());
  attachment.data.assign(data.begin(), data.end());
  const auto crc = cursor.number<std::uint32_t>();
  if (!cursor.is_done() || (crc != 0 && crc != crc_of(content.first(content.size() - sizeof crc))))
    return std::nullopt;
  return attachment;
}

std::optional<Metadata> read_metadata(std::span<const std::byte> content) {
  return read_members(content, &Metadata::name, &Metadata::values);
}

std::optional<Footer> read_footer(std::span<const std::byte> content) {
  return read_members(content, &Footer::summary_start, &Footer::summary_offset_start, &Footer::summary_crc);
}

std::optional<Record> RecordWalk::next() {
  if (at_ > bytes_.size()) return std::nullopt;
  Cursor cursor(bytes_.subspan(at_));
  const auto op = static_cast<Op>(cursor.number<std::uint8_t>());
  const auto content = cursor.take(cursor.number<std::uint64_t>());
  if (!cursor.is_good()) return std::nullopt;
  const Record record{op, at_, content};
  at_ = record.end();
  return record;
}

Result<OpenChunk> open_chunk(std::span<const std::byte> content) {
  Cursor cursor(content);
  OpenChunk chunk;
  cursor.get(chunk.start);
  cursor.get(chunk.end);
  const auto size = cursor.number<std::uint64_t>();
  const auto crc = cursor.number<std::uint32_t>();
  cursor.get(chunk.compression);
  cursor.get(chunk.compressed_size);
  const auto frame = cursor.take(chunk.compressed_size);
  if (!cursor.is_done())
    return fail(Code::data_loss, "a chunk is damaged: its lengths contradict each other");
  Result<Bytes> bytes = decompress(chunk.compression, frame, size);
  if (!bytes) return bytes.error();
  if (crc != 0 && crc != crc_of(*bytes))
    return fail(Code::data_loss, "a chunk is damaged: its checksum is wrong");
  chunk.content = *std::move(bytes);
  return chunk;
}

}  // namespace orca::recording
