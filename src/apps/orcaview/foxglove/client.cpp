// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "foxglove/client.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <utility>

#include "answers.hpp"
#include "foxglove/robot_descriptions.hpp"
#include "foxglove/ros_messages.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/system.hpp"
#include "orca/ros/cdr.hpp"
#include "tapping/tapping.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

constexpr int kWarning = 1;
constexpr int kError = 2;
constexpr std::size_t kMostChannels = 64;   // that a viewer publishes
constexpr std::size_t kMostRequests = 256;  // for files, that wait
constexpr std::size_t kLongestUri = 4096;   // of a file
constexpr double kFrameRate = 30.0;         // [1/s] at which frames follow

// Returns what stands before the payload of a message.
std::string message_head(std::uint32_t subscription, std::uint64_t time_ns) {
  std::string head(1, '\x01');
  append(head, subscription);
  append(head, time_ns);
  return head;
}

std::uint64_t now_ns() {
  using Nanoseconds = std::chrono::nanoseconds;
  const auto now =
      std::chrono::duration_cast<Nanoseconds>(std::chrono::system_clock::now().time_since_epoch());
  return static_cast<std::uint64_t>(now.count());
}

// Returns a std_msgs/msg/String.
std::string cdr_text(const std::string& text) {
  std::string message("\0\1\0\0", 4);  // CDR, little-endian
  append(message, static_cast<std::uint32_t>(text.size() + 1));
  return message + text + '\0';
}

idl::LogLevel level_of(const std::string& name) {
  if (name == "error") return idl::LEVEL_ERROR;
  if (name == "warning") return idl::LEVEL_WARNING;
  return name == "debug" ? idl::LEVEL_DEBUG : idl::LEVEL_INFO;
}

// Returns a parameter's value as the protocol has it: a number, a flag or a text.
json value_of(const std::string& text) {
  const json value = json::parse(text, nullptr, false);
  return value.is_number() || value.is_boolean() ? value : json(text);
}

// Returns a value as one writes it on a command line.
std::string text_of_value(const json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

}  // namespace

void FoxgloveClient::system_changed(bool is_up) {
  greet();
  if (!is_up) return;
  ask("ports", {}, [](FoxgloveClient& client, const json& answer) {
    const json ports = json::parse(answer.value("text", ""), nullptr, false);
    if (ports.is_array()) client.take_ports(ports);
  });
}

// A new session number lets viewers forget what they knew of an earlier run.
void FoxgloveClient::greet() {
  for (const auto& [look, view] : std::exchange(views_, {})) look_away(look);
  channels_.clear();
  assets_ = {};
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  say({{"op", "serverInfo"},
       {"name", "Orca: " + desk().link().system()},
       {"capabilities", {"clientPublish", "parameters", "connectionGraph", "assets"}},
       {"supportedEncodings", {"cdr", "json"}},
       {"metadata", {{"ROS_DISTRO", "jazzy"}}},
       {"sessionId", std::to_string(now)}});
}

void FoxgloveClient::take_ports(const json& ports) {
  ports_ = ports;
  channels_ = channels_of(ports_);
  say(advertisement_of(channels_));
  if (wants_graph_) say(connection_graph_of(ports_));
  ask("graph", {}, [](FoxgloveClient& client, const json& answer) {
    const json graph = json::parse(answer.value("text", ""), nullptr, false);
    if (graph.is_object()) client.take_graph(graph);
  });
}

void FoxgloveClient::take_graph(const json& graph) {
  const std::vector<RobotFile> robots = robots_of(graph);
  assets_ = Assets(robots);
  if (robots.empty()) return;
  const auto descriptions = robot_descriptions_of(robots, static_cast<std::uint32_t>(channels_.size() + 1));
  channels_.insert(channels_.end(), descriptions.begin(), descriptions.end());
  say(advertisement_of(descriptions));
}

void FoxgloveClient::take_text(const std::string& text) {
  const json message = read_json(text);
  try {
    if (!message.is_object()) return status(kError, "a message must be a JSON object");
    carry_out(message.value("op", ""), message);
  } catch (const json::exception& error) {
    status(kError, std::string("a value of the message is missing, or of a wrong type: ") + error.what());
  }
}

void FoxgloveClient::carry_out(const std::string& op, const json& message) {
  if (op == "subscribe") {
    subscribe(message);
  } else if (op == "unsubscribe") {
    for (const json& one : message.at("subscriptionIds")) unsubscribe(one.get<std::uint32_t>());
  } else if (op == "advertise") {
    for (const json& one : message.at("channels")) {
      if (own_channels_.size() >= kMostChannels) return status(kError, "too many channels");
      own_channels_[one.at("id").get<std::uint32_t>()] = {one.at("schemaName").get<std::string>(),
                                                          one.at("encoding").get<std::string>()};
    }
  } else if (op == "unadvertise") {
    for (const json& one : message.at("channelIds")) own_channels_.erase(one.get<std::uint32_t>());
  } else if (op == "getParameters") {
    get_parameters(message);
  } else if (op == "setParameters") {
    set_parameters(message);
  } else if (op == "subscribeConnectionGraph") {
    wants_graph_ = true;
    say(connection_graph_of(ports_));
  } else if (op == "unsubscribeConnectionGraph") {
    wants_graph_ = false;
  } else if (op == "fetchAsset") {
    fetch_asset(message);
  } else {
    status(kWarning, "this server does not know the op \"" + op + "\"");
  }
}

void FoxgloveClient::subscribe(const json& message) {
  for (const json& one : message.at("subscriptions")) {
    const auto id = one.at("channelId").get<std::uint32_t>();
    const auto channel = std::ranges::find(channels_, id, &Channel::id);
    if (channel == channels_.end())
      status(kError, "there is no channel " + std::to_string(id));
    else
      subscribe(one.at("id").get<std::uint32_t>(), *channel);
  }
}

void FoxgloveClient::subscribe(std::uint32_t subscription, const Channel& channel) {
  unsubscribe(subscription);
  if (channel.kind == Channel::Kind::log) desk().follow_log(*this, subscription);
  if (channel.kind == Channel::Kind::text)
    say_bytes(message_head(subscription, now_ns()) + cdr_text(channel.text));
  for (const std::string& port : channel.ports) {
    const std::uint32_t id = ++last_look_;
    views_[id] = {subscription, channel.kind};
    const Status begun = look(id, port, channel.kind == Channel::Kind::frames ? kFrameRate : 0.0);
    if (!begun.ok()) blind(id, begun.error(), false);
  }
}

void FoxgloveClient::unsubscribe(std::uint32_t subscription) {
  desk().leave_log(*this, subscription);
  for (auto view = views_.begin(); view != views_.end();) {
    const bool is_of_it = view->second.subscription == subscription;
    if (is_of_it) look_away(view->first);
    view = is_of_it ? views_.erase(view) : std::next(view);
  }
}

void FoxgloveClient::looking(std::uint32_t /*id*/, const std::string& /*port*/, const std::string& /*type*/) {
}

void FoxgloveClient::blind(std::uint32_t id, const Error& why, bool had_seen) {
  views_.erase(id);
  status(had_seen ? kWarning : kError, why.text());
}

// The words are those at which viewers show a hint of their own.
void FoxgloveClient::say_drops(std::uint64_t dropped, std::size_t /*waiting*/) {
  status(kWarning, "Send buffer limit reached: " + std::to_string(dropped) + " messages were dropped so far");
}

std::optional<Packet> FoxgloveClient::pack(const Frame& frame) {
  const auto view = views_.find(frame.look);
  if (view == views_.end()) return std::nullopt;
  std::string head = message_head(view->second.subscription, frame.passed->passed);
  if (view->second.kind == Channel::Kind::object) {
    constexpr std::string_view kEncapsulation("\0\1\0\0", 4);  // CDR, little-endian
    return Packet{head.append(kEncapsulation), {}, frame.passed};
  }
  const Result<ObjectRef> object = orcactl::object_of(*frame.passed);
  if (!object) return std::nullopt;
  if (view->second.kind == Channel::Kind::frames) {
    const std::optional<ros::FrameNews> news = frames_.hear(*object);
    if (!news) return std::nullopt;
    return Packet{std::move(head), ros::to_cdr(news->message), nullptr};
  }
  std::optional<ros::RosMessage> message = ros::ros_twin(*object);
  if (!message) return std::nullopt;
  return Packet{std::move(head), std::move(message->payload), nullptr};
}

void FoxgloveClient::hear(std::uint32_t id, const json& line) {
  auto record = make_object<idl::LogRecord>();
  record->level(level_of(line.value("level", "")));
  record->source(line.value("who", ""));
  record->text(line.value("text", ""));
  const std::optional<ros::RosMessage> message = ros::ros_twin(std::move(record).seal());
  if (!message) return;
  const auto* const payload = reinterpret_cast<const char*>(message->payload.data());
  say_bytes(message_head(id, now_ns()) + std::string(payload, message->payload.size()));
}

void FoxgloveClient::fetch_asset(const json& message) {
  Request request{message.at("requestId").get<std::uint32_t>(), message.at("uri").get<std::string>()};
  if (requests_.size() >= kMostRequests || request.uri.size() > kLongestUri)
    return say_bytes(asset_response(
        request.id, fail(Code::unavailable, "too many requests wait, or the URI is too long")));
  requests_.push_back(std::move(request));
  wake();
}

void FoxgloveClient::have_room() {
  if (requests_.empty()) return;
  const Request request = std::move(requests_.front());
  requests_.pop_front();
  say_bytes(asset_response(request.id, assets_.read(request.uri)));
}

void FoxgloveClient::status(int level, const std::string& text) {
  say({{"op", "status"}, {"level", level}, {"message", text}});
}

void FoxgloveClient::ask(std::string command, std::vector<std::string> words,
                         std::function<void(FoxgloveClient&, const json&)> then) {
  const auto parts = std::make_shared<AnswerInParts>(0);
  desk().link().ask(
      for_it({std::move(command), std::move(words), true}),
      [parts](const supervisor::ControlAnswer& answer) { parts->take(answer); },
      [parts, then = std::move(then), self = weak_from_this()](const Status& outcome) {
        const auto client = std::static_pointer_cast<FoxgloveClient>(self.lock());
        if (!client) return;
        if (!outcome.ok()) return client->status(kError, outcome.error().text());
        then(*client, parts->finish(outcome));
      });
}

// Parameters are named COMPONENT.PARAM. Without names all are meant; each component answers for itself.
void FoxgloveClient::get_parameters(const json& message) {
  std::vector<std::string> names = message.value("parameterNames", std::vector<std::string>{});
  if (names.empty()) {
    for (const json& port : ports_) {
      const auto name = port.at("port").get<std::string>();
      std::string component = name.substr(0, name.rfind('.'));
      if (std::ranges::find(names, component) == names.end()) names.push_back(std::move(component));
    }
  }
  const std::string id = message.value("id", "");
  for (const std::string& name : names)
    ask("get", {name}, [id](FoxgloveClient& client, const json& answer) {
      json parameters = json::array();
      for (const json& row : answer.at("records"))
        parameters.push_back({{"name", row.value("component", "") + "." + row.value("param", "")},
                              {"value", value_of(row.value("value", ""))}});
      json values{{"op", "parameterValues"}, {"parameters", std::move(parameters)}};
      if (!id.empty()) values["id"] = id;
      client.say(values);
    });
}

void FoxgloveClient::set_parameters(const json& message) {
  std::vector<std::string> words;
  std::vector<std::string> names;
  for (const json& one : message.at("parameters")) {
    names.push_back(one.at("name").get<std::string>());
    words.push_back(names.back());
    words.push_back(text_of_value(one.at("value")));
  }
  json asked{{"parameterNames", std::move(names)}};
  if (message.contains("id")) asked["id"] = message["id"];
  ask("set", std::move(words),
      [asked](FoxgloveClient& client, const json& /*answer*/) { client.get_parameters(asked); });
}

void FoxgloveClient::take_bytes(const std::string& bytes) {
  constexpr std::size_t kHead = 5;
  if (bytes.size() < kHead || bytes[0] != '\x01')
    return status(kWarning, "this server does not know this binary message");
  publish(bytes);
}

void FoxgloveClient::publish(const std::string& bytes) {
  std::uint32_t id = 0;
  std::memcpy(&id, bytes.data() + 1, sizeof id);
  const auto channel = own_channels_.find(id);
  if (channel == own_channels_.end()) return status(kError, "the channel was not advertised");
  const Result<Published> request =
      read_ros_message(channel->second.type, channel->second.encoding, bytes.substr(1 + sizeof id));
  if (!request) return status(kError, request.error().message);
  const std::string port = port_with_end(ports_, request->port_end);
  if (port.empty())
    return status(kError, "the system has no port, or more than one, that ends in " + request->port_end);
  if (!desk().ports().reaches(port, request->xml, asker()) && !may_ask())
    return status(kError, "too many objects to ports that were not reached before");
  desk().ports().offer(port, request->xml, asker(),
                       [self = weak_from_this()](const Result<supervisor::OfferOutcome>& outcome) {
                         const auto client = std::static_pointer_cast<FoxgloveClient>(self.lock());
                         if (!client) return;
                         if (!outcome) return client->status(kError, outcome.error().text());
                         if (!outcome->outcome.ok()) client->status(kError, outcome->outcome.error().text());
                       });
}

}  // namespace orca::view
