// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "orca/base/result.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::supervisor {

/// The way back to the client that has asked something. The answer ends when the object is destroyed, so whoever has
/// something to add keeps a pointer to it. What a client does not read is left out and counted; the end of the answer says
/// how much, unless somebody has asked. If there is no room for the end, the connection ends instead.
///
/// Thread contract: the supervisor's thread.
class Reply {
 public:
  /// @param client   may end before the reply.
  /// @param request  number of the request.
  Reply(std::weak_ptr<Channel> client, std::uint64_t request, bool as_json)
      : client_(std::move(client)), request_(request), as_json_(as_json) {}
  ~Reply();
  Reply(const Reply&) = delete;
  Reply& operator=(const Reply&) = delete;

  /// Send a part of the answer.
  void add(Record record) { send(RecordAnswer{std::move(record)}); }
  void add(std::string text) { send(TextAnswer{std::move(text)}); }
  void add(LineAnswer line) { send(std::move(line)); }
  /// Tells a person something that is no part of the answer.
  void note(std::string text) { send(NoteAnswer{std::move(text)}); }
  /// Makes the answer end with an error, of several with the first.
  void refuse(const Error& error);
  /// Has this called with the outcome when the answer ends, whether somebody still listens or not.
  void at_end(std::function<void(const Status&)> hears) { at_end_ = std::move(hears); }

  /// Returns whether texts are wanted as JSON.
  [[nodiscard]] bool as_json() const { return as_json_; }
  /// Returns whether nobody listens any more.
  [[nodiscard]] bool is_in_vain() const { return client_.expired(); }
  /// Returns the number of parts that the client had no room for, since the last call.
  [[nodiscard]] std::uint64_t take_left_out() { return std::exchange(left_out_, 0); }

 private:
  void send(ControlAnswer answer);

  const std::weak_ptr<Channel> client_;
  const std::uint64_t request_;
  const bool as_json_;
  Status outcome_;
  std::function<void(const Status&)> at_end_;
  std::uint64_t left_out_ = 0;
};

/// A reply that several may add to.
using ReplyPtr = std::shared_ptr<Reply>;

}  // namespace orca::supervisor
