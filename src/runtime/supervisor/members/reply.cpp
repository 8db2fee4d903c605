// SPDX-License-Identifier: LGPL-3.0-or-later
#include "reply.hpp"

#include <utility>

namespace orca::supervisor {

Reply::~Reply() { send(EndAnswer{outcome_}); }

void Reply::refuse(const Error& error) {
  if (outcome_.ok()) outcome_ = error;
}

void Reply::send(ControlAnswer answer) {
  const std::shared_ptr<Channel> client = client_.lock();
  if (!client) return;
  const Status sent = client->post(encode(std::move(answer), request_));
  if (!sent.ok() && sent.error().code == Code::deadline_exceeded) ++left_out_;
}

}  // namespace orca::supervisor
