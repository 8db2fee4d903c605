// SPDX-License-Identifier: GPL-3.0-or-later
#include "frames/frame.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>

#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"

using namespace orca;
using namespace orca::frames;
using Catch::Contains;

namespace {

std::vector<std::byte> bytes_of(const Frame& frame) {
  std::vector<std::byte> bytes;
  frame.append_to(bytes);
  return bytes;
}

Frame command_frame() {
  Frame frame(FrameKind::object, 7);
  frame.add(std::uint64_t{3});
  frame.add(std::string("who"));
  frame.add(ObjectRef(head(0.5, 2.0).seal()));
  return frame;
}

}  // namespace

TEST_CASE("a frame reads as it was written, its object too", "[patterns][frames]") {
  const auto bytes = bytes_of(command_frame());
  FrameReader frame(bytes);
  CHECK(frame.kind() == FrameKind::object);
  CHECK(frame.number() == 7);
  CHECK(frame.read_number() == 3);
  CHECK(frame.read_text() == "who");
  const auto object = frame.read_object(object_type<idl::MotionCommand>());
  REQUIRE(object.has_value());
  const auto command = object_cast<idl::MotionCommand>(*object);
  REQUIRE(command);
  CHECK(command->direction() == 0.5);
  CHECK(command->speed() == 2.0);
  CHECK(frame.status().ok());
}

TEST_CASE("instants of a sender whose clock is ahead are set back", "[patterns][frames]") {
  Frame written(FrameKind::object, 7);
  auto odometry = make_object<idl::Odometry>();
  odometry->creation_time().ns(9'000'000'000);
  odometry->stamp().ns(8'000'000'000);
  written.add(ObjectRef(std::move(odometry).seal()));
  const auto bytes = bytes_of(written);
  for (const Duration ahead : {0s, 3s, -2s}) {
    FrameReader frame(bytes, ahead);
    const auto object = frame.read_object(object_type<idl::Odometry>());
    REQUIRE(object.has_value());
    CHECK(to_time_point(object_cast<idl::Odometry>(*object)->stamp()) == TimePoint(8s - ahead));
    CHECK(to_time_point(object->header().creation_time()) == TimePoint(9s - ahead));
  }
}

TEST_CASE("an object in a frame keeps its type, if that is or extends the type that is wanted",
          "[patterns][frames]") {
  Frame written(FrameKind::object, 7);
  auto door = make_object<idl::Door>();
  door->door_width().distance(0.9);
  written.add(ObjectRef(std::move(door).seal()));
  const auto bytes = bytes_of(written);
  for (const ObjectType* wanted : {&object_type<idl::GoalPoint>(), &object_type<idl::Door>()}) {
    FrameReader frame(bytes);
    const auto object = frame.read_object(*wanted);
    REQUIRE(object.has_value());
    CHECK(object_cast<idl::Door>(*object)->door_width().distance() == 0.9);
  }
  FrameReader frame(bytes);
  const auto object = frame.read_object(object_type<idl::MotionCommand>());
  REQUIRE_FALSE(object.has_value());
  CHECK(object.error().code == Code::data_loss);
  CHECK_THAT(object.error().text(), Contains("where a MotionCommand was expected"));
}

TEST_CASE("a frame that is cut short anywhere is an error and no object", "[patterns][frames]") {
  const auto bytes = bytes_of(command_frame());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    INFO("after " << length << " bytes");
    const auto head = std::span(bytes).first(length);
    FrameReader frame(head);
    (void)frame.read_number();
    (void)frame.read_text();
    const auto object = frame.read_object(object_type<idl::MotionCommand>());
    REQUIRE_FALSE(object.has_value());
    CHECK(object.error().code == Code::data_loss);
  }
}

TEST_CASE("a text that is cut short is an error, also as the last field", "[patterns][frames]") {
  Frame written(FrameKind::taken, 1);
  written.add(std::string("who"));
  const auto bytes = bytes_of(written);
  for (const std::size_t missing : {std::size_t{1}, std::size_t{3}}) {
    const auto head = std::span(bytes).first(bytes.size() - missing);
    FrameReader frame(head);
    CHECK(frame.read_text().empty());
    REQUIRE_FALSE(frame.status().ok());
    CHECK(frame.status().error().code == Code::data_loss);
  }
}

TEST_CASE("fields that nobody expects are an error", "[patterns][frames]") {
  Frame written(FrameKind::taken, 1);
  written.add(std::uint64_t{2});
  written.add(std::uint64_t{3});
  const auto bytes = bytes_of(written);
  FrameReader frame(bytes);
  CHECK(frame.read_number() == 2);
  REQUIRE_FALSE(frame.status().ok());
  CHECK_THAT(frame.status().error().text(), Contains("8 bytes more than expected"));
}

TEST_CASE("a frame is written whole, or only counted, and never beyond its place", "[patterns][frames]") {
  const Frame frame = command_frame();
  const auto whole = bytes_of(frame);
  for (std::size_t room = 0; room <= whole.size() + 1; ++room) {
    INFO("room for " << room << " bytes");
    std::vector<std::byte> place(whole.size() + 8, std::byte{0x5a});
    CHECK(frame.write(std::span(place).first(room)) == whole.size());
    CHECK(std::all_of(place.begin() + static_cast<std::ptrdiff_t>(room), place.end(),
                      [](std::byte byte) { return byte == std::byte{0x5a}; }));
    if (room >= whole.size()) CHECK(std::equal(whole.begin(), whole.end(), place.begin()));
  }
}

TEST_CASE("a kind that no frame has is read as none", "[patterns][frames]") {
  for (const std::uint64_t kind : {0ULL, 13ULL, 257ULL, ~0ULL}) {
    std::vector<std::byte> bytes(kShortest);
    std::memcpy(bytes.data(), &kind, sizeof kind);
    CHECK(FrameReader(bytes).kind() == FrameKind{});
  }
}
