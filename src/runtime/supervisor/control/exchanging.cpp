// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/exchanging.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "control/driver_exchange.hpp"
#include "orca/base/log.hpp"
#include "orca/base/time.hpp"
#include "orca/plugin/image.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kLongestTryout = 60s;
constexpr Duration kTryoutOfRebuilt = 300ms;  // whoever has just built it waits for it

// A file may hold a colon in the names of its folders.
void split_plugin(const std::string& word, SwapWish& wish) {
  const std::size_t colon = word.rfind(':');
  const bool has_type = colon != std::string::npos && word.find('/', colon) == std::string::npos;
  wish.file = has_type ? word.substr(0, colon) : word;
  if (has_type) wish.type = word.substr(colon + 1);
}

Status read_setting(const std::string& word, SwapWish& wish) {
  const std::size_t sign = word.find('=');
  if (sign == std::string::npos || sign == 0)
    return fail(Code::invalid_argument, "\"" + word + "\" is no setting; write PARAM=VALUE");
  wish.params[word.substr(0, sign)] = word.substr(sign + 1);
  return ok();
}

// Reads an option with its value.
Status read_option(const std::string& option, const std::string& text, SwapWish& wish) {
  if (option == "--set") return read_setting(text, wish);
  const Result<Duration> read = xml::parse_duration(text);
  if (!read) return read.error();
  if (option == "--tryout" && *read > kLongestTryout)
    return fail(Code::invalid_argument, "--tryout can be 60 s at most, not " + text);
  (option == "--tryout" ? wish.tryout : wish.probation) = *read;
  return ok();
}

// Takes an option without a value, if it is one.
bool take_flag(const std::string& option, SwapWish& wish) {
  if (option == "--untried") return wish.untried = true;
  if (option == "--fresh") return wish.fresh = true;
  return false;
}

Result<SwapWish> read_wish(const std::vector<std::string>& words) {
  SwapWish wish;
  std::vector<std::string> plain;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (!words[i].starts_with("--")) {
      plain.push_back(words[i]);
      continue;
    }
    const std::string& option = words[i];
    if (take_flag(option, wish)) continue;
    if (Status read = read_option(option, i + 1 < words.size() ? words[++i] : "", wish); !read.ok())
      return read.error();
  }
  if (plain.size() != 2)
    return fail(Code::invalid_argument, "name a component and a plugin: COMPONENT PLUGIN.so[:TYPE]");
  wish.component = plain[0];
  split_plugin(plain[1], wish);
  return wish;
}

// Asks a component's process to tell what reaches the component.
std::vector<WatchedPort> watch(const graph::Graph& graph, const std::string& component, Member& member) {
  std::set<std::string> ports;
  for (const graph::Edge& edge : graph.edges)
    if (edge.to.component == component) ports.insert(edge.to.port);
  std::vector<WatchedPort> watched;
  for (const std::string& port : ports) {
    Result<SocketPair> pair = make_socket_pair();
    if (!pair) continue;  // then the new code is tried with less
    member.tell(OpenLine{component, port, true, true, std::move(pair->host)});
    watched.push_back({port, std::move(pair->supervisor)});
  }
  return watched;
}

std::string counted(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

}  // namespace

// An exchange that has been begun. Whoever has ordered it is told of its end once, even if the process that carries it out
// ends before it has answered.
class Exchanging::Pending {
 public:
  Pending(std::string component, std::shared_ptr<std::set<std::string>> busy, Told told)
      : component_(std::move(component)), busy_(std::move(busy)), told_(std::move(told)) {
    busy_->insert(component_);
  }
  ~Pending() {
    end(Result<Record>(fail(
        Code::unavailable,
        "its process ended before the exchange was done; it begins with the code of the graph", component_)));
  }
  Pending(const Pending&) = delete;
  Pending& operator=(const Pending&) = delete;

  // Whoever is told may begin another exchange of the component at once.
  void end(const Result<Record>& outcome) {
    if (!told_) return;
    busy_->erase(component_);
    std::exchange(told_, {})(outcome);
  }
  /// @param answer  of the process that carries it out, with one record.
  void end(const Answer& answer) {
    if (!answer.outcome.ok()) return end(Result<Record>(answer.outcome.error()));
    for (const Record& record : answer.records) end(Result<Record>(record));
  }

 private:
  const std::string component_;
  const std::shared_ptr<std::set<std::string>> busy_;
  Told told_;
};

const PluginFacts& Exchanging::plugin_of(const std::string& type) const {
  static const PluginFacts unknown;
  const auto found = facts_.plugins.find(type);
  return found == facts_.plugins.end() ? unknown : found->second;
}

CodeFacts Exchanging::code_of(const std::string& name, const std::string& type,
                              const std::string& process) const {
  const auto exchanged = exchanged_.find(name);
  if (exchanged != exchanged_.end()) return exchanged->second;
  CodeFacts code{type, plugin_of(type)};
  // A process that was started again may have found another build in the file than the check of the graph.
  if (const auto built = builds_.find(process); built != builds_.end())
    if (const auto build = built->second.find(type); build != built->second.end())
      code.plugin.build_id = build->second;
  return code;
}

void Exchanging::swap(const std::vector<std::string>& words, const ReplyPtr& reply) {
  Result<SwapWish> wish = read_wish(words);
  if (!wish) return reply->refuse(wish.error());
  exchange(std::move(wish).value(),
           [this, reply, name = wish->component, params = wish->params](const Result<Record>& done) {
             if (!done) return reply->refuse(done.error());
             operating_.note_set(name, params);
             reply->add(*done);
           });
}

void Exchanging::take_rebuilt(const std::string& file) {
  for (const graph::ComponentNode& node : graph_.components) {
    if (code_of(node).plugin.file != file) continue;
    if (node.hardware.empty()) {
      rebuilt_.insert(node.name);
    } else {
      log::warning(node.name, "its code was built anew, but it serves hardware: orcactl restart " +
                                  node.name + " lets it run");
    }
  }
}

void Exchanging::swap_rebuilt(const graph::ComponentNode& node) {
  const CodeFacts code = code_of(node);
  exchange({node.name, code.plugin.file, code.type, {}, kTryoutOfRebuilt},
           [name = node.name](const Result<Record>& done) {
             if (done) return log::info(name, "runs the code that was built anew");
             log::error(name, "the code that was built anew does not run, and the old one goes on: " +
                                  done.error().text());
           });
}

std::set<std::string> Exchanging::plugin_files() const {
  std::set<std::string> files;
  for (const graph::ComponentNode& node : graph_.components) files.insert(code_of(node).plugin.file);
  return files;
}

bool Exchanging::is_busy(const std::string& component) const { return busy_->contains(component); }

void Exchanging::exchange(SwapWish wish, Told told) {
  if (is_busy(wish.component))
    return told(fail(Code::unavailable, "another exchange of it is under way; try again when that is done",
                     wish.component));
  const auto pending = std::make_shared<Pending>(wish.component, busy_, std::move(told));
  const graph::HardwareNode* const hardware = graph_.find_hardware(wish.component);
  if (hardware != nullptr && graph_.find_component(wish.component) == nullptr)
    return begin_driver(wish, *hardware, pending);
  const Result<const graph::ComponentNode*> node = names_.component(wish.component);
  if (!node) return pending->end(node.error());
  const Result<Member*> member = names_.ready_member_of(**node);
  if (!member) return pending->end(member.error());
  Result<plugin::PluginImage> image = plugin::PluginImage::copy(wish.file);
  if (!image) return pending->end(image.error());
  log::info(wish.component, "its code is to be exchanged for " + image->origin());
  host::ShadowOrder order{graph_,
                          wish.component,
                          wish.type.empty() ? code_of(**node).type : wish.type,
                          ports_of(wish.component),
                          operating_.params_of(**node),
                          wish.params,
                          wish.tryout};
  if (wish.has_worked) return order_swap(order, std::move(image).value(), wish, true, pending);
  std::vector<WatchedPort> ports;
  if (wish.tryout > Duration{0}) ports = watch(graph_, wish.component, **member);
  Tryout::Lines lines{std::move(ports), lines_to_servers_of(wish.component)};
  open_.push_back(
      {std::make_unique<Tryout>(std::move(order), std::move(image).value(), std::move(lines), wake_),
       std::move(wish), pending});
}

std::vector<ServerLine> Exchanging::lines_to_servers_of(const std::string& component) const {
  std::vector<ServerLine> lines;
  for (const graph::Edge& edge : graph_.edges) {
    if (edge.pattern != Pattern::query || edge.from.component != component) continue;
    const Result<const graph::ComponentNode*> server = names_.component(edge.to.component);
    if (!server) continue;
    const Result<Member*> member = names_.ready_member_of(**server);
    Result<SocketPair> pair = make_socket_pair();
    if (!member || !pair) continue;  // then it gets no answers
    (*member)->tell(OpenLine{edge.to.component, edge.to.port, false, false, std::move(pair->host)});
    lines.push_back({edge.to, std::move(pair->supervisor)});
  }
  return lines;
}

std::vector<PortContract> Exchanging::ports_of(const std::string& component) const {
  std::vector<PortContract> ports;
  for (const graph::ListedPort& port : facts_.ports) {
    if (port.ref.component != component) continue;
    ports.push_back(port.contract);
    ports.back().name = port.ref.port;
  }
  return ports;
}

void Exchanging::begin_driver(const SwapWish& wish, const graph::HardwareNode& hardware,
                              const PendingPtr& pending) {
  const Status ordered = order_driver_exchange(wish, hardware, names_,
                                               [pending](const Answer& answer) { pending->end(answer); });
  if (!ordered.ok()) pending->end(ordered.error());
}

void Exchanging::go_on() {
  for (Open& open : std::exchange(open_, {})) {  // whoever is told of an end may begin another exchange
    if (open.tryout->is_done()) {
      go_on(open);
    } else {
      open_.push_back(std::move(open));
    }
  }
  for (const graph::ComponentNode& node : graph_.components)
    if (rebuilt_.contains(node.name) && !is_busy(node.name)) {
      rebuilt_.erase(node.name);
      swap_rebuilt(node);
    }
}

void Exchanging::go_on(Open& open) {
  const std::string& component = open.tryout->order().component;
  const Result<host::ShadowReport>& tried = open.tryout->outcome();
  if (tried) return exchange(open, *tried);
  open.pending->end(
      fail(tried.error().code,
           "the new one was tried out beside the one that runs, and not taken: " + tried.error().text(),
           component));
}

void Exchanging::exchange(Open& open, const host::ShadowReport& tried) {
  const host::ShadowOrder& order = open.tryout->order();
  const std::string& component = order.component;
  if (tried.untried.empty()) {
    log::info(component, "the new code was tried out: it got " + counted(tried.given, "object") +
                             " and pushed " + std::to_string(tried.pushed));
  } else if (open.wish.untried || !host::kTriesCode) {
    log::warning(component, "the new code could not be tried out: " + tried.untried);
  } else {
    return open.pending->end(fail(Code::failed_precondition,
                                  "the new one cannot be tried out, and is not taken: " + tried.untried +
                                      "; with --untried it is taken all the same, and if it crashes or hangs "
                                      "then, its process ends and begins anew",
                                  component));
  }
  order_swap(order, open.tryout->take_plugin(), open.wish, tried.untried.empty(), open.pending);
}

void Exchanging::order_swap(const host::ShadowOrder& order, plugin::PluginImage plugin, const SwapWish& wish,
                            bool was_tried, const PendingPtr& pending) const {
  const Result<const graph::ComponentNode*> node = names_.component(order.component);
  if (!node) return pending->end(node.error());  // it has gone meanwhile
  const Result<Member*> member = names_.ready_member_of(**node);
  if (!member) return pending->end(member.error());
  const std::string file = plugin.origin();
  SwapCode swap{order.component,
                order.type,
                {order.new_params.begin(), order.new_params.end()},
                static_cast<std::uint64_t>(wish.probation.count()),
                file,
                std::move(plugin).take_bytes(),
                was_tried,
                wish.fresh};
  (*member)->ask_for(std::move(swap), [pending](const Answer& answer) { pending->end(answer); });
}

void Exchanging::note(const ExchangedCode& code) {
  exchanged_[code.component] = {code.type, {code.file, code.build_id}, code.swaps};
}

void Exchanging::note(const Built& built, const std::string& process) {
  builds_[process] = {built.builds.begin(), built.builds.end()};
}

void Exchanging::came_up(const std::vector<Member*>& members) {
  for (const Member* const member : members) {
    for (const graph::ComponentNode& node : graph_.components)
      if (node.process == member->name()) forget_exchange(node.name, node.type);
    for (const graph::HardwareNode& node : graph_.hardware)
      if (node.process == member->name()) forget_exchange(node.name, node.type);
  }
}

void Exchanging::forget_exchange(const std::string& name, const std::string& type) {
  const auto exchanged = exchanged_.extract(name);
  if (exchanged.empty() || exchanged.mapped().plugin.file == plugin_of(type).file) return;
  log::warning(name,
               "its process was started again, with the code that the graph names; the code that had "
               "been put in its place is not there any more");
}

}  // namespace orca::supervisor
