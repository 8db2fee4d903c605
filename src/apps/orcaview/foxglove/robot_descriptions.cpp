// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "foxglove/robot_descriptions.hpp"

#include <utility>

#include "foxglove/assets.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

constexpr const char* kText = "std_msgs/msg/String";
constexpr const char* kTextFields = "string data\n";

std::string text_at(const json& params, const char* name) {
  const auto found = params.find(name);
  return found != params.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace

std::vector<RobotFile> robots_of(const json& graph) {
  std::vector<RobotFile> robots;
  for (const json& hardware : graph.at("hardware")) {
    const json& params = hardware.at("params");
    std::string path = text_at(params, "robot");
    if (!path.ends_with(".urdf")) continue;
    Result<std::string> text = read_asset(path);
    if (!text || text->size() > kLongestDescription) continue;
    robots.push_back({hardware.at("name").get<std::string>(), std::move(path), text_at(params, "packages"),
                      std::move(*text)});
  }
  return robots;
}

std::vector<Channel> robot_descriptions_of(const std::vector<RobotFile>& robots, std::uint32_t first) {
  std::vector<Channel> channels;
  for (const RobotFile& robot : robots)
    channels.push_back({first + static_cast<std::uint32_t>(channels.size()),
                        Channel::Kind::text,
                        "/" + robot.hardware + "/robot_description",
                        {},
                        kText,
                        kTextFields,
                        robot.text});
  if (channels.size() == 1) channels.front().topic = "/robot_description";
  return channels;
}

}  // namespace orca::view
