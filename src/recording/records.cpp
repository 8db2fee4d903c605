// SPDX-License-Identifier: LGPL-3.0-or-later
#include "records.hpp"

#include <algorithm>

#include "compression.hpp"

namespace orca::recording {
namespace {

template <class T>
std::optional<T> if_good(const Cursor& cursor, T value) {
  return cursor.is_good() ? std::optional(std::move(value)) : std::nullopt;
}

}  // namespace

void put_magic(Bytes& out) { put(out, std::as_bytes(std::span(kMagic))); }

void put_record(Bytes& out, Op op, std::span<const std::byte> content) {
  put(out, static_cast<std::uint8_t>(op));
  put(out, static_cast<std::uint64_t>(content.size()));
  put(out, content);
}

void put_record(Bytes& out, const Header& header) {
  Bytes content;
  put(content, std::string_view(header.profile));
  put(content, std::string_view(header.library));
  put_record(out, Op::header, content);
}

void put_record(Bytes& out, const Schema& schema) {
  Bytes content;
  put(content, schema.id);
  put(content, std::string_view(schema.name));
  put(content, std::string_view(schema.encoding));
  put(content, std::string_view(schema.data));
  put_record(out, Op::schema, content);
}

void put_record(Bytes& out, const Channel& channel) {
  Bytes content;
  put(content, channel.id);
  put(content, channel.schema);
  put(content, std::string_view(channel.topic));
  put(content, std::string_view(channel.message_encoding));
  put(content, channel.metadata);
  put_record(out, Op::channel, content);
}

void put_record(Bytes& out, const Message& message) {
  constexpr std::uint64_t kHead = 2 + 4 + 8 + 8;
  put(out, static_cast<std::uint8_t>(Op::message));
  put(out, kHead + message.payload.size());
  put(out, message.channel);
  put(out, message.sequence);
  put(out, message.log_time);
  put(out, message.publish_time);
  put(out, message.payload);
}

void put_record(Bytes& out, const Attachment& attachment) {
  Bytes content;
  put(content, attachment.log_time);
  put(content, attachment.create_time);
  put(content, std::string_view(attachment.name));
  put(content, std::string_view(attachment.media_type));
  put(content, static_cast<std::uint64_t>(attachment.data.size()));
  put(content, attachment.data);
  put(content, crc_of(content));
  put_record(out, Op::attachment, content);
}

void put_record(Bytes& out, const Metadata& metadata) {
  Bytes content;
  put(content, std::string_view(metadata.name));
  put(content, metadata.values);
  put_record(out, Op::metadata, content);
}

std::optional<Header> read_header(std::span<const std::byte> content) {
  Cursor cursor(content);
  Header header{cursor.text(), {}};
  header.library = cursor.text();
  return if_good(cursor, std::move(header));
}

std::optional<Schema> read_schema(std::span<const std::byte> content) {
  Cursor cursor(content);
  Schema schema;
  schema.id = cursor.number<std::uint16_t>();
  schema.name = cursor.text();
  schema.encoding = cursor.text();
  schema.data = cursor.text();
  if (schema.id == 0) return std::nullopt;
  return if_good(cursor, std::move(schema));
}

std::optional<Channel> read_channel(std::span<const std::byte> content) {
  Cursor cursor(content);
  Channel channel;
  channel.id = cursor.number<std::uint16_t>();
  channel.schema = cursor.number<std::uint16_t>();
  channel.topic = cursor.text();
  channel.message_encoding = cursor.text();
  channel.metadata = cursor.values();
  return if_good(cursor, std::move(channel));
}

std::optional<Message> read_message(std::span<const std::byte> content) {
  Cursor cursor(content);
  Message message;
  message.channel = cursor.number<std::uint16_t>();
  message.sequence = cursor.number<std::uint32_t>();
  message.log_time = cursor.number<std::uint64_t>();
  message.publish_time = cursor.number<std::uint64_t>();
  message.payload = cursor.left();
  return if_good(cursor, message);
}

std::optional<Attachment> read_attachment(std::span<const std::byte> content) {
  Cursor cursor(content);
  Attachment attachment;
  attachment.log_time = cursor.number<std::uint64_t>();
  attachment.create_time = cursor.number<std::uint64_t>();
  attachment.name = cursor.text();
  attachment.media_type = cursor.text();
  const auto data = cursor.take(cursor.number<std::uint64_t>());
  attachment.data.assign(data.begin(), data.end());
  const auto crc = cursor.number<std::uint32_t>();
  if (!cursor.is_done() || (crc != 0 && crc != crc_of(content.first(content.size() - sizeof crc))))
    return std::nullopt;
  return attachment;
}

std::optional<Metadata> read_metadata(std::span<const std::byte> content) {
  Cursor cursor(content);
  Metadata metadata{cursor.text(), {}};
  metadata.values = cursor.values();
  return if_good(cursor, std::move(metadata));
}

std::optional<Footer> read_footer(std::span<const std::byte> content) {
  Cursor cursor(content);
  Footer footer;
  footer.summary_start = cursor.number<std::uint64_t>();
  footer.summary_offset_start = cursor.number<std::uint64_t>();
  footer.summary_crc = cursor.number<std::uint32_t>();
  return if_good(cursor, footer);
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
  chunk.start = cursor.number<std::uint64_t>();
  chunk.end = cursor.number<std::uint64_t>();
  const auto size = cursor.number<std::uint64_t>();
  const auto crc = cursor.number<std::uint32_t>();
  chunk.compression = cursor.text();
  chunk.compressed_size = cursor.number<std::uint64_t>();
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
