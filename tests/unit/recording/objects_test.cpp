// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "memory_output.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/recording/objects/object_writer.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::recording;
using namespace orca::test;

namespace {

ObjectRef odometry_of(std::uint64_t seq, double x) {
  Loan<idl::Odometry> odometry = make_object<idl::Odometry>();
  odometry->origin("Dewey/base");
  odometry->seq(seq);
  odometry->x(x);
  odometry->stamp(to_time_value(TimePoint(from_seconds(0.1 * static_cast<double>(seq)))));
  return std::move(odometry).seal();
}

TimePoint at(double seconds) { return TimePoint(from_seconds(seconds)); }

std::vector<std::byte> bytes_of_object(const ObjectRef& object) {
  std::vector<std::byte> bytes;
  object.type().serialize(object.get(), bytes);
  return bytes;
}

}  // namespace

TEST_CASE("objects of every type come back from a recording as they were, with their ports and times",
          "[recording][objects]") {
  const TempFolder folder;
  const std::string path = folder.file("run.mcap");
  std::vector<ObjectRef> written;
  {
    Result<std::unique_ptr<Output>> file = open_file(path);
    REQUIRE(file);
    ObjectWriter writer(*std::move(file));
    REQUIRE(writer.begin({"test", true, {"x.out"}, {{"seed", "3"}}}).ok());
    for (const ObjectType* type : object_types()) {
      ObjectLoan object = make_object(*type);
      object.header().seq(written.size() + 1);
      written.push_back(std::move(object).seal());
      REQUIRE(writer.add("x.out", written.back(), at(0.01 * static_cast<double>(written.size()))).ok());
    }
    REQUIRE(writer.close({{"x.out", 2}}, {{"trace-hash", "0123"}}).ok());
  }
  const Result<ObjectReader> reader = ObjectReader::open(path);
  REQUIRE(reader);
  CHECK(reader->is_virtual());
  CHECK(reader->facts().at("seed") == "3");
  CHECK(reader->facts().at("trace-hash") == "0123");
  CHECK(reader->facts().at("lost.x.out") == "2");
  CHECK(reader->rows().at("x.out").types.size() == written.size());
  std::size_t count = 0;
  REQUIRE(reader
              ->objects({},
                        [&](const RecordedObject& one) {
                          CHECK(one.row == "x.out");
                          CHECK(&one.object.type() == &written[count].type());
                          CHECK(bytes_of_object(one.object) == bytes_of_object(written[count]));
                          CHECK(one.passed == at(0.01 * static_cast<double>(++count)));
                          return true;
                        })
              .ok());
  CHECK(count == written.size());
  CHECK(check(path)->findings.empty());
}

TEST_CASE("a record of what was recorded is the same file", "[recording][objects]") {
  Memory first;
  Memory second;
  for (Memory* const memory : {&first, &second}) {
    ObjectWriter writer(to(*memory));
    REQUIRE(writer.begin({"test", true, {}, {}}).ok());
    for (std::uint64_t i = 1; i < 50; ++i)
      REQUIRE(writer.add("base.OdometryPush", odometry_of(i, 0.5), at(0.1 * static_cast<double>(i))).ok());
    REQUIRE(writer.close({}, {}).ok());
  }
  CHECK(first.bytes == second.bytes);
}

TEST_CASE("what viewers of ROS 2 know is written a second time as they know it, with the frames",
          "[recording][objects]") {
  Memory memory;
  ObjectWriter writer(to(memory));
  REQUIRE(writer.add("Dewey/base.OdometryPush", odometry_of(1, 0.5), at(0.1)).ok());
  REQUIRE(
      writer.add(kLogRow, log_record(log::Level::warning, "base", "the wheels slip", at(0.2)), at(0.2)).ok());
  REQUIRE(writer.close({}, {}).ok());
  const Result<Reader> reader = Reader::of(memory.bytes);
  std::map<std::string, std::string> types;
  for (const auto& [id, channel] : reader->channels())
    types[channel.topic] = reader->schemas().at(channel.schema).name;
  CHECK(types == std::map<std::string, std::string>{{"/Dewey/base/OdometryPush", "orca/msg/Odometry"},
                                                    {"/ros/Dewey/base/OdometryPush", "nav_msgs/msg/Odometry"},
                                                    {"/tf", "tf2_msgs/msg/TFMessage"},
                                                    {"/log", "orca/msg/LogRecord"},
                                                    {"/rosout", "rcl_interfaces/msg/Log"}});
  CHECK(reader->statistics().messages == 5);
}

TEST_CASE("a recording with a type that is unknown here, or that had other fields, is refused with its name",
          "[recording][objects]") {
  const TempFolder folder;
  const std::string path = folder.file("run.mcap");
  const auto [type, layout, expected] = GENERATE(table<std::string, std::string, std::string>(
      {{"Teapot", "0", "objects of the type Teapot of x.out are not known here"},
       {"Odometry", "12",
        "objects of the type Odometry of x.out had other fields when they were recorded"}}));
  Writer writer(*open_file(path), "", "orca");
  writer.add_channel(0, "/x/out", "cdr",
                     {{"orca.port", "x.out"}, {"orca.type", type}, {"orca.layout", layout}});
  REQUIRE(writer.close().ok());
  const Result<ObjectReader> reader = ObjectReader::open(path);
  REQUIRE_FALSE(reader);
  CHECK_THAT(reader.error().text(), Catch::Matchers::StartsWith(path + ": " + expected));
}
