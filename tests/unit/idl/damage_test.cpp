// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <memory>
#include <span>

#include "all_objects.hpp"
#include "random_object.hpp"
#include "serialized.hpp"

using orca::Code;
using orca::object_type;
using orca::Status;
using orca::test::Bytes;
using orca::test::random_object;
using orca::test::serialized;

namespace {

template <class T>
Status read(const Bytes& bytes, T& object) {
  // A copy of exactly that size, so that the address sanitizer sees a read beyond its end.
  const auto exact = std::make_unique<std::byte[]>(bytes.size());
  std::ranges::copy(bytes, exact.get());
  return object_type<T>().deserialize({exact.get(), bytes.size()}, &object);
}

// Returns whether the object could have been sent: it survives a round trip.
template <class T>
bool is_valid(const T& object) {
  const Bytes bytes = serialized(object);
  T copy;
  return read(bytes, copy).ok() && serialized(copy) == bytes;
}

Bytes ask_with_text(std::uint32_t length, std::string_view text) {
  Bytes bytes = serialized(orca::idl::Ask());
  bytes.resize(bytes.size() - 5);  // An empty text: its length, 1, and a zero.
  const auto tail = std::as_bytes(std::span(&length, 1));
  bytes.insert(bytes.end(), tail.begin(), tail.end());
  const auto letters = std::as_bytes(std::span(text));
  bytes.insert(bytes.end(), letters.begin(), letters.end());
  return bytes;
}

}  // namespace

TEMPLATE_LIST_TEST_CASE("a payload cut short anywhere is data loss", "[idl][cdr]", orca::test::AllObjects) {
  const Bytes whole = serialized(random_object<TestType>(11));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    TestType object;
    const Status status =
        read(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)), object);
    REQUIRE_FALSE(status.ok());
    REQUIRE(status.error().code == Code::data_loss);
    REQUIRE(is_valid(object));
  }
}

TEMPLATE_LIST_TEST_CASE("a flipped bit is reported or leaves a valid object", "[idl][cdr]",
                        orca::test::AllObjects) {
  const Bytes whole = serialized(random_object<TestType>(12));
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    Bytes damaged = whole;
    damaged[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    TestType object;
    const Status status = read(damaged, object);
    const bool reported = !status.ok() && status.error().code == Code::data_loss;
    REQUIRE((status.ok() || reported));
    REQUIRE(is_valid(object));
  }
}

TEST_CASE("the error names the field and what is wrong with it", "[idl][cdr]") {
  orca::idl::Ask ask;
  CHECK(read(ask_with_text(9, "ab"), ask).error().text() ==
        "Ask.about: a length of 9 does not fit into the 2 bytes that follow");
  CHECK(read(ask_with_text(2, "ab"), ask).error().text() ==
        "Ask.about: a text of 2 bytes does not end with its only zero");
  CHECK(read(Bytes(3), ask).error().text() ==
        "Ask.creation_time.ns: the payload ends after 3 bytes, but 8 are needed");
  Bytes longer = serialized(orca::idl::Ask());
  longer.resize(longer.size() + 4);
  CHECK(read(longer, ask).error().text() ==
        "Ask: 4 bytes follow the last field; is the sender's type newer?");
}

TEST_CASE("an enumerator or boolean that does not exist is refused", "[idl][cdr]") {
  Bytes bytes = serialized(orca::idl::MotionCommand());
  // After the header: creation_time 8, origin 8, origin_port 8, seq 8, mission 8, cause 8 + 8 + 8.
  bytes[64] = std::byte{3};
  orca::idl::MotionCommand command;
  CHECK(read(bytes, command).error().text() ==
        "MotionCommand.kind: found 3 for a MotionKind, expected 0 to 2");

  orca::idl::GoalPoint goal;
  Bytes goal_bytes = serialized(goal);
  goal_bytes.back() = std::byte{2};
  CHECK(read(goal_bytes, goal).error().text() == "GoalPoint.via: found 2 for a boolean, expected 0 or 1");
}

TEST_CASE("a damaged length cannot make the reader allocate more than the payload can fill", "[idl][cdr]") {
  Bytes bytes = serialized(orca::idl::ClientList());
  const std::uint32_t huge = 0xffffffff;
  std::memcpy(bytes.data() + bytes.size() - 4, &huge, 4);
  orca::idl::ClientList list;
  CHECK(read(bytes, list).error().text() ==
        "ClientList.clients: a length of 4294967295 does not fit into the 0 bytes that follow");
  CHECK(list.clients().capacity() == 0);
}
