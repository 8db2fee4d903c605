// SPDX-License-Identifier: GPL-3.0-or-later
// The messages of ROS 2 as bytes: as other programs write them, and whatever they hold.
#include <catch2/catch.hpp>
#include <random>
#include <set>
#include <string>

#include "hex.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/generated/messages.hpp"
#include "orca/ros/message_type.hpp"

using namespace orca;
using namespace orca::ros;
using orca::test::hex;

namespace {

// Fills every field with something random: numbers of any bits that can be compared, texts, up to four elements.
class RandomFiller {
 public:
  explicit RandomFiller(std::uint32_t seed) : random_(seed) {}

  template <class T>
  void field(const FieldInfo& /*info*/, T& value) {
    fill(value);
  }

 private:
  void fill(bool& value) { value = (random_() & 1U) != 0; }
  template <class T>
  requires std::is_integral_v<T>
  void fill(T& value) { value = static_cast<T>(random_()); }
  void fill(float& value) { value = static_cast<float>(random_()) / 7.0F; }
  void fill(double& value) { value = static_cast<double>(random_()) / 3.0 - 7e8; }
  void fill(std::string& text) {
    text.clear();
    for (std::size_t i = random_() % 9; i > 0; --i) text += static_cast<char>('a' + random_() % 26);
  }
  template <ReflectedStruct T>
  void fill(T& value) {
    Reflection<T>::fields(value, *this);
  }
  template <class T>
  void fill(std::vector<T>& values) {
    values.resize(random_() % 5);
    for (T& value : values) fill(value);
  }
  template <class T, std::size_t N>
  void fill(std::array<T, N>& values) {
    for (T& value : values) fill(value);
  }

  std::mt19937 random_;
};

template <class Action>
void for_each_message(const Action& action) {
  std::apply([&](const auto&... messages) { (action(messages), ...); }, Messages{});
}

}  // namespace

// Facts: rmw_fastrtps and Cyclone DDS write these bytes.
TEST_CASE("messages are written as other programs write them", "[ros][messages]") {
  CHECK(hex(to_cdr(std_msgs::String{"hello"})) == "00010000 06000000 68656c6c 6f00");
  const geometry_msgs::Twist twist{{0.25, 0.0, 0.0}, {0.0, 0.0, -0.5}};
  CHECK(hex(to_cdr(twist)) ==
        "00010000 00000000 0000d03f 00000000 00000000 00000000 00000000 00000000 00000000 00000000 00000000 "
        "00000000 0000e0bf");
  CHECK(hex(to_cdr(geometry_msgs::TwistStamped{{{1, 500'000'000}, "base_link"}, twist})) ==
        "00010000 01000000 0065cd1d 0a000000 62617365 5f6c696e 6b000000 00000000 0000d03f 00000000 00000000 "
        "00000000 00000000 00000000 00000000 00000000 00000000 00000000 0000e0bf");
  const sensor_msgs::LaserScan scan{{{1, 500'000'000}, "laser"}, -1.0F, 1.0F, 1.0F, 0.0F, 0.1F, 0.0F, 8.0F,
                                    {1.0F, 2.0F, 3.0F},          {}};
  CHECK(hex(to_cdr(scan)) ==
        "00010000 01000000 0065cd1d 06000000 6c617365 72000000 000080bf 0000803f 0000803f 00000000 cdcccc3d "
        "00000000 00000041 03000000 0000803f 00000040 00004040 00000000");
  CHECK(hex(to_cdr(sensor_msgs::Range{{{1, 0}, "s0"}, 0, 0.4F, 0.15F, 6.0F, 1.5F, 0.0F})) ==
        "00010000 01000000 00000000 03000000 73300000 cdcccc3e 9a99193e 0000c040 0000c03f 00000000");
}

TEST_CASE("empty messages have the sizes that others give them", "[ros][messages]") {
  CHECK(to_cdr(std_msgs::Header{}).size() == 17);
  CHECK(to_cdr(geometry_msgs::PoseStamped{}).size() == 76);
  CHECK(to_cdr(geometry_msgs::PoseWithCovarianceStamped{}).size() == 364);
  CHECK(to_cdr(nav_msgs::Odometry{}).size() == 708);
  CHECK(to_cdr(sensor_msgs::LaserScan{}).size() == 56);
  CHECK(to_cdr(sensor_msgs::Image{}).size() == 44);
  CHECK(to_cdr(sensor_msgs::BatteryState{}).size() == 73);
  CHECK(to_cdr(sensor_msgs::Imu{}).size() == 316);
  CHECK(to_cdr(nav_msgs::OccupancyGrid{}).size() == 104);
  CHECK(to_cdr(nav_msgs::Path{}).size() == 24);
  CHECK(to_cdr(rcl_interfaces::Log{}).size() == 52);
  CHECK(to_cdr(rosgraph_msgs::Clock{}).size() == 12);
}

TEST_CASE("every message comes back bit for bit, whatever it holds", "[ros][messages]") {
  for_each_message([](const auto& kind) {
    using Message = std::remove_cvref_t<decltype(kind)>;
    CAPTURE(Reflection<Message>::name);
    for (std::uint32_t seed = 0; seed < 100; ++seed) {
      Message message;
      RandomFiller filler(seed);
      Reflection<Message>::fields(message, filler);
      const std::vector<std::byte> bytes = to_cdr(message);
      Message back;
      REQUIRE(from_cdr(bytes, back).ok());
      REQUIRE(back == message);
      REQUIRE(to_cdr(back) == bytes);
    }
  });
}

TEST_CASE("a message that is cut short, or in another encoding, is refused", "[ros][messages]") {
  for_each_message([](const auto& kind) {
    using Message = std::remove_cvref_t<decltype(kind)>;
    CAPTURE(Reflection<Message>::name);
    Message message;
    RandomFiller filler(1);
    Reflection<Message>::fields(message, filler);
    std::vector<std::byte> bytes = to_cdr(message);
    Message back;
    for (std::size_t size = 0; size < bytes.size(); ++size)
      CHECK_FALSE(from_cdr(std::span(bytes).first(size), back).ok());
    bytes[1] = std::byte{7};  // XCDR2
    CHECK_FALSE(from_cdr(bytes, back).ok());
  });
}

TEST_CASE("what can be a topic's has a hash that no other has", "[ros][messages]") {
  std::set<std::string> hashes;
  for (const char* const name :
       {"geometry_msgs/msg/Twist", "sensor_msgs/msg/LaserScan", "nav_msgs/msg/Odometry",
        "tf2_msgs/msg/TFMessage", "nav_msgs/msg/OccupancyGrid"}) {
    const auto type = standard_message_type(name);
    REQUIRE(type);
    CHECK(type->hash.size() == 64);
    CHECK(hashes.insert(type->hash).second);
  }
  CHECK(dds_type_name("sensor_msgs/msg/LaserScan") == "sensor_msgs::msg::dds_::LaserScan_");
}
