// SPDX-License-Identifier: LGPL-3.0-or-later
#include "company.hpp"

#include <algorithm>

namespace orca::supervisor {

Company::Company(Place place, const Members& members) : place_(std::move(place)) {
  for (Member* const member : members) members_.emplace_back(member, member->starts().count);
}

Members Company::present() const {
  Members present;
  for (const auto& [member, start] : members_)
    if (member->process() != nullptr && member->starts().count == start) present.push_back(member);
  return present;
}

bool Company::has(const Member& member) const {
  const Members all = present();
  return std::ranges::find(all, &member) != all.end();
}

bool Company::is_over() const { return place_.is_over() || present().empty(); }

bool Company::wait(const std::function<bool()>& is_so) const {
  return place_.conductor.wait([&] { return is_over() || is_so(); }) && !is_over();
}

bool Company::ask_all(const std::function<Order(const Member&)>& order) const {
  std::vector<std::pair<Member*, PendingAnswer>> asked;
  for (Member* const member : present()) asked.emplace_back(member, PendingAnswer(*member, order(*member)));
  const auto is_over = [](const auto& one) { return one.second.is_over(); };
  while (!asked.empty()) {
    if (!wait([&] { return std::ranges::any_of(asked, is_over); })) return false;
    const auto next = std::ranges::find_if(asked, is_over);
    const auto [member, pending] = std::move(*next);
    asked.erase(next);
    if (!take(*member, pending)) return false;
  }
  return true;
}

bool Company::ask(Member& member, Order order) const {
  const PendingAnswer pending(member, std::move(order));
  return wait([&] { return pending.is_over(); }) && take(member, pending);
}

// Waits for the end of a process that has refused.
bool Company::take(Member& member, const PendingAnswer& pending) const {
  if (!pending.answer() || pending.answer()->outcome.ok() || !has(member)) return true;
  place_.refused(member, pending.answer()->outcome.error());
  return wait([&] { return !has(member); });
}

}  // namespace orca::supervisor
