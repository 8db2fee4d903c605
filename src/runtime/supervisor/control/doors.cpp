// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/doors.hpp"

#include <utility>

#include "orca/base/log.hpp"
#include "orca/supervisor/log_name.hpp"

namespace orca::supervisor {

Result<SharedSocket> SharedSocket::open(const std::string& system, const std::vector<Grant>& grants) {
  if (grants.empty()) return SharedSocket{};
  Result<ControlSocket> opened = ControlSocket::open_shared(system);
  if (!opened) return opened.error();
  return SharedSocket{std::move(opened).value(), grants};
}

void Doors::open(ControlSocket socket) {
  own_.emplace(std::move(socket), [this](const Ask& ask, const Asker& asker, const ReplyPtr& reply) {
    take(ask, asker, reply);
  });
}

void Doors::open(SharedSocket others) {
  if (!others.socket) return;
  grants_ = std::move(others.grants);
  shared_.emplace(std::move(*others.socket), [this](const Ask& ask, const Asker& asker,
                                                    const ReplyPtr& reply) { take(ask, asker, reply); });
}

void Doors::close() {
  own_.reset();
  shared_.reset();
}

void Doors::add_to(std::vector<pollfd>& all) const {
  if (own_) own_->add_to(all);
  if (shared_) shared_->add_to(all);
}

void Doors::serve(Moment now) {
  if (own_) own_->serve(now);  // first: it is the owner's emergency stop
  if (shared_) shared_->serve(now);
}

std::optional<Result<bool>> Doors::restore() {
  if (shared_ && !shared_->restore_socket())
    log::debug(kLogName, "the socket for other users was removed, and cannot be made again");
  if (!own_) return std::nullopt;
  return own_->restore_socket();
}

void Doors::take(const Ask& ask, const Asker& asker, const ReplyPtr& reply) {
  if (const Status allowed = audit_.allow(ask, asker, access_of(asker, grants_)); !allowed.ok())
    return reply->refuse(allowed.error());
  if (is_order(ask))
    reply->at_end(
        [order = audit_.describe(ask, asker.who)](const Status& outcome) { Audit::note(order, outcome); });
  handler_(ask, reply);
}

}  // namespace orca::supervisor
