// SPDX-License-Identifier: GPL-3.0-or-later
// Bags of ROS 2 in SQLite, and bags of several files.
#include "database_bag.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "orca/idl/sensing.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/recording/objects/recorded_run.hpp"
#include "orca/recording/reader.hpp"
#include "orca/ros/generated/messages.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::recording;
using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

constexpr std::int64_t kOneSecond = 1'000'000'000;
constexpr std::int64_t kBegin = 1'700'000'000 * kOneSecond;

ros::sensor_msgs::LaserScan ros_scan(std::int64_t seconds) {
  return {{{static_cast<std::int32_t>(seconds), 0}, "laser"},
          -1.0F,
          1.0F,
          1.0F,
          0.0F,
          0.1F,
          0.1F,
          8.0F,
          {1.0F, 2.0F, 3.0F},
          {}};
}

ros::nav_msgs::Odometry ros_odometry(std::int64_t seconds, double x) {
  ros::nav_msgs::Odometry moved;
  moved.header.stamp.sec = static_cast<std::int32_t>(seconds);
  moved.pose.pose.position.x = x;
  moved.pose.pose.orientation.w = 1.0;
  return moved;
}

const ros::tf2_msgs::TFMessage kMount{
    {{{{}, "base_link"}, "laser", {{0.1, 0.0, 0.3}, {0.0, 0.0, 0.0, 1.0}}}}};

// Writes scans at these seconds, odometry half a second later each, the laser's place and what nobody here knows.
void write_bag(const std::string& path, const std::vector<int>& seconds, int version = 4) {
  DatabaseBag bag(path, version);
  bag.topic("/points", "sensor_msgs/msg/PointCloud2");
  bag.add_bytes("/points", kBegin, std::vector<std::byte>(20));
  for (const int second : seconds) {
    bag.add("/scan", kBegin + second * kOneSecond, ros_scan(1'700'000'000 + second));
    bag.add("/odom", kBegin + second * kOneSecond + kOneSecond / 2,
            ros_odometry(1'700'000'000 + second, second));
  }
  bag.add("/tf_static", kBegin, kMount);
}

struct Taken {
  std::string row;
  ObjectRef object;
  TimePoint passed;
};

std::vector<Taken> objects_of(const std::string& path) {
  const Result<ObjectReader> reader = ObjectReader::open(path);
  INFO((reader ? "" : reader.error().text()));
  REQUIRE(reader);
  std::vector<Taken> all;
  const Status read = reader->objects({}, [&](const RecordedObject& one) {
    all.push_back({std::string(one.row), one.object, one.passed});
    return true;
  });
  INFO((read.ok() ? "" : read.error().text()));
  CHECK(read.ok());
  return all;
}

Error refusal_of(const std::string& path) {
  const Result<Reader> reader = Reader::open(path);
  REQUIRE_FALSE(reader);
  return reader.error();
}

}  // namespace

TEST_CASE("a bag in SQLite has the topics and objects that one in MCAP has", "[recording][bag]") {
  const int version = GENERATE(2, 3, 4);
  const TempFolder folder;
  write_bag(folder.file("drive.db3"), {1, 2, 3}, version);
  const Result<ObjectReader> reader = ObjectReader::open(folder.file("drive.db3"));
  REQUIRE(reader);
  CHECK(reader->is_bag());
  CHECK(reader->rows().size() == 2);
  CHECK(reader->rows().at("/scan").types.at("LaserRangeReadings") == 3);
  CHECK(reader->others().at("/points") == "sensor_msgs/msg/PointCloud2");
  CHECK(reader->file().statistics().messages == 8);
  CHECK_THAT(reader->file().library(), Contains(version == 2 ? "SQLite" : "jazzy"));
  const std::vector<Taken> objects = objects_of(folder.file("drive.db3"));
  REQUIRE(objects.size() == 6);
  const auto scan = object_cast<idl::LaserRangeReadings>(objects[0].object);
  REQUIRE(scan);
  CHECK(scan->ranges() == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(scan->pose().position().z() == Approx(0.3));
  CHECK(object_cast<idl::Odometry>(objects[5].object)->x() == 3.0);
}

TEST_CASE(
    "messages of a bag in SQLite come in the order of time, whatever the order in the file, and nothing is "
    "written",
    "[recording][bag]") {
  const TempFolder folder;
  const std::string path = folder.file("drive.db3");
  write_bag(path, {3, 1, 2});
  fs::permissions(folder.path(), fs::perms::owner_read | fs::perms::owner_exec);
  const auto before = fs::last_write_time(path);
  const std::vector<Taken> objects = objects_of(path);
  CHECK(std::ranges::is_sorted(objects, {}, &Taken::passed));
  CHECK(objects.size() == 6);
  CHECK(fs::last_write_time(path) == before);
  CHECK(std::distance(fs::directory_iterator(folder.path()), {}) == 1);
  const Result<Examination> examined = check(path);
  REQUIRE(examined);
  CHECK(examined->findings.empty());
  REQUIRE(examined->remarks.size() == 1);
  CHECK_THAT(examined->remarks.front(), Contains("2 messages are earlier than the one"));
  fs::permissions(folder.path(), fs::perms::owner_all);
}

TEST_CASE("the files of one bag are one recording, in the order of time", "[recording][bag]") {
  const TempFolder folder;
  fs::create_directory(folder.file("drive"));
  CHECK(refusal_of(folder.file("drive")).code == Code::not_found);
  // The last scan of the first file is later than the first one of the next.
  write_bag(folder.file("drive/drive_0.db3"), {1, 2, 4});
  write_bag(folder.file("drive/drive_1.db3"), {3, 5});
  const std::vector<Taken> objects = objects_of(folder.file("drive"));
  CHECK(objects.size() == 10);
  CHECK(std::ranges::is_sorted(objects, {}, &Taken::passed));
  const Result<Reader> reader = Reader::open(folder.file("drive"));
  REQUIRE(reader);
  CHECK(reader->channels().size() == 4);
  CHECK(reader->statistics().messages == 14);
  CHECK(check(folder.file("drive"))->statistics.messages == 14);

  write_bag(folder.file("drive/drive_3.db3"), {6});
  CHECK_THAT(refusal_of(folder.file("drive")).message, Contains("number 2 is missing"));
  write_bag(folder.file("drive/other.db3"), {6});
  CHECK_THAT(refusal_of(folder.file("drive")).message, Contains("several recordings; name one of them"));
}

TEST_CASE("a bag whose recorder was interrupted is refused with what to do", "[recording][bag][fault]") {
  const TempFolder folder;
  const std::string path = folder.file("drive.db3");
  write_bag(path, {1, 2});
  const std::string ending = GENERATE("-wal", "-journal");
  std::ofstream(path + ending) << "";
  CHECK(Reader::open(path));  // an empty one is that of a finished recorder
  std::ofstream(path + ending) << "the rest";
  const Error refused = refusal_of(path);
  CHECK(refused.code == Code::failed_precondition);
  CHECK_THAT(refused.message, Contains("is still in " + path + ending) && Contains("PRAGMA journal_mode"));
}

TEST_CASE("a bag whose recorder wrote with a WAL is read once SQLite has put that in its place",
          "[recording][bag]") {
  const TempFolder folder;
  const std::string path = folder.file("drive.db3");
  {
    DatabaseBag bag(path);
    bag.run("PRAGMA journal_mode=WAL");
    bag.add("/scan", kBegin, ros_scan(1'700'000'000));
  }
  CHECK(objects_of(path).size() == 1);
}

TEST_CASE("a damaged bag gives what is whole before the damage, and says how to save the rest",
          "[recording][bag][fault]") {
  const TempFolder folder;
  const std::string path = folder.file("drive.db3");
  std::vector<int> seconds(400);
  for (std::size_t i = 0; i < seconds.size(); ++i) seconds[i] = static_cast<int>(i);
  write_bag(path, seconds);
  const std::string whole = read_text(path);
  std::string damaged = whole;
  constexpr std::size_t kPage = 4096;
  std::fill_n(damaged.begin() + static_cast<std::ptrdiff_t>(damaged.size() / (2 * kPage) * kPage), 8 * kPage,
              '\xFF');
  std::ofstream(path, std::ios::binary | std::ios::trunc) << damaged;
  const Result<ObjectReader> reader = ObjectReader::open(path);
  REQUIRE(reader);
  CHECK_FALSE(reader->file().findings().empty());
  std::size_t count = 0;
  const Status read = reader->objects({}, [&](const RecordedObject& /*one*/) { return ++count, true; });
  CHECK(count > 0);
  CHECK(count < 800);
  REQUIRE_FALSE(read.ok());
  CHECK(read.error().code == Code::data_loss);
  CHECK_THAT(read.error().message, Contains(".dump | sed"));
  const Result<Examination> examined = check(path);
  REQUIRE(examined);
  CHECK_FALSE(examined->findings.empty());
  for (const std::size_t left : {whole.size() / 2, std::size_t{1000}, std::size_t{100}}) {
    fs::resize_file(path, left);
    INFO(left);
    CHECK(refusal_of(path).code == Code::data_loss);
    CHECK_THAT(refusal_of(path).message, Contains("damaged or cut off") && Contains(".dump | sed"));
  }
}

TEST_CASE("damage anywhere in a bag gives an error or messages, and no crash", "[recording][bag][fault]") {
  const TempFolder folder;
  const std::string path = folder.file("drive.db3");
  write_bag(path, {1, 2, 3, 4, 5, 6, 7, 8});
  const std::string whole = read_text(path);
  std::uint32_t random = 1;
  for (int i = 0; i < 400; ++i) {
    std::string damaged = whole;
    for (int k = 0; k < 4; ++k) {
      random = random * 1664525U + 1013904223U;
      damaged[100 + (random >> 8U) % (damaged.size() - 100)] = static_cast<char>(random >> 3U);
    }
    std::ofstream(path, std::ios::binary | std::ios::trunc) << damaged;
    std::uint64_t count = 0;
    if (const Result<ObjectReader> reader = ObjectReader::open(path)) {
      std::vector<std::string> flaws;
      (void)reader->objects(
          {}, [&](const RecordedObject& /*one*/) { return ++count, true; }, &flaws);
      CHECK(count <= reader->file().statistics().messages);
    }
    (void)check(path);
  }
}

TEST_CASE("a database that is no bag, of a later version, or that has programs in it, is refused",
          "[recording][bag][fault]") {
  const TempFolder folder;
  const std::string path = folder.file("drive.db3");
  const auto refused_after = [&](const std::string& sql) {
    write_bag(path, {1});
    sqlite3* database = nullptr;
    REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
    REQUIRE(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(database);
    const std::string text = refusal_of(path).message;
    fs::remove(path);
    return text;
  };
  CHECK_THAT(refused_after("UPDATE schema SET schema_version = 5"),
             Contains("schema version 5; versions up to 4 are known") && Contains("ros2 bag convert"));
  CHECK_THAT(refused_after("DROP TABLE topics"), Contains("no bag of rosbag2: no such table: topics"));
  CHECK_THAT(
      refused_after("ALTER TABLE messages RENAME TO hidden; CREATE VIEW messages AS SELECT * FROM hidden"),
      Contains("it has a view, a trigger or a virtual table, 'messages'"));
  CHECK_THAT(refused_after("CREATE TRIGGER greedy AFTER INSERT ON messages BEGIN SELECT 1; END"),
             Contains("'greedy'"));
  CHECK_THAT(refused_after("ALTER TABLE messages ADD COLUMN more AS (zeroblob(1000000000))"),
             Contains("its column 'more' is computed"));
}

TEST_CASE("a topic's messages that are compressed, or no CDR, are not taken for silence",
          "[recording][bag][fault]") {
  const TempFolder folder;
  const std::string path = folder.file("drive.db3");
  std::vector<std::byte> bytes = ros::to_cdr(ros_scan(1));
  const bool compressed = GENERATE(true, false);
  const std::vector<std::byte> begin =
      compressed ? std::vector{std::byte{0x28}, std::byte{0xB5}, std::byte{0x2F}, std::byte{0xFD}}
                 : std::vector(bytes.begin() + 4, bytes.begin() + 8);
  {
    DatabaseBag bag(path);
    bag.topic("/scan", "sensor_msgs/msg/LaserScan");
    std::ranges::copy(begin, bytes.begin());
    bag.add_bytes("/scan", kBegin, bytes);
    bag.topic("/json", "sensor_msgs/msg/LaserScan", "json");
  }
  const Result<ObjectReader> reader = ObjectReader::open(path);
  REQUIRE(reader);
  CHECK_THAT(reader->others().at("/json"), Contains("in the encoding 'json'"));
  std::vector<std::string> flaws;
  const Status read = reader->objects(
      {}, [](const RecordedObject& /*one*/) { return true; }, &flaws);
  CHECK(read.ok() != compressed);
  if (compressed) CHECK_THAT(read.error().message, Contains("/scan: its messages are compressed one by one"));
  if (!compressed) {
    REQUIRE(flaws.size() == 1);
    CHECK_THAT(flaws.front(),
               Contains("/scan: 1 message is left out") && Contains("plain little-endian CDR"));
  }
  REQUIRE(check(path));
  CHECK_THAT(check(path)->findings.at(0).text, Contains("do not begin as CDR does"));
}

TEST_CASE("a file that is compressed as a whole is refused with how to unpack it",
          "[recording][bag][fault]") {
  const TempFolder folder;
  const std::string path = folder.write("drive_0.db3.zstd", "\x28\xB5\x2F\xFD and so on");
  const Error refused = refusal_of(path);
  CHECK(refused.code == Code::unimplemented);
  CHECK_THAT(refused.message, Contains("zstd -d " + path + " -o " + folder.file("drive_0.db3")));
  CHECK_THAT(refusal_of(folder.path().string()).message, Contains("zstd -d " + path));
}

TEST_CASE("in a bag the name of a port means the only topic of its type", "[recording][bag]") {
  const TempFolder folder;
  {
    DatabaseBag bag(folder.file("drive.db3"));
    bag.add("/front/scan", kBegin, ros_scan(1));
    bag.add("/rear/scan", kBegin, ros_scan(1));
    bag.add("/odom", kBegin, ros_odometry(1, 0.0));
    bag.topic("/points", "sensor_msgs/msg/PointCloud2");
  }
  const Result<ObjectReader> reader = ObjectReader::open(folder.file("drive.db3"));
  REQUIRE(reader);
  const auto found = [&](const std::string& name) {
    return find_row(reader->rows(), reader->others(), name);
  };
  CHECK(*found("/odom") == "/odom");
  CHECK(*found("base.OdometryPush") == "/odom");
  CHECK(found("laser.LaserRangeReadingsPush").error().code == Code::invalid_argument);
  CHECK_THAT(found("laser.LaserRangeReadingsPush").error().message, Contains("/front/scan, /rear/scan"));
  CHECK_THAT(found("localizer.RobotPosePush").error().message,
             Contains("it has: /front/scan, /odom, /rear/scan"));
  CHECK_THAT(found("/points").error().message,
             Contains("sensor_msgs/msg/PointCloud2, which no object of Orca says"));
}

TEST_CASE("stamps of a clock that is far behind are moved to that of the recording, and it is said",
          "[recording][bag]") {
  const TempFolder folder;
  {
    DatabaseBag bag(folder.file("drive.db3"));
    for (int i = 0; i < 3; ++i) {
      bag.add("/scan", kBegin + i * kOneSecond, ros_scan(20 + i));
      bag.add("/odom", kBegin + i * kOneSecond + kOneSecond / 2, ros_odometry(20 + i, i));
    }
  }
  const auto run = RecordedRun::open(folder.file("drive.db3"));
  REQUIRE(run);
  std::vector<double> stamps;
  REQUIRE((*run)
              ->take_objects({},
                             [&](const RecordedObject& one) {
                               stamps.push_back(to_seconds(one.object.stamp().time_since_epoch()) - 1.7e9);
                             })
              .ok());
  CHECK(stamps == std::vector<double>{0.0, 0.0, 1.0, 1.0, 2.0, 2.0});
  REQUIRE((*run)->flaws().size() == 2);
  CHECK_THAT((*run)->flaws()[0], Contains("1699999980.0 s behind"));
  CHECK_THAT((*run)->flaws()[1], Contains("does not say where 'laser' is"));
}
