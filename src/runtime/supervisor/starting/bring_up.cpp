// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bring_up.hpp"

#include <utility>

namespace orca::supervisor {

BringUp::BringUp(Plan plan, Consent consent, std::function<void()> built, Done done)
    : plan_(std::move(plan)),
      consent_(std::move(consent)),
      built_(std::move(built)),
      done_(std::move(done)) {}

void BringUp::begin(std::vector<Setup> setups) {
  next_ = &BringUp::build;
  for (std::size_t i = 0; i < plan_.members.size(); ++i) ask(*plan_.members[i], std::move(setups[i]));
}

void BringUp::build() {
  ask_all([] { return Build{}; }, &BringUp::open_hardware);
}

void BringUp::open_hardware() {
  built_();
  ask_all([] { return OpenHardware{}; }, &BringUp::configure_next);
}

void BringUp::configure_next() {
  if (plan_.components.empty()) return open_gates();
  if (consent_.to_configure && !consent_.to_configure(plan_.components.front().second)) return;
  const auto [member, component] = std::move(plan_.components.front());
  plan_.components.pop_front();
  ask(*member, Configure{component});
}

void BringUp::open_gates() {
  if (consent_.to_begin && !consent_.to_begin()) return;
  for (Member* const member : plan_.members) {
    member->tell(OpenGates{});
    member->enter(Member::Phase::up);
  }
  is_over_ = true;
  done_(ok(), nullptr);
}

void BringUp::ask_all(const std::function<Order()>& order, Step next) {
  next_ = next;
  for (Member* const member : plan_.members) ask(*member, order());
}

void BringUp::ask(Member& member, Order order) {
  awaited_.insert(&member);
  member.ask(std::move(order), [this, &member](const Status& outcome) { take_answer(member, outcome); });
}

void BringUp::take_answer(Member& member, const Status& outcome) {
  if (!outcome.ok()) return done_(outcome, &member);  // its process is ended, and then lost
  awaited_.erase(&member);
  go_on();
}

void BringUp::lose(Member& member) {
  std::erase(plan_.members, &member);
  std::erase_if(plan_.components, [&](const auto& component) { return component.first == &member; });
  if (awaited_.erase(&member) > 0) go_on();
}

void BringUp::go_on() {
  if (next_ != nullptr && awaited_.empty() && !is_over()) (this->*next_)();
}

}  // namespace orca::supervisor
