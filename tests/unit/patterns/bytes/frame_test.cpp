// SPDX-License-Identifier: GPL-3.0-or-later
#include "frame.hpp"

#include <catch2/catch.hpp>

#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"

using namespace orca;
using namespace orca::bytes;
using Catch::Contains;

namespace {

std::vector<std::byte> bytes_of(FrameWriter frame) {
  const auto bytes = frame.bytes();
  return {bytes.begin(), bytes.end()};
}

std::span<const std::byte> after_length(const std::vector<std::byte>& frame) {
  return std::span(frame).subspan(sizeof(std::uint32_t));
}

FrameWriter command_frame() {
  FrameWriter frame(FrameKind::object, 7);
  frame.add(std::uint64_t{3});
  frame.add(std::string("who"));
  frame.add(ObjectRef(head(0.5, 2.0).seal()));
  return frame;
}

}  // namespace

TEST_CASE("a frame reads as it was written, its object too", "[patterns][bytes]") {
  const auto bytes = bytes_of(command_frame());
  FrameReader frame(after_length(bytes));
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

TEST_CASE("an object in a frame keeps its type, if that is or extends the type that is wanted",
          "[patterns][bytes]") {
  FrameWriter written(FrameKind::object, 7);
  auto door = make_object<idl::Door>();
  door->door_width().distance(0.9);
  written.add(ObjectRef(std::move(door).seal()));
  const auto bytes = bytes_of(std::move(written));
  for (const ObjectType* wanted : {&object_type<idl::GoalPoint>(), &object_type<idl::Door>()}) {
    FrameReader frame(after_length(bytes));
    const auto object = frame.read_object(*wanted);
    REQUIRE(object.has_value());
    CHECK(object_cast<idl::Door>(*object)->door_width().distance() == 0.9);
  }
  FrameReader frame(after_length(bytes));
  const auto object = frame.read_object(object_type<idl::MotionCommand>());
  REQUIRE_FALSE(object.has_value());
  CHECK(object.error().code == Code::data_loss);
  CHECK_THAT(object.error().text(), Contains("where a MotionCommand was expected"));
}

TEST_CASE("a frame that is cut short anywhere is an error and no object", "[patterns][bytes]") {
  const auto bytes = bytes_of(command_frame());
  for (std::size_t length = 0; length < after_length(bytes).size(); ++length) {
    INFO("after " << length << " bytes");
    FrameReader frame(after_length(bytes).first(length));
    (void)frame.read_number();
    (void)frame.read_text();
    const auto object = frame.read_object(object_type<idl::MotionCommand>());
    REQUIRE_FALSE(object.has_value());
    CHECK(object.error().code == Code::data_loss);
  }
}

TEST_CASE("fields that nobody expects are an error", "[patterns][bytes]") {
  FrameWriter written(FrameKind::taken, 1);
  written.add(std::uint64_t{2});
  written.add(std::uint64_t{3});
  const auto bytes = bytes_of(std::move(written));
  FrameReader frame(after_length(bytes));
  CHECK(frame.read_number() == 2);
  REQUIRE_FALSE(frame.status().ok());
  CHECK_THAT(frame.status().error().text(), Contains("8 bytes more than expected"));
}

TEST_CASE("frames are found in a stream of any portions", "[patterns][bytes]") {
  std::vector<std::byte> stream;
  for (std::uint64_t number = 1; number <= 5; ++number) {
    FrameWriter frame(FrameKind::detach, number);
    frame.add(std::string(number * 10, 'x'));
    const auto bytes = bytes_of(std::move(frame));
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  for (std::size_t portion = 1; portion <= stream.size(); ++portion) {
    FrameSplitter splitter;
    std::vector<std::uint64_t> numbers;
    for (std::size_t at = 0; at < stream.size(); at += portion) {
      splitter.append(std::span(stream).subspan(at, std::min(portion, stream.size() - at)));
      for (auto frame = splitter.next(); frame.value().has_value(); frame = splitter.next())
        numbers.push_back(FrameReader(**frame).number());
    }
    CHECK(numbers == std::vector<std::uint64_t>{1, 2, 3, 4, 5});
  }
}

TEST_CASE("a length that no frame has is an error", "[patterns][bytes]") {
  for (const std::uint32_t length : {0U, 8U, 0xffffffffU}) {
    FrameSplitter splitter;
    splitter.append(std::as_bytes(std::span(&length, 1)));
    const auto frame = splitter.next();
    REQUIRE_FALSE(frame.has_value());
    CHECK(frame.error().code == Code::data_loss);
  }
}
