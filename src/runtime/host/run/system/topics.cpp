// SPDX-License-Identifier: LGPL-3.0-or-later
#include "topics.hpp"

#include <functional>
#include <string>
#include <utility>

#include "orca/base/files/own_library.hpp"
#include "orca/patterns/dds/ros_topics.hpp"
#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"

namespace orca::host {
namespace {

constexpr const char* kLibrary = "liborca_dds.so";

// A topic on which nobody speaks and which everybody may speak on.
class Silence final : public PushSource, public SendTarget, public LinkEnd {
 public:
  explicit Silence(std::string topic) : topic_(std::move(topic)) {}

  void attach(PushSink& sink, const UpdateRate& rate) override {
    sink.granted(grant_rate(rate, Duration{0}));
  }
  void detach() override {}
  void change(const UpdateRate& /*rate*/) override {}
  void room() override {}
  [[nodiscard]] Duration base_period() const override { return Duration{0}; }
  [[nodiscard]] std::string path() const override { return topic_; }

  std::optional<Status> offer(const ObjectRef& /*object*/, SendReplySink& /*reply_to*/, RequestId /*id*/,
                              bool /*may_wait*/) override {
    return ok();
  }
  void withdraw(RequestId /*id*/) override {}
  [[nodiscard]] Duration patience() const override { return Duration{0}; }

 private:
  const std::string topic_;
};

// Calls `connect` for each port that has a topic.
Status for_each_topic(const graph::ComponentNode& node, ComponentInstance& component,
                      const std::function<Status(Endpoint&, const graph::PortSetting&)>& connect) {
  for (const auto& [name, setting] : node.ports) {
    if (setting.topic.empty()) continue;
    Endpoint* const port = component.endpoint(setting.alias.empty() ? name : setting.alias);
    if (port == nullptr)
      return fail(Code::internal, "port " + node.name + "." + name +
                                      " was there when the graph was checked, and is not there now");
    if (Status connected = connect(*port, setting); !connected.ok()) return connected;
  }
  return ok();
}

}  // namespace

Topics::Topics() = default;
Topics::~Topics() = default;

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
  return for_each_topic(node, component, [this](Endpoint& port, const graph::PortSetting& setting) {
    if (Status opened = open(); !opened.ok()) return opened;
    return ros_->connect(port, {setting.topic, setting.message}, port.contract().queue);
  });
}

Status connect_silence(const graph::ComponentNode& node, ComponentInstance& component) {
  return for_each_topic(node, component, [](Endpoint& port, const graph::PortSetting& setting) {
    auto silence = std::make_unique<Silence>(setting.topic);
    if (auto* hears = dynamic_cast<PushClientEndpoint*>(&port))
      hears->connect(*silence, port.contract().queue);
    else if (auto* sends = dynamic_cast<SendClientEndpoint*>(&port))
      sends->connect(*silence);
    else
      return ok();  // a server waits for nobody
    port.adopt(std::move(silence));
    return ok();
  });
}

}  // namespace orca::host
