// SPDX-License-Identifier: GPL-3.0-or-later
#include "outbox.hpp"

#include <catch2/catch.hpp>
#include <cstring>

using namespace orca::view;
using namespace std::chrono_literals;
using orca::supervisor::Tapped;

namespace {

std::shared_ptr<const Tapped> object_of(std::size_t size, std::uint64_t passed_ns = 0) {
  auto object = std::make_shared<Tapped>();
  object->object.resize(size);
  object->passed = passed_ns;
  return object;
}

template <class Number>
Number number_at(const std::string& bytes, std::size_t at) {
  Number number{};
  std::memcpy(&number, bytes.data() + at, sizeof number);
  return number;
}

constexpr Outbox::Moment kNow{100s};

}  // namespace

TEST_CASE("answers leave in their order, before objects", "[view]") {
  Outbox outbox;
  outbox.begin(1, 0ns);
  outbox.add_object(1, object_of(10));
  CHECK(outbox.add("first"));
  CHECK(outbox.add("second"));
  CHECK(outbox.take(kNow)->text == "first");
  CHECK(outbox.take(kNow)->text == "second");
  CHECK(outbox.take(kNow)->look == 1);
  CHECK_FALSE(outbox.take(kNow));
  CHECK(outbox.waiting_bytes() == 0);
}

TEST_CASE("an object's head says what it is, in 32 bytes", "[view]") {
  auto passed = std::make_shared<Tapped>();
  passed->passed = 2'500'000'000;
  passed->created = 2'250'000'000;
  passed->lost = 7;
  const std::string head = object_head({Frame::Kind::object, {}, passed, 11, 3});
  REQUIRE(head.size() == 32);
  CHECK(number_at<std::uint32_t>(head, 0) == 1);
  CHECK(number_at<std::uint32_t>(head, 4) == 11);
  CHECK(number_at<double>(head, 8) == 2.5);
  CHECK(number_at<double>(head, 16) == 2.25);
  CHECK(number_at<std::uint32_t>(head, 24) == 7);
  CHECK(number_at<std::uint32_t>(head, 28) == 3);
}

TEST_CASE("a look with a rate sends the newest object, no sooner than its interval", "[view]") {
  Outbox outbox;
  outbox.begin(1, 100ms);
  outbox.add_object(1, object_of(8, 1));
  CHECK(outbox.take(kNow));
  outbox.add_object(1, object_of(8, 2));
  outbox.add_object(1, object_of(8, 3));
  CHECK_FALSE(outbox.take(kNow + 99ms));
  CHECK(outbox.due() == kNow + 100ms);
  const auto frame = outbox.take(*outbox.due());
  REQUIRE(frame);
  CHECK(frame->passed->passed == 3);
  CHECK(frame->left_out == 1);
  CHECK(outbox.dropped() == 0);  // it was not wanted
}

TEST_CASE("a look without a rate sends all objects while the page takes them", "[view]") {
  Outbox outbox;
  outbox.begin(1, 0ns);
  for (std::uint64_t i = 0; i < Outbox::kMostObjects; ++i) outbox.add_object(1, object_of(8, i));
  for (std::uint64_t i = 0; i < Outbox::kMostObjects; ++i) CHECK(outbox.take(kNow)->passed->passed == i);
  CHECK(outbox.dropped() == 0);
}

TEST_CASE("of a page that stalls the oldest objects go, are counted, and memory stays bounded", "[view]") {
  Outbox outbox;
  outbox.begin(1, 0ns);
  outbox.begin(2, 10ms);
  std::size_t most = 0;
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    outbox.add_object(1, object_of(100'000, i));
    outbox.add_object(2, object_of(100'000, i));
    most = std::max(most, outbox.waiting_bytes());
  }
  CHECK(most <= Outbox::kMostBytes + 300'000);
  CHECK(outbox.dropped() > 9'900);
  std::uint64_t newest = 0;
  while (const auto frame = outbox.take(kNow + 1h)) newest = std::max(newest, frame->passed->passed);
  CHECK(newest == 9'999);
  CHECK(outbox.waiting_bytes() == 0);
}

TEST_CASE("many looks together keep within the bound, too", "[view]") {
  Outbox outbox;
  std::size_t most = 0;
  for (std::uint32_t look = 0; look < 100; ++look) outbox.begin(look, 10ms);
  for (std::uint32_t look = 0; look < 100; ++look) {
    outbox.add_object(look, object_of(1'000'000));
    most = std::max(most, outbox.waiting_bytes());
  }
  CHECK(most <= Outbox::kMostBytes + 1'000'000);
  CHECK(outbox.dropped() > 90);
}

TEST_CASE("a single object larger than the bound is sent all the same", "[view]") {
  Outbox outbox;
  outbox.begin(1, 0ns);
  outbox.add_object(1, object_of(Outbox::kMostBytes + 1));
  CHECK(outbox.take(kNow));
}

TEST_CASE("looks take turns", "[view]") {
  Outbox outbox;
  outbox.begin(1, 1ms);
  outbox.begin(2, 1ms);
  int ones = 0;
  int twos = 0;
  Outbox::Moment now = kNow;
  for (int i = 0; i < 200; ++i, now += 500us) {
    outbox.add_object(1, object_of(8));
    outbox.add_object(2, object_of(8));
    if (const auto frame = outbox.take(now)) ++(frame->look == 1 ? ones : twos);
  }
  CHECK(ones > 90);
  CHECK(twos > 90);
}

TEST_CASE("answers that a page does not take are refused at the bound", "[view]") {
  Outbox outbox;
  const std::string text(1 << 20, 'x');
  int taken = 0;
  while (taken < 100 && outbox.add(text)) ++taken;
  CHECK(taken == 8);
  CHECK(outbox.take(kNow));
  CHECK(outbox.add(text));
}

TEST_CASE("what is left of a look goes with it", "[view]") {
  Outbox outbox;
  outbox.begin(1, 0ns);
  outbox.add_object(1, object_of(1000));
  outbox.end(1);
  CHECK_FALSE(outbox.take(kNow));
  CHECK(outbox.waiting_bytes() == 0);
  outbox.add_object(1, object_of(1000));  // that was on its way
  CHECK_FALSE(outbox.take(kNow));
}
