// SPDX-License-Identifier: LGPL-3.0-or-later
#include "environment.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "orca/host/last_words.hpp"
#include "process_watches.hpp"
#include "thread_watches.hpp"

namespace orca::host {
namespace {

constexpr unsigned kTurnsPerLook = 64;

const char* advice(AlarmKind kind) {
  if (kind == idl::DESCRIPTORS) return "; what is opened must be closed";
  return "; it is put back where it can be: a component must leave alone what all share";
}

// Only logs an alarm: outside a run nobody else takes it.
void only_log(const idl::Alarm& alarm) { log_alarm(alarm, "orca"); }

// Returns whether a hook opens and closes things, and runs rarely enough for all checks.
bool is_rare(Hook hook) {
  return hook == Hook::configure || hook == Hook::start || hook == Hook::stop || hook == Hook::suspend ||
         hook == Hook::resume;
}

}  // namespace

Environment::Environment() : sink_(only_log) {
  of_thread_each_turn_.push_back(std::make_unique<FloatingPointWatch>());
  of_thread_each_turn_.push_back(std::make_unique<ThreadLocaleWatch>());
  of_process_each_turn_.push_back(std::make_unique<LocaleWatch>());
  of_process_each_turn_.push_back(std::make_unique<TerminateWatch>());
  of_thread_.push_back(std::make_unique<SignalMaskWatch>());
  of_process_.push_back(std::make_unique<StandardStreamWatch>());
  of_process_.push_back(std::make_unique<SignalHandlerWatch>());
  of_process_.push_back(std::make_unique<FolderWatch>());
  of_process_.push_back(std::make_unique<UmaskWatch>());
  of_process_.push_back(std::make_unique<LimitWatch>());
}

Environment& Environment::of_process() {
  static Environment environment;
  return environment;
}

void Environment::keep(bool strands_overlap, AlarmSink sink) {
  const std::lock_guard lock(mutex_);
  strands_overlap_ = strands_overlap;
  sink_ = std::move(sink);
  for (const Watches* watches : {&of_thread_each_turn_, &of_process_each_turn_, &of_thread_, &of_process_})
    for (const auto& watch : *watches) watch->keep();
  descriptors_.keep();
  active_.clear();
  guests_.clear();
  turns_ = 0;
  hooks_running_ = 0;
  each_turn_ = false;
  foresight_.reset();
  said_.clear();
  kept_ = true;
}

void Environment::let_go() {
  const std::lock_guard lock(mutex_);
  kept_ = false;
  sink_ = only_log;
  descriptors_.let_go();
}

Environment::Guest& Environment::guest(const Activity& turn) {
  const auto known = guests_.find(std::string_view(turn.who()));
  if (known != guests_.end()) return known->second;
  Guest& made = guests_[turn.who()];
  made.name = turn.who();
  return made;
}

template <class Body>
void Environment::watched(Body&& body) {
  std::vector<idl::Alarm> alarms;
  {
    const std::lock_guard lock(mutex_);
    if (!kept_) return;
    body();
    alarms.swap(found_);
  }
  for (const idl::Alarm& alarm : alarms) sink_(alarm);
}

void Environment::entering(const Activity& turn) {
  watched([&] {
    Guest& guest = this->guest(turn);
    look_each_turn(nullptr);
    if (is_rare(turn.hook())) return enter_rare(guest, turn.hook());
    begin_hook(guest);
  });
}

void Environment::enter_rare(Guest& guest, Hook hook) {
  const std::optional<Foresight> seen = std::exchange(foresight_, std::nullopt);
  const bool is_known = seen && holds(*seen, guest);
  if (!is_known) look_at_all(nullptr, false);  // what is wrong now was done by others
  begin_hook(guest);
  guest.others_turns = turns_ - guest.turns;
  guest.own_openings = own_openings_;
  guest.balance.begin(hook == Hook::start, is_alone(guest), is_known ? &seen->open : nullptr);
}

void Environment::look_ahead(const std::string& who) {
  watched([&] {
    foresight_.reset();
    if (!is_undisturbed()) return;
    look_at_all(nullptr, false);
    if (std::optional<Descriptors> open = open_descriptors())
      foresight_ = Foresight{who, std::move(*open), turns_, own_openings_};
  });
}

bool Environment::holds(const Foresight& seen, const Guest& guest) const {
  if (seen.who != guest.name || !is_undisturbed() || seen.own_openings != own_openings_) return false;
  const bool only_saved =
      turns_ == seen.turns + 1 && guest.last_turn == turns_ && guest.hook == to_string(Hook::save_state);
  return turns_ == seen.turns || only_saved;
}

void Environment::leaving(const Activity& turn) {
  watched([&] {
    Guest& guest = this->guest(turn);
    leave(guest, turn);
  });
}

void Environment::left(const Activity& turn) {
  watched([&] {
    Guest& guest = this->guest(turn);
    leave(guest, turn);
    if (is_rare(turn.hook())) {
      look_at_all(&guest, true);
      end_balance(guest, turn.hook());
    }
    if (guest.hooks_running == 0) return;  // it began before the environment was kept
    --guest.hooks_running;
    --hooks_running_;
    if (!may_be_suspect(guest)) active_.erase(guest.name);
  });
}

void Environment::begin_hook(Guest& guest) {
  ++guest.hooks_running;
  ++hooks_running_;
  if (may_be_suspect(guest)) active_.try_emplace(guest.name, &guest);
}

bool Environment::may_be_suspect(const Guest& guest) const {
  return guest.had_turn || (strands_overlap_ && guest.hooks_running > 0);
}

void Environment::leave(Guest& guest, const Activity& turn) {
  ++guest.turns;
  guest.last_turn = ++turns_;
  guest.hook = hook_text(turn.hook(), turn.port());
  guest.had_turn = true;
  active_.try_emplace(guest.name, &guest);
  if (turn.hook() == Hook::strand && guest.hooks_running == 0) begin_hook(guest);  // no end of a hook follows
  look_each_turn(&guest);
  if (is_rare(turn.hook())) return;
  if (is_due(guest)) {
    look_at_all(&guest, false);
  } else if (descriptors_.is_crowded()) {
    look_at_descriptors(suspects_of_turn(&guest), false);
  }
}

bool Environment::is_due(const Guest& guest) const {
  return each_turn_ || guest.turns <= 2 || guest.turns % kTurnsPerLook == 0;
}

Environment::Guests Environment::suspects() const {
  Guests found;
  for (const auto& [name, guest] : active_) found.push_back(guest);
  return found;
}

Environment::Guests Environment::suspects_of_turn(const Guest* leaver) const {
  Guests found;
  for (const auto& [name, guest] : active_)
    if (guest == leaver || (strands_overlap_ && guest->hooks_running > 0)) found.push_back(guest);
  return found;
}

bool Environment::is_alone(const Guest& guest) const {
  return !strands_overlap_ || hooks_running_ == guest.hooks_running;
}

void Environment::look_each_turn(const Guest* leaver) {
  const auto of_thread = [&] { return leaver != nullptr ? Guests{leaver} : Guests{}; };
  for (const auto& watch : of_thread_each_turn_)
    if (const auto finding = watch->look()) accuse(of_thread(), *finding);
  for (const auto& watch : of_process_each_turn_)
    if (const auto finding = watch->look()) accuse(suspects_of_turn(leaver), *finding);
}

// @param may_open  after a hook that may open what others close.
void Environment::look_at_all(const Guest* leaver, bool may_open) {
  const Guests possible = suspects();
  if (descriptors_.own_are_closed())
    LastWords::say_and_end("error: " + culprit(possible) +
                           " has closed descriptors that are not its own; the process cannot go on");
  if (const auto finding = descriptors_.look_at_streams()) accuse(possible, *finding);
  const Guests leavers = leaver != nullptr ? Guests{leaver} : Guests{};
  for (const auto& watch : of_thread_)
    if (const auto finding = watch->look()) accuse(strands_overlap_ ? leavers : possible, *finding);
  for (const auto& watch : of_process_)
    if (const auto finding = watch->look()) accuse(possible, *finding);
  look_at_descriptors(possible, may_open);
  for (const auto& [name, guest] : active_) guest->had_turn = false;
  std::erase_if(active_, [this](const auto& one) { return !may_be_suspect(*one.second); });
}

void Environment::look_at_descriptors(const Guests& possible, bool may_open) {
  const bool exact = possible.size() == 1 && !may_open;
  if (const auto finding = descriptors_.look(exact ? &possible.front()->name : nullptr))
    accuse(possible, *finding);
  if (may_open) descriptors_.accept();
}

void Environment::end_balance(Guest& guest, Hook hook) {
  const bool only_guest = is_alone(guest) && guest.others_turns == turns_ - guest.turns;
  guest.balance.end(only_guest && opening_ == 0 && guest.own_openings == own_openings_);
  const Descriptors left_open = guest.balance.left_open();
  if (hook == Hook::stop && !left_open.empty())
    accuse_one(guest, {idl::DESCRIPTORS,
                       "left open what start() or itself has opened: descriptor " + names_of(left_open)});
}

void Environment::accuse(const Guests& possible, const Finding& finding) {
  if (possible.size() == 1) return accuse_one(*possible.front(), finding);
  for (const Guest* guest : possible)
    if (said_.contains({guest->name, finding.kind})) return;  // its author is known
  each_turn_ = true;
  if (said_.emplace("", finding.kind).second)
    found_.push_back(
        make_alarm(finding.kind, "", "", culprit(possible) + " has " + finding.deed + advice(finding.kind)));
}

void Environment::accuse_one(const Guest& guest, const Finding& finding) {
  if (said_.emplace(guest.name, finding.kind).second)
    found_.push_back(make_alarm(finding.kind, guest.name, guest.hook,
                                guest.hook + " has " + finding.deed + advice(finding.kind)));
}

std::string Environment::culprit(const Guests& possible) {
  if (possible.empty()) return "something outside of the components' hooks";
  if (possible.size() == 1) return possible.front()->name + ": " + possible.front()->hook;
  std::string names;
  for (const Guest* guest : possible) names += (names.empty() ? "one of " : ", ") + guest->name;
  return names;
}

void Environment::at_fork(Fork moment, const Activity* turn) {
  if (moment == Fork::begins) return mutex_.lock();
  if (moment == Fork::is_over_in_copy) {
    kept_ = false;
    sink_ = only_log;
  }
  const bool is_news =
      moment == Fork::is_over && turn != nullptr && said_.emplace(turn->who(), idl::FORK).second;
  mutex_.unlock();
  if (!is_news) return;
  const std::string hook = hook_text(turn->hook(), turn->port());
  sink_(make_alarm(idl::FORK, turn->who(), hook,
                   hook + " has called fork(); the copy is ended, because two must not drive one robot. "
                          "Start programs with posix_spawn()"));
}

}  // namespace orca::host
