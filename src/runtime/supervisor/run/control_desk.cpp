// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control_desk.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <exception>
#include <set>
#include <utility>

#include "control/alarm_desk.hpp"
#include "control/lines.hpp"
#include "control/order_rules.hpp"
#include "control/pacing.hpp"
#include "orca/base/text.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kSocketLook = 1s;  // until the next look at the socket's file
// What these show is that of this machine.
const std::set<std::string, std::less<>> kOfThisMachine{"ps",     "plugins",  "counters",
                                                        "alarms", "missions", "log"};

// These wait for the system, so each is a job of its own.
const std::set<std::string, std::less<>> kJobs{"suspend", "resume",  "swap",       "fits", "diff",
                                               "apply",   "connect", "disconnect", "move", "set",
                                               "restart", "line",    "step"};

// Returns whether an option is among the words.
bool has(const Ask& ask, std::string_view option) {
  return std::ranges::find(ask.words, option) != ask.words.end();
}

// Returns a word after the command; "" if there are not so many.
std::string word(const Ask& ask, std::size_t at) { return at < ask.words.size() ? ask.words[at] : ""; }

void show_file(const std::string& file, Reply& reply) { reply.add(Record{{"file", file}}); }

// Reads the words after "log": "--follow", "--level", a level, and names.
Result<LogWish> read_log_wish(const std::vector<std::string>& words) {
  LogWish wish;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == "--follow") {
      wish.follows = true;
    } else if (words[i] == "--level") {
      const Result<log::Level> level = log::parse_level(i + 1 < words.size() ? words[i + 1] : "");
      if (!level) return level.error();
      wish.level = *level;
      ++i;
    } else {
      wish.who.push_back(words[i]);
    }
  }
  return wish;
}

void show_names(const Showing& showing, const PresentParams& params, Reply& reply) {
  showing.names(reply);
  params.add_names(reply);
}

}  // namespace

ControlDesk::ControlDesk(Conductor& conductor, const graph::Graph& whole, const graph::Graph& here,
                         const SystemFacts& facts, const Members& members, Ledger& ledger, Starter& starter,
                         Renewal& renewal, const DeskLevers& levers, Applying::Levers applying)
    : conductor_(conductor),
      ledger_(ledger),
      names_(whole, here, facts.ports, members),
      operating_(conductor, here, facts, names_, ledger.reports(), levers.run),
      peers_(conductor, here, names_, operating_, ledger.reports()),
      exchanging_(conductor, here, facts, names_, operating_),
      applying_({conductor, here, facts, members, operating_, exchanging_, starter, renewal, ledger},
                std::move(applying)),
      showing_(whole, here, facts, members, ledger, exchanging_, levers.edges_in_use),
      motors_(members, ledger) {}

void ControlDesk::open(Result<ControlSocket> socket, SharedSocket others) {
  doors_.open(std::move(others));
  if (!socket) return log::warning(kLogName, "orcactl cannot reach this system: " + socket.error().text());
  doors_.open(std::move(socket).value());
}

void ControlDesk::recall(const Standing& standing) {
  if (standing.motors_held) hold_.recall();
  operating_.recall(standing.params);
}

void ControlDesk::pause_components(const std::string& name, bool suspends, const ReplyPtr& reply) {
  peers_.overrule(name);
  suspends ? operating_.suspend(name, reply) : operating_.resume(name, reply);
}

void ControlDesk::add_to(std::vector<pollfd>& all) const { doors_.add_to(all); }

void ControlDesk::serve(Moment now) {
  doors_.serve(now);
  if (now - socket_seen_ >= kSocketLook) look_after_socket(now);
  if (watch_) look_at_files(now);
  exchanging_.go_on();
  applying_.go_on();
  peers_.go_on();
  log_.pass_on();
}

// Whoever cleans up folders may have removed it, and with it the emergency stop.
void ControlDesk::look_after_socket(Moment now) {
  socket_seen_ = now;
  const std::optional<Result<bool>> looked = doors_.restore();
  if (!looked) return;
  const Result<bool>& restored = *looked;
  if (!restored && !ledger_.is_active(idl::CONTROL_LOST, ""))
    ledger_.raise(
        idl::CONTROL_LOST, "",
        "neither orcactl nor its emergency stop can reach this system, because its socket was removed: " +
            restored.error().message);
  if (!restored) return;
  if (*restored) log::warning(kLogName, "somebody has removed the socket of this system; it is made again");
  ledger_.settle(idl::CONTROL_LOST, "", "orcactl reaches this system again");
}

void ControlDesk::watch(std::vector<std::string> graph_files) {
  watch_.emplace();
  graph_files_ = std::move(graph_files);
}

void ControlDesk::look_at_files(Moment now) {
  std::set<std::string> files = exchanging_.plugin_files();
  files.insert(graph_files_.begin(), graph_files_.end());
  for (const std::string& file : watch_->changed(files, now)) {
    const bool is_graph = std::ranges::find(graph_files_, file) != graph_files_.end();
    is_graph ? applying_.take_saved(graph_files_.front()) : exchanging_.take_rebuilt(file);
  }
}

void ControlDesk::built(const std::vector<Member*>& members) {
  for (Member* const member : members) {
    member->note_built();
    motors_.take_in(*member);
  }
}

void ControlDesk::came_up(const std::vector<Member*>& members) {
  applying_.came_up(members);
  exchanging_.came_up(members);
  operating_.came_up(members);
}

const ControlDesk::Handlers& ControlDesk::handlers() {
  static const Handlers all{
      {"ps",
       [](ControlDesk& d, const Ask&, const ReplyPtr& r) { d.showing_.components(*r, d.log_.rates()); }},
      {"graph",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) {
         has(ask, "--running") ? d.applying_.show_present(*r) : d.showing_.graph(*r);
       }},
      {"file", [](ControlDesk& d, const Ask&, const ReplyPtr& r) { show_file(d.graph_file_, *r); }},
      {"machines", [](ControlDesk& d, const Ask&, const ReplyPtr& r) { d.showing_.machines(*r); }},
      {"team", [](ControlDesk& d, const Ask&, const ReplyPtr& r) { d.showing_.team(*r); }},
      {"ports", [](ControlDesk& d, const Ask&, const ReplyPtr& r) { d.showing_.ports(*r); }},
      {"plugins", [](ControlDesk& d, const Ask&, const ReplyPtr& r) { d.showing_.plugins(*r); }},
      {"objects", [](ControlDesk&, const Ask&, const ReplyPtr& r) { Showing::objects(*r); }},
      {"names", [](ControlDesk& d, const Ask&,
                   const ReplyPtr& r) { show_names(d.showing_, d.operating_.present(), *r); }},
      {"roles", [](ControlDesk&, const Ask& ask, const ReplyPtr& r) { show_roles(ask.words, *r); }},
      {"counters", [](ControlDesk& d, const Ask&, const ReplyPtr& r) { d.showing_.counters(r); }},
      {"alarms",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { handle_alarms(ask.words, d.ledger_, *r); }},
      {"missions", [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.show_missions(ask, *r); }},
      {"log", [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.show_log(ask, r); }},
      {"estop",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.hold_.order(!has(ask, "--release"), r); }},
      {"stop", [](ControlDesk& d, const Ask&, const ReplyPtr& r) { d.operating_.stop(r); }},
      {"restart",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.operating_.restart(word(ask, 0), r); }},
      {"suspend",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.pause_components(word(ask, 0), true, r); }},
      {"resume",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.pause_components(word(ask, 0), false, r); }},
      {"swap", [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.exchanging_.swap(ask.words, r); }},
      {"fits", [](ControlDesk& d, const Ask& ask,
                  const ReplyPtr& r) { d.exchanging_.show_fitting(word(ask, 0), r); }},
      {"diff",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.applying_.compare(word(ask, 0), r); }},
      {"apply", [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.applying_.apply(ask.words, r); }},
      {"connect",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.rewire(ask, r, &Applying::connect); }},
      {"disconnect",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.rewire(ask, r, &Applying::disconnect); }},
      {"move", [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.rewire(ask, r, &Applying::move); }},
      {"get", [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.operating_.get(word(ask, 0), r); }},
      {"set", [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) { d.operating_.set(ask.words, r); }},
      {"pace", [](ControlDesk& d, const Ask& ask,
                  const ReplyPtr& r) { set_pace(ask.words, d.operating_.pace(), *r); }},
      {"pause", [](ControlDesk& d, const Ask&, const ReplyPtr& r) { pause(d.operating_.pace(), *r); }},
      {"step", [](ControlDesk& d, const Ask& ask,
                  const ReplyPtr& r) { step(ask.words, d.operating_.pace(), d.conductor_, *r); }},
      {"sources",
       [](ControlDesk& d, const Ask&, const ReplyPtr& r) { list_sources(d.names_, d.ledger_.start(), *r); }},
      {"line",
       [](ControlDesk& d, const Ask& ask, const ReplyPtr& r) {
         if (open_lines(ask.words, d.names_, d.ledger_.reports(), d.conductor_, *r)) ++d.recorders_;
       }},
  };
  return all;
}

void ControlDesk::handle(const Ask& ask, const ReplyPtr& reply) {
  if (!kJobs.contains(ask.command)) return attempt(ask, reply);
  conductor_.begin(ask.command, [this, ask, reply] { attempt(ask, reply); });
}

// Whatever an operator asks, and however wrong that goes, the system works on.
void ControlDesk::attempt(const Ask& ask, const ReplyPtr& reply) {
  try {
    carry_out(ask, reply);
  } catch (const std::exception& error) {
    const std::string text = "a fault of Orca in the command " + in_quotes(ask.command) + ": " + error.what();
    log::error(kLogName, text);
    reply->refuse(fail(Code::internal, text));
  }
}

void ControlDesk::carry_out(const Ask& ask, const ReplyPtr& reply) {
  const auto handler = handlers().find(ask.command);
  if (kOfThisMachine.contains(ask.command) && names_.other_machines()) reply->note(*names_.other_machines());
  if (handler != handlers().end()) return handler->second(*this, ask, reply);
  reply->refuse(
      fail(Code::unimplemented, "the supervisor does not know the command " + in_quotes(ask.command)));
}

void ControlDesk::rewire(const Ask& ask, const ReplyPtr& reply, Rewiring rewiring) {
  for (const std::size_t at : {0U, 1U})
    if (const auto port = names_.port(word(ask, at)); !port) return reply->refuse(port.error());
  if (const Status free = applying_.can_change(); !free.ok()) return reply->refuse(free.error());
  (applying_.*rewiring)(ask.words, reply);
}

void ControlDesk::show_log(const Ask& ask, const ReplyPtr& reply) {
  Result<LogWish> wish = read_log_wish(ask.words);
  if (!wish) return reply->refuse(wish.error());
  log_.show(std::move(wish).value(), reply);
}

void ControlDesk::show_missions(const Ask& ask, Reply& reply) const {
  if (ask.words.empty()) return ledger_.missions().show(reply);
  std::uint64_t number = 0;
  const std::string& text = ask.words[0];
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size())
    return reply.refuse(fail(Code::invalid_argument, in_quotes(text) + " is no number of a mission"));
  if (const Status shown = ledger_.missions().show(number, reply); !shown.ok()) reply.refuse(shown.error());
}

}  // namespace orca::supervisor
