// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/order_rules.hpp"

#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <fstream>
#include <sstream>
#include <vector>

#include "orca/base/log.hpp"
#include "orca/base/text.hpp"

namespace orca::supervisor {
namespace {

constexpr std::size_t kLongestOrder = 500;  // [bytes]
constexpr std::size_t kMostRefused = 1000;  // users that are remembered

struct Rule {
  Access access = Access::change;
  bool is_order = true;
};

// Those that only look are missing in the audit log. What reads a file or runs code for the one who asks needs most.
Rule rule_for(const Ask& ask) {
  static constexpr Rule kLook{Access::observe, false};
  static constexpr Rule kOperate{Access::operate, true};
  static const std::map<std::string, Rule, std::less<>> rules{
      {"ps", kLook},
      {"graph", kLook},
      {"machines", kLook},
      {"team", kLook},
      {"ports", kLook},
      {"plugins", kLook},
      {"names", kLook},
      {"objects", kLook},
      {"roles", kLook},
      {"counters", kLook},
      {"missions", kLook},
      {"log", kLook},
      {"get", kLook},
      {"sources", kLook},
      {"fits", {Access::change, false}},
      {"diff", {Access::change, false}},
      {"estop", kOperate},
      {"suspend", kOperate},
      {"resume", kOperate},
      {"pause", kOperate},
      {"step", kOperate},
  };
  if (ask.command == "alarms" || ask.command == "pace") return ask.words.empty() ? kLook : kOperate;
  // Whoever means to keep something beside the graph says so.
  if (ask.command == "file") return {ask.words.empty() ? Access::observe : Access::operate, false};
  // At a line that taps, a host process takes no objects (PortLines).
  if (ask.command == "line")
    return std::ranges::find(ask.words, "--tap") != ask.words.end() ? kLook : kOperate;
  const auto found = rules.find(ask.command);
  return found == rules.end() ? Rule{} : found->second;
}

std::string shown_as(const Ask& ask) { return ask.command == "line" ? "talk to" : ask.command; }

std::string name_of(uid_t user) {
  std::array<char, 4096> room{};
  passwd entry{};
  passwd* found = nullptr;
  if (getpwuid_r(user, &entry, room.data(), room.size(), &found) != 0 || found == nullptr) return "";
  return found->pw_name;
}

// The name of a program, as it calls itself.
std::string program_of(pid_t process) {
  std::string name;
  std::getline(std::ifstream("/proc/" + std::to_string(process) + "/comm"), name);
  return name.empty() ? "process" : name;
}

std::string refusal_to(uid_t uid, Access access, Access needed) {
  const std::string user = std::to_string(uid);
  return " in this system, and user " + user + " has " +
         (access == Access::none ? "none" : std::string("only ") + to_string(access)) +
         "; who started it, user " + std::to_string(geteuid()) + ", can give it: deployer --allow " +
         to_string(needed) + "=user:" + user;
}

std::string time_of_day() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  std::array<char, 32> text{};
  (void)std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%SZ", gmtime_r(&now, &parts));
  return text.data();
}

}  // namespace

Access access_for(const Ask& ask) { return rule_for(ask).access; }

bool is_order(const Ask& ask) { return rule_for(ask).is_order; }

void show_roles(const std::vector<std::string>& orders, Reply& reply) {
  for (const std::string& order : orders) {
    std::istringstream text(order);
    Ask ask;
    text >> ask.command;
    for (std::string word; text >> word;) ask.words.push_back(word);
    reply.add(Record{{"order", order}, {"role", to_string(access_for(ask))}});
  }
}

Audit::Audit() {
  for (const uid_t user : {uid_t{0}, geteuid()}) names_[user] = name_of(user);
}

std::string Audit::describe(const Ask& ask, const ucred& asker) const {
  const auto name = names_.find(asker.uid);
  const std::string user = name == names_.end() || name->second.empty()
                               ? "user " + std::to_string(asker.uid)
                               : "user " + name->second + " (" + std::to_string(asker.uid) + ")";
  std::vector<std::string> words{shown_as(ask)};
  for (const std::string& word : ask.words) words.push_back(in_shell_quotes(word));
  const std::string via = ask.via.empty() ? "" : ", by " + ask.via + " as " + to_string(ask.most);
  return user + ", " + program_of(asker.pid) + "[" + std::to_string(asker.pid) + "]" + via + ", at " +
         time_of_day() + ": " + shortened(joined(words, " "), kLongestOrder);
}

Status Audit::allow(const Ask& ask, const Asker& asker, Access access) {
  const Access needed = access_for(ask);
  if (std::min(access, ask.most) >= needed) return ok();
  const std::string takes = in_quotes(shown_as(ask)) + " takes the role " + to_string(needed);
  const Error error = fail(Code::failed_precondition,
                           access >= needed ? takes + ", and this address has " + to_string(ask.most) +
                                                  "; who has started the page has one with that role"
                                            : takes + refusal_to(asker.who.uid, access, needed));
  if (is_worth_a_line(asker.who.uid)) note(describe(ask, asker.who), error);
  return error;
}

// A stranger cannot fill the log with refusals.
bool Audit::is_worth_a_line(uid_t user) {
  if (refusals_.size() > kMostRefused) refusals_.clear();
  Refusals& refusals = refusals_[user];
  const auto now = std::chrono::steady_clock::now();
  if (now - refusals.second >= std::chrono::seconds(1)) refusals = {now, 0};
  return ++refusals.noted <= kMostNoted;
}

void Audit::note(const std::string& order, const Status& outcome) {
  if (outcome.ok()) return log::info(kAuditName, order + ": done");
  log::warning(kAuditName, order + ": not done: " + outcome.error().message);
}

}  // namespace orca::supervisor
