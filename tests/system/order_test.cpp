// SPDX-License-Identifier: GPL-3.0-or-later
// What the order of a graph's elements means, as docs/graph-parts.md says it.
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

// Two listeners that start at the same instant, and what they listen to.
const std::string kVoices =
    R"(<component name="first" type="test.Voice"/><component name="second" type="test.Voice"/>)";
const std::string kSink = R"(<component name="sink" type="test.CommandSink"/>)";
const std::string kDrain = R"(<component name="drain" type="test.CommandSink"/>)";
const std::string kToSink = R"(<connect from="first.motion" to="sink.motion"/>)";
const std::string kToDrain = R"(<connect from="second.motion" to="drain.motion"/>)";
const std::string kBothFromFirst = R"(<connect from="first.motion" to="drain.motion"/>)";

Words graph_of(const TempFolder& folder, const std::string& elements) {
  const std::string text =
      R"(<graph name="g" version="1" plugins="${plugins}"><arg name="plugins"/>)" + elements + "</graph>";
  return Words{folder.write("graph.xml", text)} + with_test_plugins();
}

std::string hash_of(const std::string& elements) {
  const TempFolder folder;
  const Run run = run_deployer(graph_of(folder, elements) + Words{"--until", "0.5 s"} + virtual_clock());
  INFO(run.err);
  REQUIRE(run.trace_hash());
  return *run.trace_hash();
}

}  // namespace

TEST_CASE("of components that are ready together, the one that comes first in the file goes first",
          "[system][order]") {
  const std::string connections = kToSink + kToDrain;
  const std::string as_written = hash_of(kVoices + kSink + kDrain + connections);
  const std::string exchanged = hash_of(kVoices + kDrain + kSink + connections);
  CHECK(exchanged != as_written);
  SECTION("unless its priority is lower") {
    const std::string urgent = R"(<component name="drain" type="test.CommandSink" priority="1"/>)";
    CHECK(hash_of(kVoices + kSink + urgent + connections) == exchanged);
    CHECK(hash_of(kVoices + urgent + kSink + connections) == exchanged);
  }
}

TEST_CASE("the order of connections, comments and blanks change nothing", "[system][order]") {
  const std::string as_written = hash_of(kVoices + kSink + kDrain + kToSink + kToDrain);
  CHECK(hash_of(kToSink + kToDrain + kVoices + kSink + kDrain) == as_written);
  CHECK(hash_of(kVoices + kToDrain + kSink + kToSink + kDrain) == as_written);
  CHECK(hash_of("\n<!-- two -->" + kVoices + "  " + kSink + kDrain + kToSink + kToDrain) == as_written);
  const std::string all = kVoices + kSink + kDrain;
  CHECK(hash_of(all + kToSink + kBothFromFirst) == hash_of(all + kBothFromFirst + kToSink));
}
