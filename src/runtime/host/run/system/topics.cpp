// SPDX-License-Identifier: LGPL-3.0-or-later
#include "topics.hpp"

#include <utility>

#include "orca/base/files/own_library.hpp"

namespace orca::host {
namespace {

constexpr const char* kLibrary = "liborca_dds.so";

}  // namespace

Status Topics::open() {
  if (ros_ != nullptr) return ok();
  const Result<RosOptions> options = ros_options_of_environment();
  if (!options) return options.error();
  Result<std::unique_ptr<RosTopics>> opened = open_ros_topics(beside_own_library(kLibrary), *options);
  if (!opened) return opened.error();
  ros_ = std::move(opened).value();
  return ok();
}

Status Topics::connect(const graph::ComponentNode& node, ComponentInstance& component) {
  for (const auto& [name, setting] : node.ports) {
    if (setting.topic.empty()) continue;
    if (Status opened = open(); !opened.ok()) return opened;
    Endpoint* const port = component.endpoint(setting.alias.empty() ? name : setting.alias);
    if (port == nullptr)
      return fail(Code::internal, "port " + node.name + "." + name +
                                      " was there when the graph was checked, and is not there now");
    if (Status connected = ros_->connect(*port, {setting.topic, setting.message}, port->contract().queue);
        !connected.ok())
      return connected;
  }
  return ok();
}

}  // namespace orca::host
