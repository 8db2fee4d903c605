// SPDX-License-Identifier: LGPL-3.0-or-later
#include "vigil.hpp"

#include <system_error>
#include <variant>

namespace orca::supervisor {
namespace {

bool is_for_visitors(const Order& order) {
  return std::holds_alternative<Adopt>(order) || std::holds_alternative<TakeDown>(order) ||
         std::holds_alternative<StopMotors>(order) || std::holds_alternative<ReleaseMotors>(order);
}

}  // namespace

void Vigil::add_to(std::vector<pollfd>& all) const {
  if (visitor_ == nullptr)
    all.push_back({place_.descriptor(), POLLIN, 0});
  else
    all.push_back(
        {visitor_->descriptor(), static_cast<short>(visitor_->has_unsent() ? POLLIN | POLLOUT : POLLIN), 0});
}

std::optional<Told> Vigil::turn(Moment now) {
  if (visitor_ == nullptr) take_in(now);
  if (visitor_ == nullptr) return std::nullopt;
  (void)visitor_->flush();  // its error comes back from receive()
  std::optional<Told> told = hear();
  if (told) sent_away_at_ = now + kPatience;
  if (now >= sent_away_at_) visitor_.reset();
  return told;
}

void Vigil::take_in(Moment now) {
  Result<Descriptor> connection = place_.accept();
  if (!connection || !*connection) return;
  try {
    auto visitor = std::make_shared<Channel>(std::move(connection).value());
    (void)visitor->post(encode(Report(introduce_())));
    visitor_ = std::move(visitor);
    sent_away_at_ = now + kPatience;
  } catch (const std::system_error&) {
    return;  // no descriptors are left; another visitor may come later
  }
}

std::optional<Told> Vigil::hear() {
  Result<std::optional<Message>> message = visitor_->receive();
  if (message && !message->has_value()) return std::nullopt;
  const std::uint64_t request = message ? (*message)->request : 0;
  Result<Order> order = message ? decode_order(std::move(**message)) : Result<Order>(message.error());
  if (order && is_for_visitors(*order)) return Told{std::move(*order), request, visitor_};
  visitor_.reset();
  return std::nullopt;
}

}  // namespace orca::supervisor
