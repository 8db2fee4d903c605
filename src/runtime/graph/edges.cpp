// SPDX-License-Identifier: LGPL-3.0-or-later
#include "edges.hpp"

#include "codes.hpp"
#include "orca/base/layout.hpp"
#include "orca/xml/number.hpp"
#include "values.hpp"

namespace orca::graph {
namespace {

// One reason why two ends do not fit, the most basic first; nothing if they do.
struct Misfit {
  const char* code;
  std::string reason;
};

std::optional<Misfit> direction_misfit(const Endpoint& from, const Endpoint& to) {
  const bool from_ok = is_from_end(*from.port);
  const bool to_ok = !is_from_end(*to.port);
  if (from_ok && to_ok) return std::nullopt;
  if (!from_ok && !to_ok)
    return Misfit{codes::kDirection, "the ends are the wrong way round; exchange from and to"};
  const std::string kind = from_ok ? "both ends are outputs" : "both ends are inputs";
  return Misfit{codes::kDirection,
                kind + "; from is a PushServer, QueryProxy or SendProxy, to the other end of it"};
}

std::optional<Misfit> type_misfit(const TypeId& from, const TypeId& to, const std::string& what) {
  if (from.name != to.name) {
    return Misfit{codes::kType,
                  "the " + what + " is " + from.name + " at one end and " + to.name + " at the other"};
  }
  if (from.hash == to.hash) return std::nullopt;
  return Misfit{codes::kLayout, "both ends call the " + what + " " + from.name + ", but " +
                                    layout_difference(from.layout, to.layout) +
                                    "; build both plugins against the same types"};
}

std::optional<Misfit> misfit(const Endpoint& from, const Endpoint& to) {
  if (from.port->pattern != to.port->pattern) {
    return Misfit{codes::kPattern, "the two ends must have the same pattern"};
  }
  if (auto direction = direction_misfit(from, to)) return direction;
  const bool query = from.port->pattern == Pattern::query;
  if (auto type = type_misfit(from.port->type, to.port->type, query ? "request" : "object")) return type;
  if (!from.port->reply || !to.port->reply) return std::nullopt;
  return type_misfit(*from.port->reply, *to.port->reply, "reply");
}

// Reads queue, overflow and interval into an edge.
class PolicyReader {
 public:
  PolicyReader(const Node& connection, Edge& edge, Report& report)
      : connection_(connection), edge_(edge), report_(report) {}

  bool read() {
    if (!check_pattern()) return false;
    const bool depth_ok = read_depth();
    const bool overflow_ok = read_overflow();
    return read_interval() && depth_ok && overflow_ok;
  }

 private:
  bool check_pattern() {
    bool fits = true;
    for (const char* attribute : {"queue", "overflow", "interval"}) {
      const bool allowed = edge_.pattern == Pattern::push ||
                           (edge_.pattern == Pattern::send && attribute != std::string_view("interval"));
      if (allowed || connection_.find(attribute) == nullptr) continue;
      fits = false;
      report_.error(codes::kPolicy, connection_.place(attribute),
                    std::string(attribute) + " has no meaning for a " + to_string(edge_.pattern) +
                        " connection; remove it");
    }
    return fits;
  }

  bool read_depth() {
    const Text* queue = connection_.find("queue");
    if (queue == nullptr) return true;
    if (queue->known && xml::trimmed(queue->value) == "latest") {
      edge_.queue = QueuePolicy{};
      return true;
    }
    ParamContract contract;
    contract.type = ParamType::integer;
    contract.min = 1;
    contract.max = 100'000;
    const auto depth = read_value(*queue, contract, "queue (\"latest\" or a number of objects)", report_);
    if (depth) edge_.queue.depth = static_cast<std::uint32_t>(std::get<std::int64_t>(*depth));
    return depth.has_value();
  }

  bool read_overflow() {
    const Text* overflow = connection_.find("overflow");
    if (overflow == nullptr) return true;
    ParamContract contract;
    contract.type = ParamType::text;
    contract.choices = {"drop_oldest", "drop_newest"};
    const auto choice = read_value(*overflow, contract, "overflow", report_);
    if (!choice) return false;
    const bool newest = std::get<std::string>(*choice) == "drop_newest";
    edge_.queue.overflow = newest ? QueuePolicy::Overflow::drop_newest : QueuePolicy::Overflow::drop_oldest;
    return true;
  }

  bool read_interval() {
    const Text* interval = connection_.find("interval");
    if (interval == nullptr) return true;
    ParamContract contract;
    contract.unit = "s";
    contract.min = 0.0;
    contract.max = 86400.0;
    const auto seconds = read_value(*interval, contract, "interval", report_);
    if (seconds) edge_.interval = from_seconds(std::get<double>(*seconds));
    return seconds.has_value();
  }

  const Node& connection_;
  Edge& edge_;
  Report& report_;
};

}  // namespace

std::optional<Edge> make_edge(const Node& connection, const Endpoint& from, const Endpoint& to,
                              Report& report) {
  Edge edge{from.ref,           to.ref, from.port->pattern, to.port->queue, to.port->queue.min_interval,
            connection.position};
  edge.queue.min_interval = Duration{0};
  const auto reason = misfit(from, to);
  if (reason) {
    report.error(reason->code, connection.position,
                 "cannot connect " + described(from) + " to " + described(to) + ": " + reason->reason);
    if (reason->code == codes::kPattern)
      return std::nullopt;  // what the policy may be depends on the pattern
  }
  const bool policy_ok = PolicyReader(connection, edge, report).read();
  return reason || !policy_ok ? std::nullopt : std::optional(edge);
}

}  // namespace orca::graph
