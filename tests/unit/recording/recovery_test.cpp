// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "memory_output.hpp"

using namespace orca;
using namespace orca::recording;
using namespace orca::test;

namespace {

test::Bytes file_with_extras(int count) {
  Memory memory;
  Writer writer(to(memory), "ros2", "orca");
  REQUIRE(writer.note({"orca.run", {{"seed", "1"}}}).ok());
  REQUIRE(writer.attach({0, 0, "graph.xml", "text/xml", {}}).ok());
  write_numbers(writer, count);
  REQUIRE(writer.close().ok());
  return memory.bytes;
}

}  // namespace

TEST_CASE("a file whose writer was killed is recovered: all whole records, with an index and an end",
          "[recording][recovery]") {
  const test::Bytes whole = file_with_extras(100);
  const auto cut = GENERATE_REF(take(20, random(std::size_t{0}, whole.size() - 1)));
  const auto torn = std::span(whole).first(cut);
  const Result<Reader> before = Reader::of(torn);
  Memory memory;
  const Result<Examination> examined = recover(torn, to(memory));
  REQUIRE(examined.has_value() == before.has_value());
  if (!before) return;
  CHECK_FALSE(examined->findings.empty());
  CHECK(check(memory.bytes)->findings.empty());
  const Result<Reader> after = Reader::of(memory.bytes);
  REQUIRE(after);
  CHECK(after->has_index());
  CHECK(all_messages(*after) == all_messages(*before));
  CHECK(after->attachments().size() == before->attachments().size());
  CHECK(after->metadata().size() == before->metadata().size());
  for (const IndexEntry& entry : after->metadata()) CHECK(after->metadata(entry)->values.at("seed") == "1");
}

TEST_CASE("a damaged chunk costs its own messages only", "[recording][recovery][fault]") {
  test::Bytes bytes = file_with_extras(100);
  const ChunkIndex chunk = Reader::of(bytes)->chunks()[1];
  bytes[chunk.offset + chunk.length - 3] ^= std::byte{0xff};
  Memory memory;
  const Result<Examination> examined = recover(bytes, to(memory));
  REQUIRE(examined);
  REQUIRE(examined->findings.size() == 1);
  CHECK(examined->findings[0].offset == chunk.offset);
  CHECK(all_messages(*Reader::of(memory.bytes)).size() == 75);
  CHECK(examined->remarks == std::vector<std::string>{"/a: 12 numbers are missing between its messages",
                                                      "/b: 13 numbers are missing between its messages"});
}

TEST_CASE("the recovery of a file that is in order has the same messages", "[recording][recovery]") {
  const test::Bytes bytes = file_with_extras(100);
  Memory memory;
  CHECK(recover(bytes, to(memory))->findings.empty());
  CHECK(all_messages(*Reader::of(memory.bytes)) == all_messages(*Reader::of(bytes)));
  CHECK(check(memory.bytes)->findings.empty());
}
