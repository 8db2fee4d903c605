// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <utility>
#include <vector>

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>

#include "all_objects.hpp"
#include "random_object.hpp"
#include "reference/reference.hpp"
#include "serialized.hpp"

using orca::object_type;
using orca::test::Bytes;
using orca::test::random_object;
using orca::test::ReferenceOf;
using orca::test::serialized;

namespace {

// The classes that fastddsgen makes of the struct of an object: one, or the header's and the struct's.
template <class T>
struct Reference {
  using Type = typename ReferenceOf<T>::Type;

  static void serialize(const Type& object, eprosima::fastcdr::Cdr& cdr) { object.serialize(cdr); }
  static void deserialize(Type& object, eprosima::fastcdr::Cdr& cdr) { object.deserialize(cdr); }
};
template <class T>
struct Reference<orca::Travelling<T>> {
  using Type = std::pair<reference::idl::OrcaObject, typename ReferenceOf<T>::Type>;

  static void serialize(const Type& object, eprosima::fastcdr::Cdr& cdr) {
    object.first.serialize(cdr);
    object.second.serialize(cdr);
  }
  static void deserialize(Type& object, eprosima::fastcdr::Cdr& cdr) {
    object.first.deserialize(cdr);
    object.second.deserialize(cdr);
  }
};

eprosima::fastcdr::Cdr cdr_on(eprosima::fastcdr::FastBuffer& buffer) {
  return {buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS, eprosima::fastcdr::Cdr::DDS_CDR};
}

// What a DDS peer would send that has the given object.
template <class T>
Bytes serialized_by_fastcdr(const typename Reference<T>::Type& object) {
  std::vector<char> memory(100'000);  // Zeroed, because Fast CDR leaves padding as it finds it.
  eprosima::fastcdr::FastBuffer buffer(memory.data(), memory.size());
  eprosima::fastcdr::Cdr cdr = cdr_on(buffer);
  Reference<T>::serialize(object, cdr);
  Bytes bytes(cdr.getSerializedDataLength());
  std::memcpy(bytes.data(), memory.data(), bytes.size());
  return bytes;
}

// The same bytes after a DDS peer has read them and written what it has read. It throws if it cannot read them.
template <class T>
Bytes through_fastcdr(Bytes bytes) {
  eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(bytes.data()), bytes.size());
  eprosima::fastcdr::Cdr cdr = cdr_on(buffer);
  typename Reference<T>::Type object;
  Reference<T>::deserialize(object, cdr);
  CHECK(cdr.getSerializedDataLength() == bytes.size());
  return serialized_by_fastcdr<T>(object);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a serialized object is read back equal", "[idl][cdr]", orca::test::AllObjects) {
  const auto seed = GENERATE(range<std::uint64_t>(0, 50));
  const auto original = random_object<TestType>(seed);
  auto copy = random_object<TestType>(seed + 1000);  // Reading overwrites whatever was there.
  CHECK(object_type<TestType>().deserialize(serialized(original), &copy).ok());
  CHECK(copy == original);
}

TEMPLATE_LIST_TEST_CASE("the bytes are those that Fast CDR reads and writes", "[idl][cdr]",
                        orca::test::AllObjects) {
  const auto seed = GENERATE(range<std::uint64_t>(0, 50));
  const Bytes bytes = serialized(random_object<TestType>(seed));
  CHECK(through_fastcdr<TestType>(bytes) == bytes);
  CHECK(serialized(TestType()) == serialized_by_fastcdr<TestType>({}));
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
  reference::idl::Ask theirs;
  theirs.about(ask.about());
  CHECK(serialized(ask) == serialized_by_fastcdr<orca::idl::Ask>(theirs));
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
