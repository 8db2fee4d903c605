// SPDX-License-Identifier: LGPL-3.0-or-later
#include "topics.hpp"

#include <functional>
#include <string>
#include <utility>

#include "orca/base/hash.hpp"
#include "orca/base/network_address.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/patterns/dds/ros_topics.hpp"
#include "orca/patterns/dds/team_topics.hpp"
#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"

namespace orca::host {
namespace {

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

// Calls `connect` for each port that has a topic or is in the team.
Status for_each_topic(const graph::ComponentNode& node, ComponentInstance& component,
                      const std::function<Status(Endpoint&, const graph::PortSetting&)>& connect) {
  for (const auto& [name, setting] : node.ports) {
    if (!setting.speaks_outside()) continue;
    Endpoint* const port = component.endpoint(setting.alias.empty() ? name : setting.alias);
    if (port == nullptr)
      return fail(Code::internal, "port " + node.name + "." + name +
                                      " was there when the graph was checked, and is not there now");
    if (Status connected = connect(*port, setting); !connected.ok()) return connected;
  }
  return ok();
}

Status connect_silence(Endpoint& port, const std::string& topic) {
  auto silence = std::make_unique<Silence>(topic);
  if (auto* hears = dynamic_cast<PushClientEndpoint*>(&port))
    hears->connect(*silence, port.contract().queue);
  else if (auto* sends = dynamic_cast<SendClientEndpoint*>(&port))
    sends->connect(*silence);
  else
    return ok();  // a server waits for nobody
  port.adopt(std::move(silence));
  return ok();
}

// Returns a number for a run that no other run has.
std::uint64_t number_of(const std::string& run) {
  if (run.empty()) return static_cast<std::uint64_t>(steady_now().time_since_epoch().count());
  Fnv1a hash;
  hash.add_text(run);
  return hash.value();
}

}  // namespace

Topics::Topics(const graph::Graph& graph, std::string run) : graph_(graph), run_(std::move(run)) {}
Topics::~Topics() = default;

Status Topics::open_ros() {
  if (ros_ != nullptr) return ok();
  const Result<RosOptions> options = ros_options_of_environment();
  if (!options) return options.error();
  Result<std::unique_ptr<RosTopics>> opened = open_ros_topics(*options);
  if (!opened) return opened.error();
  ros_ = std::move(opened).value();
  return ok();
}

Status Topics::open_team() {
  if (team_ != nullptr) return ok();
  const graph::Team& team = graph_.team;
  Result<std::string> address = own_address(team.interface, "", kNetworkPatience);
  if (!address) return address.error();
  const TeamOptions options{team.name, graph_.name, number_of(run_), team.domain, std::move(address).value()};
  Result<std::unique_ptr<TeamTopics>> opened = open_team_topics(options);
  if (!opened) return opened.error();
  team_ = std::move(opened).value();
  return ok();
}

Status Topics::connect(const graph::ComponentNode& node, ComponentInstance& component) {
  return for_each_topic(node, component, [this](Endpoint& port, const graph::PortSetting& setting) {
    return connect(port, setting);
  });
}

Status Topics::connect(Endpoint& port, const graph::PortSetting& setting) {
  const QueuePolicy& policy = port.contract().queue;
  if (!setting.topic.empty()) {
    if (Status opened = open_ros(); !opened.ok()) return opened;
    return ros_->connect(port, {setting.topic, setting.message}, policy);
  }
  if (graph_.team.name.empty()) return connect_silence(port, setting.team);
  if (Status opened = open_team(); !opened.ok()) return opened;
  return team_->connect(port, setting.team, policy);
}

Status connect_silence(const graph::ComponentNode& node, ComponentInstance& component) {
  return for_each_topic(node, component, [](Endpoint& port, const graph::PortSetting& setting) {
    return connect_silence(port, setting.topic.empty() ? setting.team : setting.topic);
  });
}

}  // namespace orca::host
