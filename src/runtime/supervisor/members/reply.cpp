// SPDX-License-Identifier: LGPL-3.0-or-later
#include "reply.hpp"

#include <string>
#include <utility>
#include <variant>

namespace orca::supervisor {

Reply::~Reply() {
  if (at_end_) at_end_(outcome_);  // before what was not read counts: that is no part of the order
  if (left_out_ > 0)
    refuse(fail(Code::data_loss, "the answer was not read in time; parts of it that were left out: " +
                                     std::to_string(left_out_)));
  send(EndAnswer{outcome_});
}

void Reply::refuse(const Error& error) {
  if (outcome_.ok()) outcome_ = error;
}

void Reply::send(ControlAnswer answer) {
  const std::shared_ptr<Channel> client = client_.lock();
  if (!client) return;
  const bool is_end = std::holds_alternative<EndAnswer>(answer);
  const Status sent = client->post(encode(std::move(answer), request_));
  if (sent.ok() || sent.error().code != Code::deadline_exceeded) return;
  is_end ? client->shut_down() : void(++left_out_);  // without the end it would wait for ever
}

}  // namespace orca::supervisor
