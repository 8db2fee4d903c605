// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "session.hpp"

// after session.hpp, which includes what Boost.Asio lacks
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "foxglove/assets.hpp"
#include "foxglove/channels.hpp"
#include "orca/ros/frame_tree.hpp"

namespace orca::view {

/// A viewer that speaks the Foxglove WebSocket protocol, such as Foxglove or Lichtblick, in the version
/// foxglove.websocket.v1 or foxglove.sdk.v1 (its messages are the same in both). Ports are topics with types of ROS 2 where ROS 2
/// has one, components are nodes.
///
/// Thread contract: the loop's thread.
class FoxgloveClient final : public Session {
 public:
  static constexpr const char* kProtocols[] = {"foxglove.sdk.v1", "foxglove.websocket.v1"};

  FoxgloveClient(Stream stream, Role role, Desk& desk, std::string protocol)
      : Session(std::move(stream), role, desk, std::move(protocol), "foxglove") {}

  void system_changed(bool is_up) override;
  void hear(std::uint32_t id, const nlohmann::json& line) override;

 private:
  // What it publishes.
  struct OwnChannel {
    std::string type;
    std::string encoding;
  };
  // A file that it has asked for.
  struct Request {
    std::uint32_t id = 0;
    std::string uri;
  };
  // A port at which it looks, for one subscription.
  struct View {
    std::uint32_t subscription = 0;
    Channel::Kind kind = Channel::Kind::object;
  };

  void take_text(const std::string& text) override;
  void take_bytes(const std::string& bytes) override;
  std::optional<Packet> pack(const Frame& frame) override;
  void looking(std::uint32_t id, const std::string& port, const std::string& type) override;
  void blind(std::uint32_t id, const Error& why, bool had_seen) override;
  void have_room() override;
  void say_drops(std::uint64_t dropped, std::size_t waiting) override;

  void carry_out(const std::string& op, const nlohmann::json& message);
  void greet();
  void take_ports(const nlohmann::json& ports);
  void take_graph(const nlohmann::json& graph);
  void subscribe(const nlohmann::json& message);
  void subscribe(std::uint32_t subscription, const Channel& channel);
  void unsubscribe(std::uint32_t subscription);
  void get_parameters(const nlohmann::json& message);
  void set_parameters(const nlohmann::json& message);
  void publish(const std::string& bytes);
  void fetch_asset(const nlohmann::json& message);
  void status(int level, const std::string& text);
  /// Asks the supervisor, and passes the whole answer on while the viewer is there.
  void ask(std::string command, std::vector<std::string> words,
           std::function<void(FoxgloveClient&, const nlohmann::json&)> then);

  nlohmann::json ports_ = nlohmann::json::array();
  std::vector<Channel> channels_;
  std::map<std::uint32_t, View> views_;  // by look
  std::uint32_t last_look_ = 0;
  std::map<std::uint32_t, OwnChannel> own_channels_;
  ros::FrameTree frames_;
  Assets assets_;
  std::deque<Request> requests_;  // one is answered at a time, because files are large
  bool wants_graph_ = false;
};

}  // namespace orca::view
