// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/exchanging.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "orca/base/log.hpp"
#include "orca/base/time.hpp"
#include "orca/host/fitting.hpp"
#include "orca/plugin/image.hpp"
#include "orca/xml/quantity.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kLongestTryout = 60s;
constexpr Duration kLongWait = 10s;           // for the end of another exchange
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

Status read_time(const std::string& option, const std::string& text, Care& care) {
  const Result<Duration> read = xml::parse_duration(text);
  if (!read) return read.error();
  if (option == "--tryout" && *read > kLongestTryout)
    return fail(Code::invalid_argument, "--tryout can be 60 s at most, not " + text);
  (option == "--tryout" ? care.tryout : care.probation) = *read;
  return ok();
}

// Reads an option with its value.
Status read_option(const std::string& option, const std::string& text, SwapWish& wish) {
  return option == "--set" ? read_setting(text, wish) : read_time(option, text, wish.care);
}

// Takes an option without a value, if it is one.
bool take_flag(const std::string& option, SwapWish& wish) {
  if (option == "--untried") return wish.care.untried = true;
  if (option == "--fresh") return wish.fresh = true;
  if (option == "--only-try") return wish.only_tries = true;
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
    member.tell(OpenLine{{{component, port}}, true, true, 0, std::move(pair->host)});
    watched.push_back({port, std::move(pair->supervisor)});
  }
  return watched;
}

std::string counted(std::uint64_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

Status check_exchangeable(const graph::ComponentNode& node) {
  if (node.hardware.empty()) return ok();
  return fail(Code::failed_precondition,
              "it serves hardware, and cannot be exchanged while that runs; orcactl swap " + node.hardware +
                  " exchanges the driver",
              node.name);
}

}  // namespace

// Keeps a component from being exchanged twice at a time.
class Exchanging::Busy {
 public:
  Busy(std::map<std::string, Underway>& all, const SwapWish& wish) : all_(all), component_(wish.component) {
    all_[component_] = {wish.file, wish.care.probation, std::nullopt};
  }
  ~Busy() { all_.erase(component_); }
  Busy(const Busy&) = delete;
  Busy& operator=(const Busy&) = delete;

 private:
  std::map<std::string, Underway>& all_;
  const std::string component_;
};

Result<Care> read_care(const std::vector<std::string>& words) {
  Care care;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--untried") care.untried = true;
    if (words[i] != "--tryout" && words[i] != "--probation") continue;
    const std::string& option = words[i];
    if (Status read = read_time(option, i + 1 < words.size() ? words[++i] : "", care); !read.ok())
      return read.error();
  }
  return care;
}

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
  const Result<Record> done = exchange(*wish);
  if (!done) return reply->refuse(done.error());
  reply->add(*done);
}

void Exchanging::show_fitting(const std::string& component, const ReplyPtr& reply) {
  const Result<const graph::ComponentNode*> node = names_.component(component);
  if (!node) return reply->refuse(node.error());
  if (const Status may = check_exchangeable(**node); !may.ok()) return reply->refuse(may.error());
  const graph::Graph graph = names_.surroundings_of(component);  // both may change meanwhile
  const std::vector<PortContract> ports = ports_of(component);
  const plugin::PluginIndex index(facts_.plugin_folders);
  Result<std::vector<host::OfferedCode>> offers = std::vector<host::OfferedCode>{};
  conductor_.run_aside("fitting", [&](const std::function<bool()>& give_up) {
    offers = host::compare_offers(graph, component, ports, index, give_up);
  });
  if (!offers) return reply->refuse(offers.error());
  for (const host::OfferedCode& code : *offers) {
    if (code.misfit.empty()) reply->add(Record{{"type", code.type}, {"plugin", code.file}});
    if (code.is_broken) reply->note(code.file + " could not be looked at: " + code.misfit);
  }
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

void Exchanging::swap_rebuilt(const SwapWish& wish) {
  const Result<Record> done = exchange(wish);
  if (done) return log::info(wish.component, "runs the code that was built anew");
  const Result<const graph::ComponentNode*> node = names_.component(wish.component);
  const bool goes_on = node && names_.ready_member_of(**node);
  log::error(wish.component, std::string("the code that was built anew does not run") +
                                 (goes_on ? ", and the old one goes on: " : ": ") + done.error().text());
  if (!goes_on && node && plugin_of((*node)->type).file == wish.file)
    log::error(wish.component,
               "the graph names the file that was built anew, so its process begins with it again; build one "
               "that runs");
}

std::set<std::string> Exchanging::plugin_files() const {
  std::set<std::string> files;
  for (const graph::ComponentNode& node : graph_.components) files.insert(code_of(node).plugin.file);
  return files;
}

Result<Record> Exchanging::exchange(const SwapWish& wish) {
  if (is_busy(wish.component)) return busy_with(wish.component);
  const Busy busy(busy_, wish);
  const graph::HardwareNode* const hardware = graph_.find_hardware(wish.component);
  const bool is_driver = hardware != nullptr && graph_.find_component(wish.component) == nullptr;
  if (is_driver && wish.only_tries)
    return fail(Code::failed_precondition, "a driver is not tried out", wish.component);
  if (wish.only_tries) return only_try(wish);
  return is_driver ? exchange_driver(wish, *hardware) : exchange_component(wish);
}

// Whoever would have to wait for long hears for how long, and what else can be done.
Error Exchanging::busy_with(const std::string& component) const {
  const Underway& other = busy_.at(component);
  const auto left = [&] { return other.probation - Duration(Moment::clock::now() - *other.ordered); };
  if (!other.ordered || left() < kLongWait)
    return fail(Code::unavailable, "another exchange of it is under way; try again when that is done",
                component);
  return fail(Code::unavailable,
              "another exchange of it is under way: " + other.file + " is on probation for another " +
                  std::to_string(left() / 1s) + " s; try again then. orcactl restart " + component +
                  " ends that at once: its process begins anew, with the code of the graph",
              component);
}

Result<Record> Exchanging::exchange_component(const SwapWish& wish) {
  const auto find = [&] { return names_.component(wish.component); };
  Result<const graph::ComponentNode*> node = find();
  if (!node) return node.error();
  if (Status may = check_exchangeable(**node); !may.ok()) return may.error();
  Result<Member*> member = names_.ready_member_of(**node);
  if (!member) return member.error();
  Result<plugin::PluginImage> image = plugin::PluginImage::copy(wish.file);
  if (!image) return image.error();
  log::info(wish.component, "its code is to be exchanged for " + image->origin());
  const host::ShadowOrder order = trial_of(wish, **node);
  bool was_tried = wish.has_worked;
  if (!wish.has_worked) {
    const Result<host::ShadowReport> tried = try_out(wish, order, **member, *image);
    if (!tried) return tried.error();
    was_tried = tried->untried.empty();
  }
  node = find();
  if (!node) return node.error();  // it has gone meanwhile
  member = names_.ready_member_of(**node);
  if (!member) return member.error();
  const std::string file = image->origin();
  busy_.at(wish.component).ordered = Moment::clock::now();
  return order_swap(**member, {order.component,
                               order.type,
                               {order.new_params.begin(), order.new_params.end()},
                               static_cast<std::uint64_t>(wish.care.probation.count()),
                               file,
                               std::move(*image).take_bytes(),
                               was_tried,
                               wish.fresh});
}

host::ShadowOrder Exchanging::trial_of(const SwapWish& wish, const graph::ComponentNode& node) const {
  return {wish.changed != nullptr ? *wish.changed : names_.surroundings_of(wish.component),
          wish.component,
          wish.type.empty() ? code_of(node).type : wish.type,
          ports_of(wish.component),
          operating_.params_of(node),
          wish.params,
          wish.care.tryout};
}

Result<Record> Exchanging::only_try(const SwapWish& wish) {
  const Result<const graph::ComponentNode*> node = names_.component(wish.component);
  if (!node) return node.error();
  if (Status may = check_exchangeable(**node); !may.ok()) return may.error();
  const Result<Member*> member = names_.ready_member_of(**node);
  if (!member) return member.error();
  Result<plugin::PluginImage> image = plugin::PluginImage::copy(wish.file);
  if (!image) return image.error();
  const host::ShadowOrder order = trial_of(wish, **node);
  const Result<host::ShadowReport> tried = try_out(wish, order, **member, *image);
  if (!tried) return tried.error();
  return Record{{"type", order.type},
                {"plugin", image->origin()},
                {"got", tried->given},
                {"pushed", tried->pushed},
                {"untried", tried->untried}};
}

// A new driver is not tried out in a shadow: the process tries the plugin as it does each time it loads one.
Result<Record> Exchanging::exchange_driver(const SwapWish& wish, const graph::HardwareNode& hardware) {
  const Result<Member*> member = names_.ready_member_of(hardware);
  if (!member) return member.error();
  Result<plugin::PluginImage> image = plugin::PluginImage::copy(wish.file);
  if (!image) return image.error();
  const std::string file = image->origin();
  log::info(hardware.name, "its driver is to be exchanged for " + file);
  return order_swap(**member, {hardware.name,
                               wish.type,
                               {wish.params.begin(), wish.params.end()},
                               0,
                               file,
                               std::move(*image).take_bytes(),
                               false,
                               false});
}

// If the code could not be tried out, the wish takes it all the same.
Result<host::ShadowReport> Exchanging::try_out(const SwapWish& wish, const host::ShadowOrder& order,
                                               Member& member, plugin::PluginImage& image) {
  std::vector<WatchedPort> ports;
  if (wish.care.tryout > Duration{0}) ports = watch(order.graph, wish.component, member);
  TryoutLines lines{std::move(ports), lines_to_servers_of(wish.component)};
  Result<host::ShadowReport> tried = host::ShadowReport{};
  conductor_.run_aside("tryout", [&](const std::function<bool()>& give_up) {
    tried = supervisor::try_out(order, image, std::move(lines), give_up);
  });
  if (!tried)
    return fail(tried.error().code,
                "the new one was tried out beside the one that runs, and not taken: " + tried.error().text(),
                wish.component);
  if (tried->untried.empty()) {
    log::info(wish.component, "the new code was tried out: it got " + counted(tried->given, "object") +
                                  " and pushed " + std::to_string(tried->pushed));
  } else if (wish.care.untried || !host::kTriesCode) {
    log::warning(wish.component, "the new code could not be tried out: " + tried->untried);
  } else {
    return fail(Code::failed_precondition,
                "the new one cannot be tried out, and is not taken: " + tried->untried +
                    "; with --untried it is taken all the same, and if it crashes or hangs then, its process "
                    "ends and begins anew",
                wish.component);
  }
  return tried;
}

Result<Record> Exchanging::order_swap(Member& member, SwapCode swap) {
  const std::string component = swap.component;
  const std::optional<Answer> answer = conductor_.ask(member, std::move(swap));
  if (answer && !answer->outcome.ok()) return answer->outcome.error();
  if (answer && !answer->records.empty()) return answer->records.front();
  return fail(Code::unavailable,
              "its process ended before the exchange was done; it begins with the code of the graph",
              component);
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
    (*member)->tell(OpenLine{{edge.to}, false, false, 0, std::move(pair->host)});
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

void Exchanging::go_on() {
  for (const graph::ComponentNode& node : graph_.components) {
    if (!rebuilt_.contains(node.name) || is_busy(node.name)) continue;
    rebuilt_.erase(node.name);
    const CodeFacts code = code_of(node);
    const SwapWish wish{node.name, code.plugin.file, code.type, {}, kTryoutOfRebuilt};
    conductor_.begin("swap " + node.name, [this, wish] { swap_rebuilt(wish); });
  }
}

void Exchanging::note(const ExchangedCode& code) {
  exchanged_[code.component] = {code.type, {code.file, code.build_id}, code.swaps};
  operating_.present().note(code);
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
