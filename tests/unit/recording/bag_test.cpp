// SPDX-License-Identifier: GPL-3.0-or-later
// Recordings of ROS 2 (bags) as recordings of Orca: topics are rows, messages are objects.
#include <catch2/catch.hpp>
#include <filesystem>
#include <optional>

#include "orca/idl/sensing.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/recording/objects/recorded_run.hpp"
#include "orca/recording/output.hpp"
#include "orca/recording/writer.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/generated/messages.hpp"
#include "orca/ros/message_type.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::recording;
using namespace orca::test;
namespace fs = std::filesystem;

namespace {

constexpr std::uint64_t kSecond = 1'000'000'000;

// Writes a bag as rosbag2 does: the profile "ros2", topics without "rt", no word of Orca.
class Bag {
 public:
  explicit Bag(const std::string& path) {
    Result<std::unique_ptr<Output>> file = open_file(path);
    REQUIRE(file);
    writer_.emplace(*std::move(file), "ros2", "a test");
  }

  template <class Message>
  std::uint16_t topic(const std::string& name) {
    const auto type = ros::standard_message_type(Reflection<Message>::name);
    REQUIRE(type);
    return writer_->add_channel(writer_->add_schema(type->name, "ros2msg", type->definition), name, "cdr",
                                {});
  }
  std::uint16_t foreign_topic(const std::string& name) {
    return writer_->add_channel(writer_->add_schema("teapots/msg/Teapot", "ros2msg", "bool full\n"), name,
                                "cdr", {});
  }
  template <class Message>
  void add(std::uint16_t channel, std::uint64_t seconds, const Message& message) {
    add_bytes(channel, seconds, ros::to_cdr(message));
  }
  void add_bytes(std::uint16_t channel, std::uint64_t seconds, const std::vector<std::byte>& bytes) {
    REQUIRE(writer_->write({channel, 0, seconds * kSecond, seconds * kSecond, bytes}).ok());
  }
  void close() { REQUIRE(writer_->close().ok()); }

 private:
  std::optional<Writer> writer_;
};

ros::sensor_msgs::LaserScan ros_scan_at(std::int32_t seconds) {
  return {{{seconds, 0}, "laser"}, -1.0F, 1.0F, 1.0F, 0.0F, 0.1F, 0.1F, 8.0F, {1.0F, 2.0F, 3.0F}, {}};
}

// A bag with a scan, odometry, the laser's place, and a topic that nobody here knows.
void write_bag(const std::string& path) {
  Bag bag(path);
  const std::uint16_t frames = bag.topic<ros::tf2_msgs::TFMessage>("/tf_static");
  const std::uint16_t scans = bag.topic<ros::sensor_msgs::LaserScan>("/scan");
  const std::uint16_t odometry = bag.topic<ros::nav_msgs::Odometry>("/odom");
  const std::uint16_t teapots = bag.foreign_topic("/teapot");
  bag.add(scans, 100, ros_scan_at(100));
  bag.add(frames, 100,
          ros::tf2_msgs::TFMessage{{{{{}, "base_link"}, "laser", {{0.1, 0.0, 0.3}, {0.0, 0.0, 0.0, 1.0}}}}});
  bag.add_bytes(teapots, 100, {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}, std::byte{1}});
  ros::nav_msgs::Odometry moved;
  moved.header.stamp.sec = 101;
  moved.pose.pose.position.x = 0.5;
  moved.pose.pose.orientation.w = 1.0;
  bag.add(odometry, 101, moved);
  bag.add(scans, 102, ros_scan_at(102));
  bag.close();
}

}  // namespace

TEST_CASE("topics of a bag are rows, and their messages objects, with sensors where /tf_static says",
          "[recording][bag]") {
  const TempFolder folder;
  write_bag(folder.file("bag.mcap"));
  const Result<ObjectReader> reader = ObjectReader::open(folder.file("bag.mcap"));
  REQUIRE(reader);
  CHECK_FALSE(reader->is_virtual());
  REQUIRE(reader->rows().size() == 2);
  CHECK(reader->rows().at("/scan").types.at("LaserRangeReadings") == 2);
  CHECK(reader->rows().at("/odom").types.at("Odometry") == 1);
  std::vector<ObjectRef> objects;
  REQUIRE(reader->objects({}, [&](const RecordedObject& one) { return objects.push_back(one.object), true; })
              .ok());
  REQUIRE(objects.size() == 3);
  const auto scan = object_cast<idl::LaserRangeReadings>(objects[0]);
  REQUIRE(scan);
  CHECK(scan->ranges() == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(scan->pose().position().x() == Approx(0.1));
  CHECK(scan->pose().position().z() == Approx(0.3));
  CHECK(objects[0].stamp() == TimePoint(from_seconds(100.0)));
  CHECK(object_cast<idl::Odometry>(objects[1])->x() == 0.5);
}

TEST_CASE("a bag's folder is its one file, unless it has others", "[recording][bag]") {
  const TempFolder folder;
  fs::create_directory(folder.file("drive"));
  const Result<ObjectReader> empty = ObjectReader::open(folder.file("drive"));
  REQUIRE_FALSE(empty);
  CHECK_THAT(empty.error().message, Catch::Matchers::Contains("has no file of a bag"));
  write_bag(folder.file("drive/drive_0.mcap"));
  CHECK(ObjectReader::open(folder.file("drive")));
  CHECK(RecordedRun::open(folder.file("drive")));
  write_bag(folder.file("drive/other.mcap"));
  const Result<ObjectReader> several = ObjectReader::open(folder.file("drive"));
  REQUIRE_FALSE(several);
  CHECK_THAT(several.error().message, Catch::Matchers::Contains("drive_0.mcap"));
}

TEST_CASE("a message that says nothing sensible is left out, and the reading goes on", "[recording][bag]") {
  const TempFolder folder;
  {
    Bag bag(folder.file("bag.mcap"));
    const std::uint16_t scans = bag.topic<ros::sensor_msgs::LaserScan>("/scan");
    bag.add(scans, 1, ros_scan_at(1));
    bag.add_bytes(scans, 2, {std::byte{0}, std::byte{1}, std::byte{0}, std::byte{0}, std::byte{1}});
    bag.add(scans, 3, ros_scan_at(3));
    bag.close();
  }
  const Result<ObjectReader> reader = ObjectReader::open(folder.file("bag.mcap"));
  REQUIRE(reader);
  int passed = 0;
  CHECK(reader->objects({}, [&](const RecordedObject& /*one*/) { return ++passed, true; }).ok());
  CHECK(passed == 2);
}
