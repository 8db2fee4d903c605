// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "foxglove/robot_descriptions.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <optional>
#include <utility>

#include "orca/base/descriptor.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

constexpr const char* kText = "std_msgs/msg/String";
constexpr const char* kTextFields = "string data\n";

// Returns the text of a plain file; nothing if it cannot be read, or is too long.
std::optional<std::string> text_of_file(const std::string& path) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat facts {};
  if (!file || fstat(file.number(), &facts) != 0 || !S_ISREG(facts.st_mode)) return std::nullopt;
  if (facts.st_size < 0 || static_cast<std::size_t>(facts.st_size) > kLongestDescription) return std::nullopt;
  std::string text(static_cast<std::size_t>(facts.st_size), '\0');
  if (::read(file.number(), text.data(), text.size()) != facts.st_size) return std::nullopt;
  return text;
}

}  // namespace

std::vector<Channel> robot_descriptions_of(const json& graph, std::uint32_t first) {
  std::vector<Channel> channels;
  for (const json& hardware : graph.at("hardware")) {
    const json& params = hardware.at("params");
    const auto robot = params.find("robot");
    const std::string path =
        robot != params.end() && robot->is_string() ? robot->get<std::string>() : std::string();
    std::optional<std::string> text = path.ends_with(".urdf") ? text_of_file(path) : std::nullopt;
    if (!text) continue;
    const auto name = hardware.at("name").get<std::string>();
    channels.push_back({first + static_cast<std::uint32_t>(channels.size()),
                        Channel::Kind::text,
                        "/" + name + "/robot_description",
                        {},
                        kText,
                        kTextFields,
                        std::move(*text)});
  }
  if (channels.size() == 1) channels.front().topic = "/robot_description";
  return channels;
}

}  // namespace orca::view
