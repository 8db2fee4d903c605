// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/lines.hpp"

#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/host/run_outputs.hpp"
#include "orca/supervisor/channel.hpp"

namespace orca::supervisor {
namespace {

constexpr std::uint64_t kLargestBound = std::uint64_t{1} << 30;  // [bytes]

// The lines that a client wants.
struct Wish {
  std::vector<std::string> ports;
  bool taps = false;
  bool objects = false;
  std::uint64_t bound = 0;
};

Status read_bound(const std::string& text, Wish& wish) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), wish.bound);
  if (error == std::errc{} && end == text.data() + text.size() && wish.bound > 0 &&
      wish.bound <= kLargestBound)
    return ok();
  return fail(Code::invalid_argument, "--bound expects a number of bytes from 1 to " +
                                          std::to_string(kLargestBound) + ", not " + in_quotes(text));
}

Result<Wish> read(const std::vector<std::string>& words) {
  Wish wish;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--tap") {
      wish.taps = true;
    } else if (words[i] == "--objects") {
      wish.objects = true;
    } else if (words[i] == "--bound") {
      if (const Status read = read_bound(++i < words.size() ? words[i] : "", wish); !read.ok())
        return read.error();
    } else {
      wish.ports.push_back(words[i]);
    }
  }
  return wish;
}

using Ports = std::vector<const graph::ListedPort*>;

// Returns the ports that can be reached, by their processes. Of several, the answer names those that there are not.
Result<std::map<std::string, Ports>> find(const Wish& wish, const SystemNames& names, Reply& reply) {
  std::map<std::string, Ports> found;
  const bool is_alone = wish.ports.size() == 1;
  for (const std::string& path : wish.ports) {
    const Result<const graph::ListedPort*> port = names.port(path);
    const Result<const graph::ComponentNode*> component =
        port ? names.component((*port)->ref.component) : Result<const graph::ComponentNode*>(port.error());
    if (!component) {
      if (is_alone) return component.error();
      reply.add(Record{{"port", path}, {"missing", component.error().message}});
    } else if (const Result<Member*> built = names.built_member_of(**component); built) {
      found[(*component)->process].push_back(*port);
    } else if (is_alone) {
      return built.error();
    }
  }
  return found;
}

Status open_line(Member& member, const Ports& ports, const Wish& wish, Conductor& conductor, Reply& reply) {
  Result<SocketPair> pair = make_socket_pair();
  if (!pair) return pair.error();
  const PortContract& first = ports.front()->contract;
  LineAnswer answer{std::move(pair->supervisor), first.type.name, first.reply ? first.reply->name : ""};
  OpenLine order{{}, wish.taps, wish.objects, wish.bound, std::move(pair->host)};
  for (const graph::ListedPort* const port : ports) {
    answer.ports.push_back(port->ref.text());
    order.ports.push_back(port->ref);
  }
  const std::optional<Answer> opened = conductor.ask(member, std::move(order));
  if (opened && !opened->outcome.ok()) return opened->outcome;
  if (opened) reply.add(std::move(answer));
  return ok();
}

// Tells who looks at a port why nothing may pass there: its component does no laps.
void note_rest(const Wish& wish, const SystemNames& names, const host::Reports& reports, Reply& reply) {
  if (!wish.taps || wish.ports.size() != 1) return;
  const Result<const graph::ListedPort*> port = names.port(wish.ports.front());
  if (!port || (*port)->contract.pattern != Pattern::push || (*port)->contract.role != Role::server) return;
  const std::string& name = (*port)->ref.component;
  const Result<const graph::ComponentNode*> node = names.component(name);
  if (!node) return;  // it runs on another machine, of which there are no reports
  const host::ComponentState state = reports(name).state;
  if (state == host::ComponentState::work || state == host::ComponentState::connect) return;
  if (state == host::ComponentState::init || (*node)->watchable) return;
  const bool is_unused = state == host::ComponentState::idle || state == host::ComponentState::unloaded;
  reply.note(name + " is " + host::to_string(state) +
             (is_unused ? ", because nobody uses it, and to look makes no component work" : "") +
             ": it does no laps, so perhaps nothing passes here");
}

}  // namespace

bool open_lines(const std::vector<std::string>& words, const SystemNames& names, const host::Reports& reports,
                Conductor& conductor, Reply& reply) {
  const Result<Wish> wish = read(words);
  if (!wish) return reply.refuse(wish.error()), false;
  note_rest(*wish, names, reports, reply);
  const Result<std::map<std::string, Ports>> found = find(*wish, names, reply);
  if (!found) return reply.refuse(found.error()), false;
  for (const auto& [process, ports] : *found) {
    // It may have ended while another one was asked.
    const Result<const graph::ComponentNode*> component = names.component(ports.front()->ref.component);
    const Result<Member*> member =
        component ? names.built_member_of(**component) : Result<Member*>(component.error());
    if (!member) continue;
    const Status opened = open_line(**member, ports, *wish, conductor, reply);
    if (opened.ok() || (wish->ports.size() > 1 && opened.error().code == Code::not_found)) continue;
    return reply.refuse(opened.error()), false;
  }
  return wish->bound > 0 && !found->empty();
}

void list_sources(const SystemNames& names, TimePoint start, Reply& reply) {
  reply.add(Record{{"start", start.time_since_epoch().count()}});
  for (const graph::ListedPort& port : names.ports())
    if (host::is_source(port.contract) && names.component(port.ref.component))
      reply.add(Record{{"port", port.ref.text()}});
}

}  // namespace orca::supervisor
