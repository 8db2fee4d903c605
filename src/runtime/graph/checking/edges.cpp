// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/wiring.hpp"

#include <algorithm>
#include <array>

#include "orca/base/layout.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"
#include "reading/codes.hpp"
#include "reading/values.hpp"

namespace orca::graph {
namespace {

// A reason why two ends do not fit. The functions below return the most basic one, or nothing if there
// is none.
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

// Returns the type itself or its ancestor of that name; null if it has none.
const TypeId* in_lineage(const TypeId& type, const std::string& name) {
  if (type.name == name) return &type;
  const auto found = std::ranges::find(type.ancestors, name, &TypeId::name);
  return found == type.ancestors.end() ? nullptr : &*found;
}

// Names the nearest type that both are, or derive from.
std::string common_type(const TypeId& given, const TypeId& wanted) {
  if (in_lineage(wanted, given.name) != nullptr)
    return given.name + ", and a " + given.name + " need not be a " + wanted.name;
  for (const TypeId& ancestor : given.ancestors)
    if (in_lineage(wanted, ancestor.name) != nullptr) return ancestor.name;
  return "OrcaObject";
}

// What travels in an object's direction: `given` goes to where `wanted` is asked for.
std::optional<Misfit> type_misfit(const TypeId& given, const TypeId& wanted, const std::string& what,
                                  const LayoutEnds& ends) {
  if (is_a(given, wanted)) return std::nullopt;
  const TypeId* const same = in_lineage(given, wanted.name);
  if (same == nullptr) {
    return Misfit{codes::kType, "the " + what + " that comes is " + given.name + ", but " + wanted.name +
                                    " is expected; their nearest common type is " +
                                    common_type(given, wanted)};
  }
  return Misfit{codes::kLayout, "both ends call the " + what + " " + wanted.name + ", but " +
                                    layout_difference(same->layout, wanted.layout, ends) +
                                    "; build both plugins against the same types"};
}

std::optional<Misfit> misfit(const Endpoint& from, const Endpoint& to) {
  if (from.port->pattern != to.port->pattern) {
    return Misfit{codes::kPattern, "the two ends must have the same pattern"};
  }
  if (auto direction = direction_misfit(from, to)) return direction;
  const bool query = from.port->pattern == Pattern::query;
  if (auto type = type_misfit(from.port->type, to.port->type, query ? "request" : "object", {})) return type;
  if (!from.port->reply || !to.port->reply) return std::nullopt;
  return type_misfit(*to.port->reply, *from.port->reply, "reply", {"at the to end", "at the from end"});
}

// Returns whether the ends would fit if they were the ports that the graph could not give these names.
bool may_be_meant_otherwise(Endpoint from, Endpoint to) {
  if (from.perhaps == nullptr && to.perhaps == nullptr) return false;
  if (from.perhaps != nullptr) from.port = from.perhaps;
  if (to.perhaps != nullptr) to.port = to.perhaps;
  return !misfit(from, to);
}

// An attribute of the policy, and where it has a meaning.
struct PolicyAttribute {
  const char* name;
  bool push;
  bool send;
};
constexpr std::array kPolicyAttributes{
    PolicyAttribute{"queue", true, true},       PolicyAttribute{"overflow", true, true},
    PolicyAttribute{"block_limit", true, true}, PolicyAttribute{"interval", true, false},
    PolicyAttribute{"deadline", true, false},   PolicyAttribute{"drop_limit", true, false},
    PolicyAttribute{"confirm", false, true}};

// A reader for the policy of an edge.
class PolicyReader {
 public:
  PolicyReader(const Node& connection, const Endpoint& from, Edge& edge, Report& report)
      : connection_(connection), from_(from), edge_(edge), report_(report) {}

  // Returns false after a report.
  bool read() {
    if (!check_pattern()) return false;
    bool good = read_depth();
    good = read_overflow() && good;
    good = read_time("interval", edge_.interval) && good;
    good = read_time("deadline", edge_.queue.deadline) && good;
    good = check_deadline() && good;
    good = read_drop_limit() && good;
    good = read_confirm() && good;
    return read_time("block_limit", edge_.queue.block_limit) && good;
  }

 private:
  bool check_pattern() {
    bool fits = true;
    for (const PolicyAttribute& attribute : kPolicyAttributes) {
      const bool push = edge_.pattern == Pattern::push;
      if (push ? attribute.push : edge_.pattern == Pattern::send && attribute.send) continue;
      if (connection_.find(attribute.name) == nullptr) continue;
      fits = refuse(attribute.name, std::string(attribute.name) + " has no meaning for a " +
                                        to_string(edge_.pattern) + " connection; remove it");
    }
    return fits;
  }

  bool read_depth() {
    const Text* queue = connection_.find("queue");
    if (queue == nullptr) return true;
    if (edge_.pattern == Pattern::push && queue->known && xml::trimmed(queue->value) == "latest") {
      edge_.queue.depth = 1;
      edge_.queue.overflow = QueuePolicy::Overflow::drop_oldest;
      return true;
    }
    const char* const latest = edge_.pattern == Pattern::push ? "\"latest\" or " : "";
    const auto depth = read_value(*queue, rule_of("queue"),
                                  std::string("queue (") + latest + "a number of objects)", report_);
    if (depth) edge_.queue.depth = static_cast<std::uint32_t>(std::get<std::int64_t>(*depth));
    return depth.has_value();
  }

  bool read_overflow() {
    if (const Text* overflow = connection_.find("overflow")) {
      std::vector<std::string_view> names;
      for (const QueuePolicy::Overflow choice : choices()) names.emplace_back(to_string(choice));
      const auto read = read_value(*overflow, xml::ValueRule{.choices = names}, "overflow", report_);
      if (!read) return false;
      for (const QueuePolicy::Overflow choice : choices())
        if (std::get<std::string>(*read) == to_string(choice)) edge_.queue.overflow = choice;
    }
    return check_block();
  }

  // An object that a SendServer has accepted is never dropped.
  [[nodiscard]] std::vector<QueuePolicy::Overflow> choices() const {
    using Overflow = QueuePolicy::Overflow;
    if (edge_.pattern == Pattern::send) return {Overflow::refuse, Overflow::block};
    return {Overflow::drop_oldest, Overflow::drop_newest, Overflow::block};
  }

  bool check_block() {
    if (edge_.queue.overflow != QueuePolicy::Overflow::block) {
      return connection_.find("block_limit") == nullptr ||
             refuse("block_limit", "block_limit has a meaning only with overflow=\"block\"; remove it");
    }
    const Text* queue = connection_.find("queue");
    if (queue != nullptr && xml::trimmed(queue->value) == "latest")
      return refuse("overflow",
                    "overflow: \"block\" and queue=\"latest\" exclude each other; give queue a number");
    if (!from_.port->from_device) return true;
    return refuse("overflow",
                  "overflow: \"block\" is not possible, because a device pushes at " +
                      in_quotes(edge_.from.text()) +
                      " and waits for nobody; take drop_oldest or drop_newest and a longer queue");
  }

  bool check_deadline() {
    if (edge_.queue.deadline == Duration{0} || edge_.queue.deadline >= edge_.interval) return true;
    return refuse("deadline",
                  "deadline: it is shorter than the interval and could never be kept; make it longer, "
                  "0 for none");
  }

  // Also fills in the limit that holds without the attribute.
  bool read_drop_limit() {
    const Text* text = connection_.find("drop_limit");
    if (text == nullptr) {
      if (edge_.pattern == Pattern::push) edge_.queue.drop_limit = edge_.queue.accepted_drops();
      return true;
    }
    if (text->known && xml::trimmed(text->value) == "any") {
      edge_.queue.drop_limit = QueuePolicy::kAnyDrops;
      return true;
    }
    const auto limit =
        read_value(*text, rule_of("drop_limit"), "drop_limit (\"any\" or a number of objects)", report_);
    if (limit) edge_.queue.drop_limit = static_cast<std::uint32_t>(std::get<std::int64_t>(*limit));
    return limit.has_value();
  }

  bool read_confirm() {
    const Text* text = connection_.find("confirm");
    if (text == nullptr) return true;
    const auto confirm = read_value(*text, rule_of("confirm"), "confirm", report_);
    using Confirm = QueuePolicy::Confirm;
    const bool handled = confirm && std::get<std::string>(*confirm) == to_string(Confirm::handled);
    if (confirm) edge_.queue.confirm = handled ? Confirm::handled : Confirm::accepted;
    return confirm.has_value();
  }

  [[nodiscard]] const xml::ValueRule& rule_of(const char* attribute) const {
    return connection_.rule->attribute(attribute)->value;
  }

  bool read_time(const char* attribute, Duration& time) {
    const Text* text = connection_.find(attribute);
    if (text == nullptr) return true;
    const auto seconds = read_value(*text, rule_of(attribute), attribute, report_);
    if (seconds) time = from_seconds(std::get<double>(*seconds));
    return seconds.has_value();
  }

  bool refuse(const char* attribute, const std::string& why) {
    report_.error(codes::kPolicy, connection_.place(attribute), why);
    return false;
  }

  const Node& connection_;
  const Endpoint& from_;
  Edge& edge_;
  Report& report_;
};

}  // namespace

std::optional<Edge> make_edge(const Node& connection, const Endpoint& from, const Endpoint& to,
                              Report& report) {
  Edge edge{from.ref,           to.ref, from.port->pattern, to.port->queue, to.port->queue.min_interval,
            connection.position};
  edge.queue.min_interval = Duration{0};
  if (edge.pattern != Pattern::push && edge.queue.overflow != QueuePolicy::Overflow::block)
    edge.queue.overflow = QueuePolicy::Overflow::refuse;
  const auto reason = misfit(from, to);
  if (reason && may_be_meant_otherwise(from, to)) return std::nullopt;
  if (reason) {
    report.error(reason->code, connection.position,
                 "cannot connect " + described(from) + " to " + described(to) + ": " + reason->reason);
    if (reason->code == codes::kPattern)
      return std::nullopt;  // the choice of policies depends on the pattern
  }
  const bool policy_ok = PolicyReader(connection, from, edge, report).read();
  return reason || !policy_ok ? std::nullopt : std::optional(edge);
}

}  // namespace orca::graph
