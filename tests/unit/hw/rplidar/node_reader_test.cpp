// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/hw/rplidar/node.hpp"
#include "rplidar_bytes.hpp"

using namespace orca::hw::rplidar;
using orca::RandomStream;

namespace {

using NodeBytes = std::vector<std::uint8_t>;
using Nodes = std::vector<Node>;

// A turn of a scanner with a node every 0.5 deg, and some noise in the angles.
Nodes turn_of_nodes(RandomStream& random) {
  Nodes nodes;
  for (int i = 0; i < 720; ++i)
    nodes.push_back({.begins_scan = i == 0,
                     .quality = static_cast<std::uint8_t>(random() % 64),
                     .angle = static_cast<std::uint16_t>(32 * i + static_cast<int>(random() % 8)),
                     .distance = static_cast<std::uint16_t>(random() % 65536)});
  return nodes;
}

void append_nodes(NodeBytes& stream, const Nodes& nodes) {
  for (const Node& node : nodes) {
    const auto bytes = encode_node(node);
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
}

NodeBytes bytes_of_nodes(const Nodes& nodes) {
  NodeBytes stream;
  append_nodes(stream, nodes);
  return stream;
}

struct NodeEar {
  void hear(std::span<const std::uint8_t> bytes) {
    reader.feed(bytes, [this](const Node& node) { nodes.push_back(node); });
  }
  NodeReader reader;
  Nodes nodes;
};

}  // namespace

TEST_CASE("nodes are read however they are cut, all but the last", "[hw][rplidar]") {
  RandomStream random(1, "test", "node reader");
  const Nodes nodes = turn_of_nodes(random);
  const NodeBytes stream = bytes_of_nodes(nodes);
  for (const std::size_t piece : {1, 2, 3, 7, 41, 4000}) {
    NodeEar ear;
    for (std::size_t at = 0; at < stream.size(); at += piece)
      ear.hear(std::span(stream).subspan(at, std::min(piece, stream.size() - at)));
    CHECK(ear.nodes == Nodes(nodes.begin(), nodes.end() - 1));
    CHECK(ear.reader.statistics() == orca::hw::framing::Statistics{719, 0, 0, 0});
  }
}

TEST_CASE("the first nodes are handed out when a row of them has come, each other with the next one",
          "[hw][rplidar]") {
  RandomStream random(2, "test", "node reader");
  const NodeBytes stream = bytes_of_nodes(turn_of_nodes(random));
  NodeEar ear;
  ear.hear(std::span(stream).first(39));
  CHECK(ear.nodes.empty());
  ear.hear(std::span(stream).subspan(39, 1));
  CHECK(ear.nodes.size() == 7);
  ear.hear(std::span(stream).subspan(40, 4));
  CHECK(ear.nodes.size() == 7);
  ear.hear(std::span(stream).subspan(44, 1));
  CHECK(ear.nodes.size() == 8);
}

TEST_CASE("bytes before the nodes are skipped, and the first node with them", "[hw][rplidar]") {
  RandomStream random(3, "test", "node reader");
  const Nodes nodes = turn_of_nodes(random);
  for (std::size_t garbage = 1; garbage < 50; ++garbage) {
    NodeBytes stream(garbage, 0xFF);
    append_nodes(stream, nodes);
    NodeEar ear;
    ear.hear(stream);
    CHECK(ear.nodes == Nodes(nodes.begin() + 1, nodes.end() - 1));
    CHECK(ear.reader.statistics() == orca::hw::framing::Statistics{718, 0, garbage + 5, 1});
  }
}

TEST_CASE("a stream that begins within a node is read from the second whole one", "[hw][rplidar]") {
  // Equal distances, the hardest case, because all bytes but those of the angle repeat.
  for (const int distance : {0, 1, 2, 257, 4001, 13107, 65535}) {
    Nodes nodes;
    for (int i = 0; i < 720; ++i)
      nodes.push_back({.quality = 10,
                       .angle = static_cast<std::uint16_t>(32 * i),
                       .distance = static_cast<std::uint16_t>(distance)});
    const NodeBytes stream = bytes_of_nodes(nodes);
    for (std::size_t missing = 1; missing < 5; ++missing) {
      NodeEar ear;
      ear.hear(std::span(stream).subspan(missing));
      CHECK(ear.nodes == Nodes(nodes.begin() + 2, nodes.end() - 1));
    }
  }
}

TEST_CASE("a row that fits at a wrong place is not taken for nodes", "[hw][rplidar]") {
  struct Trap {
    int first_angle;
    int first_distance;
    int distance_step;
    std::size_t missing;
  };
  // Read from the second byte on, each of the first 8 nodes would begin a scan, its angle being made of the distance.
  const Trap all_begin{128, 0x0A01, 1, 1};
  // Read from the third byte on, the first 8 nodes would stand at one angle, which is made of the distance.
  const Trap all_equal{256, 0x0FA1, 0, 2};
  for (const Trap& trap : {all_begin, all_equal}) {
    Nodes nodes;
    for (int i = 0; i < 100; ++i)
      nodes.push_back({.quality = 10,
                       .angle = static_cast<std::uint16_t>(trap.first_angle + 16 * i),
                       .distance = static_cast<std::uint16_t>(trap.first_distance + trap.distance_step * i)});
    const NodeBytes stream = bytes_of_nodes(nodes);
    NodeEar ear;
    ear.hear(std::span(stream).subspan(trap.missing));
    CHECK(ear.nodes == Nodes(nodes.begin() + 2, nodes.end() - 1));
  }
}

namespace {

// What a reader has made of a damaged stream.
struct Damage {
  std::size_t lost = 0;      // good nodes that were not read
  std::size_t invented = 0;  // nodes that were not sent
};

Damage damage(const Nodes& sent, const NodeBytes& stream) {
  NodeEar ear;
  ear.hear(stream);
  Damage damage{.lost = sent.size()};
  for (const Node& node : ear.nodes) {
    const std::size_t number = node.angle / 32U;
    const bool is_good = number < sent.size() && sent[number] == node;
    damage.lost -= is_good ? 1 : 0;
    damage.invented += is_good ? 0 : 1;
  }
  return damage;
}

}  // namespace

TEST_CASE("missing bytes cost few nodes, and hardly ever give a wrong one", "[hw][rplidar]") {
  RandomStream random(4, "test", "node reader");
  Damage all;
  for (int round = 0; round < 300; ++round) {
    const Nodes nodes = turn_of_nodes(random);
    NodeBytes stream = bytes_of_nodes(nodes);
    const auto at = static_cast<std::ptrdiff_t>(200 + random() % 3000);
    stream.erase(stream.begin() + at, stream.begin() + at + 1 + static_cast<std::ptrdiff_t>(random() % 4));
    const Damage here = damage(nodes, stream);
    // One or two nodes that bytes are missing of, those beside them, and the last one of the stream.
    CHECK(here.lost <= 5);
    all.lost += here.lost;
    all.invented += here.invented;
  }
  CHECK(all.lost >= 900);
  CHECK(all.invented <= 6);  // of 300 breaks; two bits and the angle do not show all of them
}

TEST_CASE("a wrong byte costs at most the node that it is in and its neighbours", "[hw][rplidar]") {
  RandomStream random(5, "test", "node reader");
  for (int round = 0; round < 300; ++round) {
    const Nodes nodes = turn_of_nodes(random);
    NodeBytes stream = bytes_of_nodes(nodes);
    stream[40 + random() % (stream.size() - 100)] ^= static_cast<std::uint8_t>(1 + random() % 255);
    const Damage here = damage(nodes, stream);
    CHECK(here.lost <= 4);      // and the last one of the stream
    CHECK(here.invented <= 1);  // a wrong distance cannot be seen
  }
}

TEST_CASE("a gap of whole nodes costs those beside it", "[hw][rplidar]") {
  RandomStream random(6, "test", "node reader");
  const Nodes nodes = turn_of_nodes(random);
  Nodes sent(nodes.begin(), nodes.begin() + 100);
  sent.insert(sent.end(), nodes.begin() + 300, nodes.end());
  NodeEar ear;
  ear.hear(bytes_of_nodes(sent));
  sent.pop_back();
  sent.erase(sent.begin() + 99, sent.begin() + 101);
  CHECK(ear.nodes == sent);
}

TEST_CASE("random bytes give next to no nodes", "[hw][rplidar]") {
  RandomStream random(7, "test", "node reader");
  NodeBytes noise(1'000'000);
  for (auto& byte : noise) byte = static_cast<std::uint8_t>(random() & 0xFF);
  NodeEar ear;
  ear.hear(noise);
  CHECK(ear.nodes.size() <= 8);
  CHECK(ear.reader.statistics().skipped_bytes >= 999'900);
}
