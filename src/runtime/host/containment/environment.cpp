// SPDX-License-Identifier: LGPL-3.0-or-later
#include "environment.hpp"

#include <locale.h>
#include <pthread.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "floating_point.hpp"
#include "orca/base/log.hpp"
#include "orca/host/last_words.hpp"

namespace orca::host {
namespace {

constexpr unsigned kTurnsPerLook = 64;
constexpr int kWatchfulTurns = 256;
constexpr int kNoticedPages = 16384;  // 64 MB: from here on one looks who takes them,
constexpr int kManyPages = 4096;      // and 16 MB in the turns that are looked at one by one are too many
constexpr int kManyDescriptors = 32;  // more than a component has reason to open in its laps

const char* advice(std::string_view kind) {
  if (kind == "DESCRIPTORS") return "; what is opened must be closed";
  if (kind == "MEMORY") return "; it will run out of it";
  return "; it is put back where it can be: a component must leave alone what all share";
}

std::string current_folder() {
  std::error_code error;
  const std::string folder = std::filesystem::current_path(error).string();
  return error ? "(removed)" : folder;
}

// The hooks that open and close things, and that run seldom enough to be looked at closely.
bool is_rare(const Activity& turn) {
  const std::string_view what = turn.what();
  return what == "configure" || what == "start" || what == "stop" || what == "suspend" || what == "resume";
}

bool same_handler(const struct sigaction& a, const struct sigaction& b) {
  return a.sa_handler == b.sa_handler && (a.sa_flags & SA_SIGINFO) == (b.sa_flags & SA_SIGINFO);
}

std::string difference(const sigset_t& now, const sigset_t& before) {
  std::string changes;
  for (int signal = 1; signal < SIGRTMIN; ++signal) {
    const bool blocked = sigismember(&now, signal) == 1;
    if (blocked == (sigismember(&before, signal) == 1)) continue;
    changes += std::string(changes.empty() ? "" : ", ") + (blocked ? "blocked SIG" : "unblocked SIG") +
               sigabbrev_np(signal);
  }
  return changes;
}

std::string text_of(rlim_t limit) { return limit == RLIM_INFINITY ? "unlimited" : std::to_string(limit); }

}  // namespace

Environment& Environment::of_process() {
  static Environment environment;
  return environment;
}

void Environment::keep() {
  const std::lock_guard lock(mutex_);
  floating_point_ = floating_point_control();
  locale_ = setlocale(LC_ALL, nullptr);
  pthread_sigmask(SIG_BLOCK, nullptr, &signal_mask_);
  handlers_ = {{SIGINT, {}}, {SIGTERM, {}}, {SIGSEGV, {}}};
  for (Handler& handler : handlers_) sigaction(handler.signal, nullptr, &handler.action);
  folder_ = current_folder();
  umask_ = umask(0);
  umask(umask_);
  limits_ = {{RLIMIT_AS, "memory", {}},
             {RLIMIT_CPU, "CPU time", {}},
             {RLIMIT_FSIZE, "size of files", {}},
             {RLIMIT_NOFILE, "number of descriptors", {}}};
  for (Limit& limit : limits_) getrlimit(static_cast<__rlimit_resource_t>(limit.resource), &limit.value);
  own_.remember();
  open_.start(own_.lowest_free());
  memory_.start(count_memory_pages());
  memory_watched_ = false;
  guests_.clear();
  turns_ = 0;
  said_.clear();
  watchful_turns_ = 0;
  kept_ = true;
}

void Environment::let_go() {
  const std::lock_guard lock(mutex_);
  kept_ = false;
  own_.release();
}

Environment::Guest& Environment::guest(const Activity& turn) {
  const auto known = std::ranges::find(guests_, std::string_view(turn.who()), &Guest::name);
  if (known != guests_.end()) return *known;
  return guests_.emplace_back(Guest{turn.who(), {}, 0, false, {}});
}

void Environment::entering(const Activity& turn) {
  if (!is_rare(turn)) return;
  const std::lock_guard lock(mutex_);
  if (!kept_) return;
  look_at_all(false);  // what is wrong now was others
  Guest& guest = this->guest(turn);
  if (turn.what() == std::string_view("start")) guest.balance = {};
  begin_balance(guest);
}

void Environment::leaving(const Activity& turn) {
  const std::lock_guard lock(mutex_);
  if (!kept_) return;
  Guest& guest = this->guest(turn);
  guest.hook = turn.what();
  guest.suspect = true;
  look_at_cheap(guest);
  if (is_due(guest)) look_at_all(false);
}

void Environment::left(const Activity& turn) {
  leaving(turn);
  if (!is_rare(turn)) return;
  const std::lock_guard lock(mutex_);
  if (!kept_) return;
  Guest& guest = this->guest(turn);
  guest.suspect = true;
  look_at_all(true);
  end_balance(guest);
}

bool Environment::is_due(Guest& guest) {
  ++guest.turns;
  ++turns_;
  if (watchful_turns_ > 0) return --watchful_turns_, true;
  return guest.turns <= 2 || guest.turns % kTurnsPerLook == 0 || open_.total() >= kManyDescriptors;
}

std::vector<const Environment::Guest*> Environment::suspects() const {
  std::vector<const Guest*> found;
  for (const Guest& guest : guests_)
    if (guest.suspect) found.push_back(&guest);
  return found;
}

void Environment::look_at_cheap(const Guest& guest) {
  if (floating_point_control() != floating_point_) {
    set_floating_point_control(floating_point_);
    alarm(guest, "FLOATING_POINT", "changed how numbers are rounded or which results are trapped");
  }
  const std::string_view locale = setlocale(LC_ALL, nullptr);
  if (locale != locale_) {
    const std::string now(locale);
    setlocale(LC_ALL, locale_.c_str());
    alarm(guest, "LOCALE", "changed the locale from \"" + locale_ + "\" to \"" + now + "\"");
  }
  if (const locale_t mine = uselocale(nullptr); mine != LC_GLOBAL_LOCALE) {
    uselocale(LC_GLOBAL_LOCALE);
    alarm(guest, "LOCALE", "given its thread a locale of its own");
  }
}

void Environment::look_at_all(bool rare) {
  if (!own_.all_open())
    LastWords::say_and_end("error: " + culprit() +
                           " has closed descriptors that are not its own; the process cannot go on");
  look_at_signals();
  look_at_files();
  look_at_limits();
  look_at_descriptors(rare);
  look_at_memory(rare);
  for (Guest& guest : guests_) guest.suspect = false;
}

void Environment::look_at_signals() {
  sigset_t now;
  pthread_sigmask(SIG_SETMASK, &signal_mask_, &now);
  if (const std::string changes = difference(now, signal_mask_); !changes.empty())
    alarm_suspects("SIGNAL_MASK", changes);
  for (const Handler& kept : handlers_) {
    struct sigaction present {};
    sigaction(kept.signal, nullptr, &present);
    if (same_handler(present, kept.action)) continue;
    sigaction(kept.signal, &kept.action, nullptr);
    alarm_suspects("SIGNAL_HANDLER", std::string("changed what happens at SIG") + sigabbrev_np(kept.signal));
  }
}

void Environment::look_at_files() {
  if (const std::string folder = current_folder(); folder != folder_) {
    const bool back = chdir(folder_.c_str()) == 0;
    alarm_suspects("WORKING_FOLDER",
                   "changed the working folder to " + folder + (back ? "" : ", and the way back fails"));
  }
  if (const mode_t mask = umask(umask_); mask != umask_) alarm_suspects("UMASK", "changed the umask");
}

void Environment::look_at_limits() {
  for (const Limit& kept : limits_) {
    const auto resource = static_cast<__rlimit_resource_t>(kept.resource);
    rlimit now{};
    getrlimit(resource, &now);
    if (now.rlim_cur == kept.value.rlim_cur) continue;
    const bool back = setrlimit(resource, &kept.value) == 0;
    alarm_suspects("RESOURCE_LIMIT", std::string("changed the limit of the ") + kept.name + " from " +
                                         text_of(kept.value.rlim_cur) + " to " + text_of(now.rlim_cur) +
                                         (back ? "" : ", and only the superuser could put it back"));
  }
}

void Environment::look_at_descriptors(bool rare) {
  const int lowest = own_.lowest_free();
  if (lowest < 0) {
    if (!std::exchange(exhausted_, true))
      alarm_suspects("DESCRIPTORS", "left the process without a free descriptor");
    return;
  }
  exhausted_ = false;
  if (rare) return open_.accept(lowest);  // these hooks may open what others close
  const auto possible = suspects();
  if (possible.size() != 1) return open_.skip_to(lowest);
  const int own = open_.take(possible.front()->name, lowest);
  if (own >= kManyDescriptors)
    alarm(*possible.front(), "DESCRIPTORS",
          "opened at least " + std::to_string(own) + " descriptors and not closed them");
}

void Environment::look_at_memory(bool rare) {
  const int taken = count_memory_pages();
  if (rare) return memory_.accept(taken);  // these hooks may take what is needed as long as it works
  memory_watched_ = memory_watched_ && watchful_turns_ > 0;
  const auto possible = suspects();
  if (!memory_watched_ || possible.size() != 1) {
    memory_.skip_to(taken);
  } else if (const int own = memory_.take(possible.front()->name, taken); own >= kManyPages) {
    alarm(*possible.front(), "MEMORY",
          "taken " + std::to_string(own / 256) + " MB in a few turns and not given them back");
  }
  if (memory_.total() < kNoticedPages) return;
  memory_.start(taken);
  memory_watched_ = true;
  watchful_turns_ = kWatchfulTurns;
}

void Environment::begin_balance(Guest& guest) {
  Balance& balance = guest.balance;
  const std::optional<Descriptors> open = open_descriptors();
  balance.at_begin = open.value_or(Descriptors{});
  balance.turn = ++rare_turns_;
  balance.others_turns = turns_ - guest.turns;
  balance.sound = balance.sound && open && rare_running_ == 0;
  ++rare_running_;
}

void Environment::end_balance(Guest& guest) {
  Balance& balance = guest.balance;
  --rare_running_;
  const std::optional<Descriptors> open = open_descriptors();
  const bool alone = balance.turn == rare_turns_ && balance.others_turns == turns_ - guest.turns;
  balance.sound = balance.sound && open && alone;
  if (!balance.sound) return;
  const auto is_among = [](const Descriptors& all, const Descriptors::value_type& descriptor) {
    const auto found = all.find(descriptor.first);
    return found != all.end() && found->second == descriptor.second;
  };
  std::erase_if(balance.opened, [&](const auto& descriptor) { return !is_among(*open, descriptor); });
  for (const auto& descriptor : *open)
    if (!is_among(balance.at_begin, descriptor)) balance.opened.insert(descriptor);
  if (guest.hook == "stop" && !balance.opened.empty())
    alarm(guest, "DESCRIPTORS",
          "left open what start() or itself has opened: descriptor " + names_of(balance.opened));
}

void Environment::alarm(const Guest& guest, const char* kind, const std::string& deed) {
  if (said_.emplace(guest.name, kind).second)
    log::error(guest.name,
               std::string("alarm ") + kind + ": " + guest.hook + "() has " + deed + advice(kind));
}

void Environment::alarm_suspects(const char* kind, const std::string& deed) {
  const auto possible = suspects();
  if (possible.size() == 1) return alarm(*possible.front(), kind, deed);
  for (const Guest* guest : possible)
    if (said_.contains({guest->name, kind})) return;  // who does it is known
  watchful_turns_ = kWatchfulTurns;
  const std::string who = culprit();
  if (said_.emplace(who, kind).second)
    log::error("deployer", std::string("alarm ") + kind + ": " + who + " has " + deed + advice(kind));
}

std::string Environment::culprit() const {
  const auto possible = suspects();
  if (possible.empty()) return "something outside of the components' hooks";
  if (possible.size() == 1) return possible.front()->name + ": " + possible.front()->hook + "()";
  std::string names;
  for (const Guest* guest : possible) names += (names.empty() ? "one of " : ", ") + guest->name;
  return names;
}

}  // namespace orca::host
