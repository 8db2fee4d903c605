// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/recording/writer.hpp"

#include <catch2/catch.hpp>

#include "memory_output.hpp"
#include "scan.hpp"

using namespace orca;
using namespace orca::recording;
using namespace orca::test;

TEST_CASE("what is written is read again: messages in order, schemas, channels, attachments and metadata",
          "[recording][writer]") {
  Memory memory;
  Writer writer(to(memory), "ros2", "orca");
  write_numbers(writer, 100);
  const std::string graph = "<graph/>";
  REQUIRE(
      writer.attach({5, 6, "graph.xml", "text/xml", {bytes_of(graph).begin(), bytes_of(graph).end()}}).ok());
  REQUIRE(writer.note({"orca.run", {{"clock", "virtual"}, {"seed", "7"}}}).ok());
  REQUIRE(writer.close().ok());
  CHECK(memory.is_finished);

  const Result<Reader> reader = Reader::of(memory.bytes);
  REQUIRE(reader);
  CHECK(reader->has_index());
  CHECK(scan(memory.bytes, {})->header.profile == "ros2");  // by which viewers know what it is
  CHECK(reader->library() == "orca");
  const std::vector<Seen> seen = all_messages(*reader);
  REQUIRE(seen.size() == 100);
  CHECK(seen[0] == Seen{"/a", 0, 0, 1, "0"});
  CHECK(seen[99] == Seen{"/b", 990'000'000, 495'000'000, 50, "99"});
  CHECK(reader->statistics().messages == 100);
  CHECK(reader->statistics().end == 990'000'000);
  REQUIRE(reader->schemas().size() == 1);
  CHECK(reader->schemas().begin()->second.data == "string text");
  CHECK(reader->channels().begin()->second.metadata.at("orca.port") == "a.out");
  REQUIRE(reader->attachments().size() == 1);
  const Result<Attachment> attachment = reader->attachment(reader->attachments()[0]);
  REQUIRE(attachment);
  CHECK(attachment->data.size() == graph.size());
  CHECK(attachment->create_time == 6);
  REQUIRE(reader->metadata().size() == 1);
  CHECK(reader->metadata(reader->metadata()[0])->values.at("seed") == "7");
  CHECK(check(memory.bytes)->findings.empty());
}

TEST_CASE(
    "a chunk is closed at the first message that is 250 ms later than its first, in one piece with its index",
    "[recording][writer]") {
  Memory memory;
  Writer writer(to(memory), "", "orca");
  write_numbers(writer, 26);  // the last one is at 250 ms
  CHECK(memory.pieces.size() == 1);
  REQUIRE(writer.close().ok());
  CHECK(memory.pieces.size() == 3);  // and the second chunk, and the end
  CHECK(Reader::of(memory.bytes)->chunks().size() == 2);
}

TEST_CASE("a chunk is closed when it is large, so none is much larger than 768 KiB and a message",
          "[recording][writer]") {
  Memory memory;
  Writer writer(to(memory), "", "orca");
  const std::uint16_t channel = writer.add_channel(0, "/image", "cdr", {});
  const std::string payload(300'000, 'x');
  for (std::uint32_t i = 0; i < 9; ++i) REQUIRE(writer.write({channel, i, 0, 0, bytes_of(payload)}).ok());
  REQUIRE(writer.close().ok());
  const Result<Reader> reader = Reader::of(memory.bytes);
  REQUIRE(reader->chunks().size() == 3);
  for (const ChunkIndex& chunk : reader->chunks())
    CHECK(chunk.uncompressed_size < Writer::kChunkBytes + payload.size() + 100);
}

TEST_CASE("equal schemas are written once, and others have numbers of their own", "[recording][writer]") {
  Memory memory;
  Writer writer(to(memory), "", "orca");
  const std::uint16_t one = writer.add_schema("A", "ros2msg", "x");
  CHECK(writer.add_schema("A", "ros2msg", "x") == one);
  CHECK(writer.add_schema("A", "ros2msg", "y") != one);
}

TEST_CASE("a writer whose output fails says so at each later call, and the file keeps its whole pieces",
          "[recording][writer][fault]") {
  Memory memory;
  memory.room = 2;
  Writer writer(to(memory), "", "orca");
  write_numbers(writer, 100);
  CHECK(writer.flush().error().message == "the disk is full");
  CHECK(writer.close().error().message == "the disk is full");
  const Result<Reader> reader = Reader::of(memory.bytes);
  REQUIRE(reader);
  CHECK_FALSE(reader->has_index());
  CHECK(all_messages(*reader).size() == 50);
}
