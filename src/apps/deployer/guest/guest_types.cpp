// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "guest_types.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "guest_component.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::guest {
namespace {

// Counts up whenever the packets change; python/orca_robots/guests.py has the same.
constexpr const char* kVersion = "1";

Error wrong(const std::string& what) { return fail(Code::invalid_argument, what); }

Result<TypeId> object_named(const std::string& name) {
  if (const ObjectType* const type = find_object_type(name)) return type_id(*type);
  std::vector<std::string> names;
  for (const ObjectType* type : object_types()) names.emplace_back(type->name);
  return wrong("there is no object type " + in_quotes(name) +
               xml::did_you_mean(xml::nearest_name(name, names)));
}

Result<Trigger> trigger_of(const std::string& kind, const std::string& value) {
  if (kind == "on") return Trigger{Trigger::Kind::on_any, {}, {value}};
  if (kind != "period") return Trigger{};
  const Result<double> seconds = xml::parse_number(value);
  if (!seconds) return seconds.error();
  if (*seconds < 1e-6 || *seconds > 1e6)
    return wrong("lap_every is a time from 0.000001 to 1000000 s, not " + value);
  return Trigger{Trigger::Kind::period, from_seconds(*seconds), {}};
}

// A port, in words: kind, name, type, reply, whether it may stay unconnected, text.
Result<PortContract> port_of(const Packet& words) {
  static const std::pair<const char*, std::pair<Pattern, Role>> kKinds[] = {
      {"PushProxy", {Pattern::push, Role::proxy}},   {"PushServer", {Pattern::push, Role::server}},
      {"QueryProxy", {Pattern::query, Role::proxy}}, {"QueryServer", {Pattern::query, Role::server}},
      {"SendServer", {Pattern::send, Role::server}}, {"SendProxy", {Pattern::send, Role::proxy}}};
  const auto kind = std::ranges::find(kKinds, words[1], [](const auto& known) { return known.first; });
  if (kind == std::end(kKinds)) return wrong("a port cannot be a " + words[1]);
  PortContract port;
  port.name = words[2];
  port.pattern = kind->second.first;
  port.role = kind->second.second;
  const Result<TypeId> type = object_named(words[3]);
  if (!type) return wrong("port " + in_quotes(port.name) + ": " + type.error().message);
  port.type = *type;
  if (port.pattern == Pattern::query) {
    const Result<TypeId> reply = object_named(words[4]);
    if (!reply) return wrong("port " + in_quotes(port.name) + ": " + reply.error().message);
    port.reply = *reply;
  }
  port.required = words[5] != "optional";
  port.text = words[6];
  return port;
}

Result<ParamValue> value_of(ParamType type, const std::string& text) {
  if (type == ParamType::boolean) return ParamValue(text == "true");
  if (type == ParamType::text) return ParamValue(text);
  if (type == ParamType::integer)
    return xml::parse_integer(text).and_then([](std::int64_t value) { return Result(ParamValue(value)); });
  return xml::parse_number(text).and_then([](double value) { return Result(ParamValue(value)); });
}

// A parameter, in words: name, type, default value, unit, least and greatest value, text.
Result<ParamContract> param_of(const Packet& words) {
  ParamContract param;
  param.name = words[1];
  param.type = words[2] == "bool"  ? ParamType::boolean
               : words[2] == "int" ? ParamType::integer
               : words[2] == "str" ? ParamType::text
                                   : ParamType::real;
  const Result<ParamValue> value = value_of(param.type, words[3]);
  if (!value) return wrong("parameter " + in_quotes(param.name) + ": " + value.error().message);
  param.default_value = *value;
  param.unit = words[4];
  if (const Result<double> least = xml::parse_number(words[5])) param.min = *least;
  if (const Result<double> greatest = xml::parse_number(words[6])) param.max = *greatest;
  param.text = words[7];
  return param;
}

std::vector<GuestType> g_types;
PacketLine* g_line = nullptr;

template <std::size_t index>
void* create(PluginHost& host) {
  return static_cast<Component*>(
      new GuestComponent(static_cast<ComponentHost&>(host), g_types[index], *g_line));
}

void destroy(void* object) { delete static_cast<Component*>(object); }

// A plugin's entry has no room for more than a function, so each type has a function of its own.
template <std::size_t... indices>
constexpr auto creators(std::index_sequence<indices...> /*all*/) {
  return std::array<void* (*)(PluginHost&), sizeof...(indices)>{create<indices>...};
}
constexpr auto kCreators = creators(std::make_index_sequence<GuestTypes::kMost>{});

Packet layouts() {
  Packet packet{"layouts"};
  for (const ObjectType* type : object_types()) {
    packet.emplace_back(type->name);
    packet.emplace_back(type->layout);
  }
  return packet;
}

// Reads everything up to "ready".
Status read_all(PacketLine& line, std::vector<GuestType>& types) {
  const std::optional<Packet> hello = line.receive();
  if (!hello || *hello != Packet{"guest", kVersion})
    return wrong("--guest: the program at this socket does not belong to this version of Orca");
  for (;;) {
    const std::optional<Packet> packet = line.receive();
    if (!packet) return wrong("--guest: the program has ended before it had said which types it has");
    if (packet->front() == "ready") return ok();
    if (const Status read = read_declaration(*packet, types); !read.ok()) return read;
  }
}

}  // namespace

Status read_declaration(const Packet& packet, std::vector<GuestType>& types) {
  const std::string& kind = packet.front();
  const std::size_t size = kind == "type" ? 4 : kind == "port" ? 7 : kind == "param" ? 8 : 0;
  if (packet.size() != size || (kind != "type" && types.empty()))
    return wrong("--guest: a packet " + in_quotes(kind) + " of " + std::to_string(packet.size()) + " words");
  if (kind == "type") {
    if (types.size() == GuestTypes::kMost)
      return wrong("a program may have " + std::to_string(GuestTypes::kMost) + " component types at most");
    const Result<Trigger> trigger = trigger_of(packet[2], packet[3]);
    if (!trigger) return wrong(packet[1] + ": " + trigger.error().message);
    types.push_back({packet[1], *trigger});
    return ok();
  }
  GuestType& type = types.back();
  const auto placed = [&](const Error& error) { return wrong(type.type + ": " + error.message); };
  if (kind == "port") {
    Result<PortContract> port = port_of(packet);
    if (!port) return placed(port.error());
    type.ports.push_back(std::move(port).value());
  } else {
    Result<ParamContract> param = param_of(packet);
    if (!param) return placed(param.error());
    type.params.push_back(std::move(param).value());
  }
  return ok();
}

Result<std::unique_ptr<GuestTypes>> GuestTypes::receive(Descriptor socket) {
  PacketLine line(std::move(socket));
  std::vector<GuestType> types;
  if (const Status read = read_all(line, types); !read.ok()) {
    line.send({"refused", read.error().message});
    return read.error();
  }
  line.send(layouts());
  return std::unique_ptr<GuestTypes>(new GuestTypes(std::move(line), std::move(types)));
}

GuestTypes::GuestTypes(PacketLine line, std::vector<GuestType> types)
    : line_(std::move(line)), types_(std::move(types)) {
  g_types = types_;
  g_line = &line_;
  for (std::size_t i = 0; i < types_.size(); ++i)
    entries_.push_back({PluginKind::component, types_[i].type.c_str(), kCreators[i], destroy});
}

GuestTypes::~GuestTypes() { g_line = nullptr; }

void GuestTypes::add_to(host::PluginCatalogue& catalogue) const {
  for (const TypeEntry& entry : entries_) catalogue.add(entry);
}

}  // namespace orca::guest
