// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include "all_objects.hpp"
#include "random_object.hpp"
#include "serialized.hpp"

using orca::object_type;
using orca::test::Bytes;
using orca::test::random_object;
using orca::test::serialized;

namespace {

template <class T>
void write(const T& object, eprosima::fastcdr::Cdr& cdr) {
  object.serialize(cdr);
}
template <class T>
void write(const orca::Travelling<T>& object, eprosima::fastcdr::Cdr& cdr) {
  object.orca::idl::OrcaObject::serialize(cdr);
  object.T::serialize(cdr);
}

// The same object written by the code that fastddsgen generated: what a DDS peer would send.
template <class T>
Bytes serialized_by_fastcdr(const T& object) {
  std::vector<char> memory(100'000);  // Zeroed, because Fast CDR leaves padding as it finds it.
  eprosima::fastcdr::FastBuffer buffer(memory.data(), memory.size());
  eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                             eprosima::fastcdr::Cdr::DDS_CDR);
  write(object, cdr);
  Bytes bytes(cdr.getSerializedDataLength());
  std::memcpy(bytes.data(), memory.data(), bytes.size());
  return bytes;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a serialized object is read back equal", "[idl][cdr]", orca::test::AllObjects) {
  const auto seed = GENERATE(range<std::uint64_t>(0, 50));
  const auto original = random_object<TestType>(seed);
  auto copy = random_object<TestType>(seed + 1000);  // Reading overwrites whatever was there.
  CHECK(object_type<TestType>().deserialize(serialized(original), &copy).ok());
  CHECK(copy == original);
}

TEMPLATE_LIST_TEST_CASE("the bytes are those that Fast CDR writes", "[idl][cdr]", orca::test::AllObjects) {
  const auto seed = GENERATE(range<std::uint64_t>(0, 50));
  const auto object = random_object<TestType>(seed);
  CHECK(serialized(object) == serialized_by_fastcdr(object));
  CHECK(serialized(TestType()) == serialized_by_fastcdr(TestType()));
}

TEMPLATE_LIST_TEST_CASE("an object is written whole or only counted, and never beyond its place",
                        "[idl][cdr]", orca::test::AllObjects) {
  const auto object = random_object<TestType>(7);
  const Bytes whole = serialized(object);
  for (std::size_t room = 0; room <= whole.size() + 1; ++room) {
    Bytes place(whole.size() + 8, std::byte{0x5a});
    REQUIRE(object_type<TestType>().write(&object, std::span(place).first(room)) == whole.size());
    const auto end = place.begin() + static_cast<std::ptrdiff_t>(room);
    REQUIRE(std::all_of(end, place.end(), [](std::byte byte) { return byte == std::byte{0x5a}; }));
    if (room >= whole.size()) REQUIRE(std::equal(whole.begin(), whole.end(), place.begin()));
  }
}

TEST_CASE("serialize appends, and aligns from where it began", "[idl][cdr]") {
  const auto command = random_object<orca::idl::MotionCommand>(1);
  Bytes bytes(3, std::byte{42});
  object_type<orca::idl::MotionCommand>().serialize(&command, bytes);
  CHECK(Bytes(bytes.begin() + 3, bytes.end()) == serialized(command));
  CHECK(bytes[2] == std::byte{42});
}

TEST_CASE("a text ends at its first zero, as in Fast CDR", "[idl][cdr]") {
  orca::idl::Ask ask;
  ask.about(std::string("sonar\0hidden", 12));
  CHECK(serialized(ask) == serialized_by_fastcdr(ask));
  orca::idl::Ask copy;
  REQUIRE(object_type<orca::idl::Ask>().deserialize(serialized(ask), &copy).ok());
  CHECK(copy.about() == "sonar");
}

TEST_CASE("padding of up to three bytes may follow the last field", "[idl][cdr]") {
  const auto ask = random_object<orca::idl::Ask>(3);
  const std::size_t padding = GENERATE(0, 1, 2, 3, 4);
  Bytes bytes = serialized(ask);
  bytes.resize(bytes.size() + padding);
  orca::idl::Ask copy;
  CHECK(object_type<orca::idl::Ask>().deserialize(bytes, &copy).ok() == (padding <= 3));
}
