// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <random>

#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/recording/objects/ring_writer.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::recording;
using namespace orca::test;

namespace {

constexpr double kNoon = 1.8e9;  // [s since 1970]

TimePoint after_noon(double seconds) { return TimePoint(from_seconds(kNoon) + from_seconds(seconds)); }

ObjectRef small_object() {
  Loan<idl::Odometry> odometry = make_object<idl::Odometry>();
  return std::move(odometry).seal();
}

// An object of noise, which nothing makes smaller.
ObjectRef large_object(std::size_t size) {
  static std::mt19937 noise(1);
  Loan<idl::Image> image = make_object<idl::Image>();
  std::vector<std::uint8_t> data(size);
  for (std::uint8_t& byte : data) byte = static_cast<std::uint8_t>(noise());
  image->data(std::move(data));
  return std::move(image).seal();
}

std::uint64_t size_of(const std::string& folder) {
  std::uint64_t sum = 0;
  for (const RingFile& file : ring_files(folder)) sum += file.size;
  return sum;
}

std::string dropped_in(const RingFile& file) {
  return fact(facts_of(*Reader::open(file.path.string())), "dropped");
}

}  // namespace

TEST_CASE(
    "a ring takes no more than its room: the oldest large objects go and are counted, the small ones stay",
    "[recording][ring]") {
  const TempFolder folder;
  const std::string ring = folder.file("ring");
  RingWriter writer(ring, RingWriter::kLeast);
  REQUIRE(writer.begin({"test", false, {"a.small", "b.large"}, {}}).ok());
  REQUIRE(writer.attach_graph("<graph/>").ok());
  constexpr int kCount = 200;
  for (int i = 0; i < kCount; ++i) {
    REQUIRE(writer.add("a.small", small_object(), after_noon(i)).ok());
    REQUIRE(writer.add("b.large", large_object(100'000), after_noon(i)).ok());
    REQUIRE(writer.flush().ok());
  }
  REQUIRE(writer.close({}, {}).ok());
  CHECK(size_of(ring) < RingWriter::kLeast);
  CHECK(size_of(ring) > RingWriter::kLeast / 4);
  int small = 0;
  std::uint64_t large = 0;
  double first_large = kCount;
  for (const RingFile& file : ring_files(ring)) {
    const Result<ObjectReader> reader = ObjectReader::open(file.path.string());
    REQUIRE(reader);
    REQUIRE(reader
                ->objects({},
                          [&](const RecordedObject& one) {
                            if (one.row == "a.small") {
                              CHECK(one.passed == after_noon(small++));
                            } else {
                              first_large = std::min(first_large, to_seconds(one.passed - after_noon(0)));
                              ++large;
                            }
                            return true;
                          })
                .ok());
  }
  CHECK(small == kCount);
  CHECK(first_large == Approx(kCount - static_cast<double>(large)));  // those that are left are the newest
  const RingFile last = ring_files(ring).back();
  REQUIRE(last.row == "rest");
  CHECK(dropped_in(last) == std::to_string(3 * (kCount - large)));  // each with its twin and a frame
}

TEST_CASE("a ring goes on from what earlier runs have left, and never takes away what is not its own",
          "[recording][ring]") {
  const TempFolder folder;
  std::ofstream(folder.file("notes.mcap")) << "mine";
  std::ofstream(folder.file("000000-small-20270115T080000Z.mcap"));  // left when the disk was full
  for (int run = 0; run < 3; ++run) {
    RingWriter writer(folder.path().string(), RingWriter::kLeast);
    REQUIRE(writer.begin({"test", false, {"a.small"}, {}}).ok());
    REQUIRE(writer.add("a.small", small_object(), after_noon(run)).ok());
  }
  const std::vector<RingFile> files = ring_files(folder.path());
  REQUIRE(files.size() == 3);
  CHECK(files[2].number == 3);
  CHECK(files[2].begun == after_noon(2));
  CHECK(std::filesystem::exists(folder.file("notes.mcap")));
}

TEST_CASE("files that are two weeks old go when the next one begins; a clock that was set back takes nothing",
          "[recording][ring]") {
  const TempFolder folder;
  const double day = 86400.0;
  const auto run_at = [&](double seconds) {
    RingWriter writer(folder.path().string(), RingWriter::kLeast);
    REQUIRE(writer.begin({"test", false, {"a.small"}, {}}).ok());
    REQUIRE(writer.add("a.small", small_object(), after_noon(seconds)).ok());
  };
  for (const double days : {0.0, 1.0, 2.0}) run_at(days * day);
  run_at(-100 * day);
  CHECK(ring_files(folder.path()).size() == 4);
  run_at(15.5 * day);  // the first one ended when the second began, 14.5 days ago
  const std::vector<RingFile> files = ring_files(folder.path());
  REQUIRE(files.size() == 4);
  CHECK(files.front().begun == after_noon(day));
  CHECK(dropped_in(files.back()) == "3");  // odometry, its twin and a frame
}
