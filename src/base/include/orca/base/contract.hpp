// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "orca/base/time.hpp"

namespace orca {

/// The three communication patterns (thesis 7.3).
enum class Pattern { push, query, send };

/// The end of a pattern that a port is. The server offers, the proxy uses.
enum class Role { server, proxy };

[[nodiscard]] constexpr const char* to_string(Pattern pattern) {
  return pattern == Pattern::push ? "Push" : pattern == Pattern::query ? "Query" : "Send";
}
[[nodiscard]] constexpr const char* to_string(Role role) { return role == Role::server ? "Server" : "Proxy"; }

/// Identity of an object type: IDL name and hash of the flattened layout, never a typeid address.
struct TypeId {
  std::string name;        ///< e.g. "SonarRangeReadings".
  std::uint64_t hash = 0;  ///< FNV-1a of the flattened layout.
  std::string layout;      ///< The flattened layout, for people: "Name:Parent{field:type {unit},...}".
  /// The types that it extends, its parent first, without OrcaObject; their own ancestors are not repeated.
  std::vector<TypeId> ancestors{};
  friend bool operator==(const TypeId& a, const TypeId& b) { return a.name == b.name && a.hash == b.hash; }
};

/// Returns whether an object of `type` is also one of `wanted`: the same type, or one derived from it.
[[nodiscard]] inline bool is_a(const TypeId& type, const TypeId& wanted) {
  return type == wanted ||
         std::find(type.ancestors.begin(), type.ancestors.end(), wanted) != type.ancestors.end();
}

/// The buffering of an edge. The author of a port sets the default, the integrator decides in the graph.
struct QueuePolicy {
  /// The treatment of an object when the queue is full.
  enum class Overflow {
    drop_oldest,  ///< Push: the oldest object makes room.
    drop_newest,  ///< Push: the new object is dropped.
    block,   ///< The sender waits for room, at most `block_limit`; then the object is dropped or refused.
    refuse,  ///< Send and Query: the sender learns that the object was not accepted.
  };
  /// Send: the moment at which an object counts as sent.
  enum class Confirm {
    accepted,  ///< It waits in the server's queue. It is lost if the server's process dies before it is handled.
    handled,  ///< The server's handler has returned; its error is the sender's.
  };
  std::uint32_t depth = 1;  ///< Objects kept, at least 1; depth 1 with drop_oldest means "the latest".
  Overflow overflow = Overflow::drop_oldest;
  Duration min_interval{0};  ///< Push: deliver at most one object per interval [s]; 0: every one.
  Duration deadline{0};      ///< Push: an object is due at least this often [s]; 0: no deadline.
  Duration block_limit{std::chrono::milliseconds(100)};  ///< Longest wait of a sender for room [s].
  static constexpr std::uint32_t kAnyDrops = 0xFFFFFFFF;
  /// Push: objects that may be dropped before the edge reports it, or kAnyDrops; nothing: as many as accepted_drops() says.
  std::optional<std::uint32_t> drop_limit{};
  Confirm confirm = Confirm::accepted;

  /// Returns how many objects a Push edge may drop before it reports it; nothing: any number. Where the author
  /// and the graph give no limit, "the latest" may drop any number, because that is its purpose, and other
  /// queues none.
  [[nodiscard]] constexpr std::optional<std::uint32_t> accepted_drops() const {
    if (drop_limit == kAnyDrops) return std::nullopt;
    const bool is_latest = depth == 1 && overflow == Overflow::drop_oldest;
    return drop_limit || is_latest ? drop_limit : std::optional<std::uint32_t>(0);
  }
  friend bool operator==(const QueuePolicy&, const QueuePolicy&) = default;
};

[[nodiscard]] constexpr const char* to_string(QueuePolicy::Overflow overflow) {
  switch (overflow) {
    case QueuePolicy::Overflow::drop_oldest: return "drop_oldest";
    case QueuePolicy::Overflow::drop_newest: return "drop_newest";
    case QueuePolicy::Overflow::block: return "block";
    case QueuePolicy::Overflow::refuse: return "refuse";
  }
  return "?";
}

[[nodiscard]] constexpr const char* to_string(QueuePolicy::Confirm confirm) {
  return confirm == QueuePolicy::Confirm::handled ? "handled" : "accepted";
}

/// One declared port of a component.
struct PortContract {
  std::string name;
  Pattern pattern = Pattern::push;
  Role role = Role::server;
  TypeId type;                  ///< The object pushed or sent, or the request of a Query.
  std::optional<TypeId> reply;  ///< Query only: the reply.
  bool required = false;        ///< A proxy that must be connected.
  bool many = false;            ///< A port array: any number of edges may end at this proxy.
  QueuePolicy queue;            ///< The author's default for edges that end here.
  Duration period{0};           ///< PushServer: base period [s], if it is known before the start; 0: unknown.
  bool from_device = false;     ///< PushServer: a device's strand pushes here, and it waits for nobody.
  std::string text;             ///< One sentence for people.
};

enum class ParamType { boolean, integer, real, text, text_list };
using ParamValue = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

[[nodiscard]] constexpr const char* to_string(ParamType type) {
  switch (type) {
    case ParamType::boolean: return "true or false";
    case ParamType::integer: return "integer";
    case ParamType::real: return "number";
    case ParamType::text: return "text";
    case ParamType::text_list: return "list of texts separated by ';'";
  }
  return "?";
}

/// One declared parameter. Numbers are in SI units.
struct ParamContract {
  std::string name;
  ParamType type = ParamType::real;
  std::string unit;                  ///< SI unit: "m", "rad", "s", "m/s", "rad/s", "Hz", ...; empty for none.
  std::optional<double> min;         ///< Smallest allowed value, in `unit`.
  std::optional<double> max;         ///< Largest allowed value, in `unit`.
  std::vector<std::string> choices;  ///< Allowed values of a text; empty: any.
  bool file = false;                 ///< A text that names a file, relative to the graph file that sets it.
  bool fixed = false;                ///< Cannot change while the component runs.
  ParamValue default_value;          ///< A value of type `type`.
  std::string text;                  ///< One sentence for people.
};

/// The condition that starts a lap of work().
struct Trigger {
  enum class Kind {
    free_running,  ///< The next lap follows at once; work() blocks by itself.
    period,        ///< One lap each `period`.
    on_any,     ///< One lap per new object on one of the `ports` (thesis 7.4: with the latest of the others).
    on_all,     ///< One lap when every server that the `ports` listen to has sent something new.
    on_stamps,  ///< One lap when objects that were sensed at one moment wait from all those servers.
  };
  Kind kind = Kind::free_running;
  Duration period{0};              ///< With ports: the longest time between two laps; 0: no limit.
  std::vector<std::string> ports;  ///< PushProxies and PushProxyArrays.
  Duration within{0};              ///< With on_stamps: largest difference of the stamps [s].

  [[nodiscard]] bool waits_for_ports() const { return kind == Kind::on_any || needs_all_ports(); }
  [[nodiscard]] bool needs_all_ports() const { return kind == Kind::on_all || kind == Kind::on_stamps; }
  friend bool operator==(const Trigger&, const Trigger&) = default;
};

enum class PluginKind { component, hardware };

/// An error, or something doubtful, in the values of a hardware container's parameters, or in the files that they name.
struct HardwareFault {
  /// The parameter to correct; empty: `text` is a whole line about a place in another file.
  std::string param;
  std::string text;  ///< The value found and the one expected.
  /// Other parameters that the fault follows from. The checker drops the fault if the value of one of them, or
  /// of `param`, could not be read: what is wrong with that one is reported already.
  std::vector<std::string> follows_from{};
  /// Whether it is a fault only if the two containers compared are in different processes.
  bool if_apart = false;
  /// It can be used as it is, but most likely something else was meant: the checker warns, and nothing stops.
  bool only_warns = false;
  friend bool operator==(const HardwareFault&, const HardwareFault&) = default;
};

/// A description of what a type of component or hardware container offers and needs. It is obtained by
/// constructing an object, without starting it.
struct Contract {
  PluginKind kind = PluginKind::component;
  std::string type;     ///< e.g. "orca.SonarAvoid".
  std::string library;  ///< File name of the plugin it came from.
  std::vector<PortContract> ports;
  std::vector<ParamContract> params;
  Trigger default_trigger;
  bool needs_hardware = false;  ///< The component must name a `<hardware>` of the graph.

  [[nodiscard]] const PortContract* port(const std::string& name) const {
    for (const PortContract& p : ports)
      if (p.name == name) return &p;
    return nullptr;
  }
  [[nodiscard]] const ParamContract* param(const std::string& name) const {
    for (const ParamContract& p : params)
      if (p.name == name) return &p;
    return nullptr;
  }
};

}  // namespace orca
