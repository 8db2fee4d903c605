// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "following.hpp"

#include <poll.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "asking.hpp"
#include "causes.hpp"
#include "figures.hpp"
#include "orca/base/text.hpp"
#include "table.hpp"
#include "tapping.hpp"

namespace orca::orcactl {
namespace {

using supervisor::Channel;
using supervisor::Record;
using supervisor::Tapped;
using Clock = std::chrono::steady_clock;

// Processes send what has passed every 10 ms, each by itself, so a cause may come later than what it has caused.
constexpr auto kSettled = std::chrono::milliseconds(100);

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

// Follows objects at one port back to another port. It looks at more ports as it meets them in causes.
class Follower {
 public:
  Follower(Client& client, std::string from, std::string to)
      : client_(client), from_(std::move(from)), to_(std::move(to)) {}

  Status begin() {
    for (const std::string& port : {from_, to_})
      if (Status opened = look_at(port); !opened.ok()) return opened;
    return ok();
  }

  // Looks for a span of time [s].
  Status look_for(Duration span) {
    const auto end = Clock::now() + std::chrono::duration_cast<Clock::duration>(span);
    while (Clock::now() < end) {
      if (Status taken = take_what_came(); !taken.ok()) return taken;
      settle();
    }
    return ok();
  }

  // Returns a line for each way that objects have come, those that began at `from` first. Begins anew.
  std::vector<Record> take() {
    std::vector<Record> lines;
    for (auto& [way, figures] : ways_) {
      Record line = figures.ages.take_ages();
      line.front() = {"objects", figures.objects};
      line.insert(line.begin(), {"way", way.second});
      lines.push_back(std::move(line));
    }
    ways_.clear();
    return lines;
  }

 private:
  struct Tap {
    std::string port;
    std::unique_ptr<Channel> line;
  };
  struct Arrival {
    ObjectId object;
    Tapped passed;
    Clock::time_point seen;
  };
  struct Figures {
    std::uint64_t objects = 0;
    PassedFigures ages;
  };

  Status look_at(const std::string& port) {
    if (!known_ports_.insert(port).second) return ok();
    Result<supervisor::LineAnswer> opened = client_.open_line(port, {"--tap", "--objects"});
    if (!opened) return opened.error();
    taps_.push_back({port, std::make_unique<Channel>(std::move(opened->line))});
    return ok();
  }

  Status take_what_came() {
    constexpr int kLook = 20;  // [ms]
    std::vector<pollfd> lines;
    for (const Tap& tap : taps_) lines.push_back({tap.line->descriptor(), POLLIN, 0});
    (void)::poll(lines.data(), lines.size(), kLook);
    for (std::size_t i = 0; i < lines.size();
         ++i)  // taps that come meanwhile have their turn in the next round
      if (lines[i].revents != 0)
        if (Status taken = take_from(taps_[i].port, *taps_[i].line); !taken.ok()) return taken;
    return ok();
  }

  Status take_from(const std::string& port, Channel& line) {
    for (;;) {
      Result<std::optional<supervisor::Message>> message = line.receive();
      if (!message) return fail(Code::unavailable, "the process of " + port + " has ended");
      if (!message->has_value()) return ok();
      Result<Tapped> passed = tapped(std::move(**message));
      if (!passed) return passed.error();
      Result<ObjectRef> object = object_of(*passed);
      if (!object) return object.error();
      note(port, *object, std::move(*passed));
    }
  }

  void note(const std::string& port, const ObjectRef& object, Tapped passed) {
    const idl::OrcaObject& header = object.header();
    if (port == from_) {
      causes_.note_beginning(id_of(header),
                             static_cast<std::uint64_t>(object.stamp().time_since_epoch().count()));
    } else {
      const ObjectId cause = cause_of(header);
      causes_.note(id_of(header), cause);
      // What cannot be looked at, such as orcactl itself, is a cause that was not seen.
      if (!cause.port.empty()) (void)look_at(cause.port);
    }
    if (port == to_) arrivals_.push_back({id_of(header), std::move(passed), Clock::now()});
  }

  void settle() {
    const auto until = Clock::now() - kSettled;
    for (; !arrivals_.empty() && arrivals_.front().seen < until; arrivals_.pop_front()) {
      Arrival& arrival = arrivals_.front();
      const Causes::Way way = causes_.way_to(arrival.object);
      Figures& figures = ways_[{!way.sensed, way.text()}];
      ++figures.objects;
      if (!way.sensed) continue;
      arrival.passed.created = *way.sensed;
      figures.ages.add(arrival.passed);
    }
  }

  Client& client_;
  const std::string from_;
  const std::string to_;
  std::set<std::string> known_ports_;
  std::vector<Tap> taps_;
  Causes causes_;
  std::deque<Arrival> arrivals_;  // at `to`, oldest first
  std::map<std::pair<bool, std::string>, Figures> ways_;
};

void print_lines(const std::vector<Record>& lines, bool as_json) {
  if (!as_json) return print(table_text(lines, 0));
  for (const Record& line : lines) print(record_json(line));
}

}  // namespace

Result<std::string> port_meant_by(const std::string& word, const std::set<std::string>& ports) {
  if (ports.contains(word)) return word;
  std::vector<std::string> meant;
  for (const std::string& port : ports)
    if (word == "wheels" ? port.ends_with(".MotionCommandSend")
                         : lower(port) == lower(word) + "push" || lower(port) == lower(word) + "send")
      meant.push_back(port);
  if (meant.size() == 1) return meant.front();
  if (word != "wheels") return word;
  if (meant.empty())
    return fail(Code::invalid_argument, "no component has a port MotionCommandSend; name a port");
  return fail(Code::invalid_argument,
              "\"wheels\" could mean " + joined(meant, ", ") + "; name one of these ports");
}

Status follow(Client& client, const apps::Call& call) {
  const std::set<std::string> ports = names_of(client, "names", "port");
  const Result<std::string> from = port_meant_by(call.options.find("--from")->second, ports);
  if (!from) return from.error();
  const Result<std::string> to = port_meant_by(call.options.find("--to")->second, ports);
  if (!to) return to.error();
  Follower follower(client, *from, *to);
  if (Status begun = follower.begin(); !begun.ok()) return begun;
  const std::optional<Duration> whole = call.duration("--for");
  for (;;) {
    if (Status looked = follower.look_for(whole.value_or(1s)); !looked.ok()) return looked;
    print_lines(follower.take(), call.has("--json"));
    if (whole) return ok();
  }
}

}  // namespace orca::orcactl
