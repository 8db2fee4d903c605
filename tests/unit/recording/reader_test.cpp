// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/recording/reader.hpp"

#include <lz4frame.h>

#include <algorithm>
#include <catch2/catch.hpp>

#include "memory_output.hpp"
#include "records.hpp"
#include "scan.hpp"
#include "summary.hpp"

using namespace orca;
using namespace orca::recording;
using namespace orca::test;

namespace {

test::Bytes file_of(int count) {
  Memory memory;
  Writer writer(to(memory), "ros2", "orca");
  write_numbers(writer, count);
  REQUIRE(writer.close().ok());
  return memory.bytes;
}

// The beginning of a file of another writer, with one channel.
test::Bytes foreign_beginning() {
  test::Bytes bytes;
  put_magic(bytes);
  put_record(bytes, recording::Header{"", "another"});
  put_record(bytes, Channel{3, 0, "/x", "json", {}});
  return bytes;
}

// Appends a chunk without compression and checksum, which says of itself that it is of the times 10 to 10.
void put_plain_chunk(test::Bytes& bytes, const test::Bytes& inner) {
  test::Bytes content;
  for (const std::uint64_t number : {std::uint64_t{10}, std::uint64_t{10}, std::uint64_t{inner.size()}})
    put(content, number);
  put(content, std::uint32_t{0});
  put(content, std::string_view());
  put(content, std::uint64_t{inner.size()});
  put(content, inner);
  put_record(bytes, Op::chunk, content);
}

}  // namespace

TEST_CASE("messages come in the order of their times, however they were written", "[recording][reader]") {
  Memory memory;
  Writer writer(to(memory), "", "orca");
  const std::uint16_t channel = writer.add_channel(0, "/x", "json", {});
  for (const Stamp time : {400, 100, 300, 200}) {
    const std::string payload = std::to_string(time);
    REQUIRE(writer.write({channel, 0, time * 1'000'000, 0, bytes_of(payload)}).ok());
  }
  REQUIRE(writer.close().ok());
  std::string order;
  for (const Seen& seen : all_messages(*Reader::of(memory.bytes))) order += seen.payload + " ";
  CHECK(order == "100 200 300 400 ");
}

TEST_CASE("only messages of the channels that are asked for come, until no more are wanted",
          "[recording][reader]") {
  const test::Bytes bytes = file_of(100);
  const Result<Reader> reader = Reader::of(bytes);
  const std::uint16_t b =
      std::ranges::find(reader->channels(), "/b", [](const auto& c) { return c.second.topic; })->first;
  CHECK(all_messages(*reader, {b}).size() == 50);
  int count = 0;
  REQUIRE(reader->messages({}, [&](const Message&) { return ++count < 7; }).ok());
  CHECK(count == 7);
}

TEST_CASE("files of other writers are read: messages without chunks, and chunks of lz4 or no compression",
          "[recording][reader]") {
  test::Bytes inner;
  put_record(inner, Message{3, 1, 10, 10, bytes_of("one")});
  test::Bytes bytes = foreign_beginning();
  put(bytes, inner);
  for (const std::string compression : {"", "lz4"}) {
    test::Bytes frame = inner;
    if (compression == "lz4") {
      frame.resize(LZ4F_compressFrameBound(inner.size(), nullptr));
      frame.resize(LZ4F_compressFrame(frame.data(), frame.size(), inner.data(), inner.size(), nullptr));
    }
    test::Bytes content;
    for (const std::uint64_t number : {std::uint64_t{10}, std::uint64_t{10}, std::uint64_t{inner.size()}})
      put(content, number);
    put(content, std::uint32_t{0});  // no checksum
    put(content, std::string_view(compression));
    put(content, std::uint64_t{frame.size()});
    put(content, frame);
    put_record(bytes, Op::chunk, content);
  }
  const Result<Reader> reader = Reader::of(bytes);
  REQUIRE(reader);
  CHECK(reader->library() == "another");
  CHECK(all_messages(*reader) == std::vector<Seen>(3, Seen{"/x", 10, 10, 1, "one"}));
}

TEST_CASE("messages that lie outside of chunks are read from a file with an index, too",
          "[recording][reader]") {
  test::Bytes inner;
  put_record(inner, Message{3, 1, 20, 20, bytes_of("in a chunk")});
  test::Bytes bytes = foreign_beginning();
  put_record(bytes, Message{3, 1, 10, 10, bytes_of("before")});
  put_plain_chunk(bytes, inner);
  put_record(bytes, Message{3, 1, 15, 15, bytes_of("between")});
  put_plain_chunk(bytes, inner);
  put_record(bytes, Message{3, 1, 30, 30, bytes_of("after")});
  Result<Scanned> scanned = scan(bytes, {});
  REQUIRE(scanned);
  put(bytes, scanned->summary.encode(bytes.size()));
  const Result<Reader> reader = Reader::of(bytes);
  REQUIRE(reader);
  CHECK(reader->has_index());
  std::string order;
  for (const Seen& seen : all_messages(*reader)) order += seen.payload + "; ";
  CHECK(order == "before; between; in a chunk; in a chunk; after; ");
}

TEST_CASE("reading from a time on passes over what is earlier, and opens no chunk that ends before it",
          "[recording][reader]") {
  test::Bytes bytes = file_of(100);  // 10 ms apart
  const std::uint64_t first = Reader::of(bytes)->chunks().at(0).offset;
  bytes[first + kRecordHead + 60] ^= std::byte{0xFF};  // the first chunk is damaged
  std::vector<Stamp> times;
  REQUIRE(Reader::of(bytes)
              ->messages(
                  {}, [&](const Message& one) { return times.push_back(one.log_time), true; }, 750'000'000)
              .ok());
  REQUIRE(times.size() == 25);
  CHECK(times.front() == 750'000'000);
}

TEST_CASE(
    "a chunk that says wrong times of itself does not change the order, and messages of no channel are left "
    "out",
    "[recording][reader][fault]") {
  test::Bytes bytes = foreign_beginning();
  for (const Stamp time : {20, 10}) {
    test::Bytes inner;
    put_record(inner, Message{3, 1, time, time, bytes_of("x")});
    put_record(inner, Message{4, 1, time, time, bytes_of("of no channel")});
    test::Bytes content;
    for (const std::uint64_t number :
         {std::uint64_t{50} - time, std::uint64_t{50}, std::uint64_t{inner.size()}})
      put(content, number);
    put(content, std::uint32_t{0});
    put(content, std::string_view());
    put(content, std::uint64_t{inner.size()});
    put(content, inner);
    put_record(bytes, Op::chunk, content);
  }
  const Result<Reader> reader = Reader::of(bytes);
  CHECK(all_messages(*reader) == std::vector<Seen>{{"/x", 10, 10, 1, "x"}, {"/x", 20, 20, 1, "x"}});
  CHECK(reader->findings().size() == 3);  // two messages, and the missing end
}

TEST_CASE("what belongs into a summary counts for nothing in a chunk", "[recording][reader][fault]") {
  test::Bytes index;  // of a chunk that is not there
  for (int i = 0; i < 4; ++i) put(index, std::uint64_t{7});
  put(index, std::uint32_t{0});
  put(index, std::uint64_t{0});
  put(index, std::string_view());
  put(index, std::uint64_t{0});
  put(index, std::uint64_t{0});
  test::Bytes inner;
  for (int i = 0; i < 10; ++i) put_record(inner, Op::chunk_index, index);
  put_record(inner, Message{3, 1, 20, 20, bytes_of("x")});
  test::Bytes bytes = foreign_beginning();
  put_plain_chunk(bytes, inner);
  const Result<Reader> reader = Reader::of(bytes);
  REQUIRE(reader);
  REQUIRE(reader->chunks().size() == 1);
  CHECK(reader->chunks()[0].start == 20);
  CHECK(all_messages(*reader) == std::vector<Seen>{{"/x", 20, 20, 1, "x"}});
}

TEST_CASE("an index that names a chunk more than once is not believed", "[recording][reader][fault]") {
  test::Bytes inner;
  put_record(inner, Message{3, 1, 10, 10, bytes_of("x")});
  test::Bytes bytes = foreign_beginning();
  put_plain_chunk(bytes, inner);
  Summary summary;
  summary.channels[3] = Channel{3, 0, "/x", "json", {}};
  summary.chunks.assign(100'000, Reader::of(bytes)->chunks().at(0));
  put(bytes, summary.encode(bytes.size()));
  const Result<Reader> reader = Reader::of(bytes);
  REQUIRE(reader);
  CHECK_FALSE(reader->has_index());
  CHECK(all_messages(*reader) == std::vector<Seen>{{"/x", 10, 10, 1, "x"}});
}

TEST_CASE("chunks of one time that are too large to be sorted in memory end the reading with an error",
          "[recording][reader][fault]") {
  Memory memory;
  Writer writer(to(memory), "", "orca");
  const std::uint16_t channel = writer.add_channel(0, "/x", "json", {});
  const test::Bytes zeros(std::size_t{128} << 20);
  for (int i = 0; i < 5; ++i) REQUIRE(writer.write({channel, 0, 10, 10, zeros}).ok());
  REQUIRE(writer.close().ok());
  CHECK(memory.bytes.size() < std::size_t{1} << 20);
  int count = 0;
  const Status read = Reader::of(memory.bytes)->messages({}, [&](const Message&) { return ++count, true; });
  REQUIRE_FALSE(read.ok());
  CHECK(read.error().code == Code::data_loss);
  CHECK_THAT(read.error().message, Catch::EndsWith("which is too much to sort"));
  CHECK(count == 4);
}

TEST_CASE("bytes that are no MCAP file are refused with the reason", "[recording][reader]") {
  CHECK(Reader::of({}).error().message == "this is no MCAP file: it does not begin like one");
  CHECK(Reader::of(bytes_of("SQLite format 3, and more")).error().code == Code::invalid_argument);
  const Result<Reader> none = Reader::open("/nonexistent/x.mcap");
  CHECK(none.error().text() == "/nonexistent/x.mcap: cannot read the file: No such file or directory");
}

TEST_CASE("a file that is cut at any byte is read as far as its records are whole",
          "[recording][reader][fault]") {
  const test::Bytes whole = file_of(60);
  std::size_t last = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Result<Reader> reader = Reader::of(std::span(whole).first(size));
    if (!reader) continue;
    const std::size_t count = all_messages(*reader).size();
    CHECK(count >= last);
    CHECK_FALSE(reader->has_index());
    last = count;
  }
  CHECK(last == 60);
}

TEST_CASE("a file with one wrong byte is never read wrongly without a word", "[recording][reader][fault]") {
  const test::Bytes whole = file_of(60);
  const std::vector<Seen> right = all_messages(*Reader::of(whole));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    test::Bytes bytes = whole;
    bytes[i] ^= std::byte{0x10};
    const Result<Examination> examined = check(bytes);
    if (!examined || !examined->findings.empty()) continue;
    // Not covered by a checksum: the header's texts, the schemas and channels and their lengths, and the message indexes.
    const Result<Reader> reader = Reader::of(bytes);
    REQUIRE(reader);
    const std::vector<Seen> seen = all_messages(*reader);
    REQUIRE(seen.size() == right.size());
    for (std::size_t k = 0; k < seen.size(); ++k) CHECK(seen[k].payload == right[k].payload);
  }
}

TEST_CASE("a chunk that claims to hold more than it does is refused without memory for it",
          "[recording][reader][fault]") {
  test::Bytes content;
  for (const std::uint64_t number : {std::uint64_t{0}, std::uint64_t{0}, std::uint64_t{400} << 20})
    put(content, number);
  put(content, std::uint32_t{0});
  put(content, std::string_view("zstd"));
  const test::Bytes frame(50);
  put(content, std::uint64_t{frame.size()});
  put(content, frame);
  test::Bytes bytes = foreign_beginning();
  put_record(bytes, Op::chunk, content);
  const Result<Examination> examined = check(bytes);
  REQUIRE(examined);
  CHECK(examined->findings.size() == 2);  // the chunk, and the missing end
  CHECK(examined->findings[0].text.starts_with("a chunk is damaged"));
}
