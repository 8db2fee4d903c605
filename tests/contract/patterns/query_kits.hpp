// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "link_kits.hpp"

namespace orca::test {

using idl::Ask;

/// Asks with a text.
struct Asker : Peer {
  explicit Asker(Executive& executive, const std::string& name = "asker") : Peer(executive, name) {}

  [[nodiscard]] Loan<Ask> about(const std::string& text) const {
    auto request = question.loan();
    request->about() = text;
    return request;
  }

  /// Sends a question that the server refuses: within a process at once, from another process by its answer.
  [[nodiscard]] Result<ObjectPtr<MotionCommand>> ask_in_vain(const std::string& text) {
    const Result<QueryId> id = question.query_request(about(text));
    if (!id) return id.error();
    return question.query_receive_wait(*id, 5s);
  }

  QueryProxy<Ask, MotionCommand> question{*this, "question"};
};

/// Answers with the length of the text; refuses "bad" and throws at "worse".
struct Answerer : Peer {
  explicit Answerer(Executive& executive, std::uint32_t depth = 4)
      : Peer(executive, "answerer"), server(*this, "server", &Answerer::on_ask, {.depth = depth}) {}

  Result<Loan<MotionCommand>> on_ask(const ObjectPtr<Ask>& ask) {
    if (ask->about() == "bad") return fail(Code::invalid_argument, "there is nothing to say about bad");
    if (ask->about() == "worse") throw std::runtime_error("worse");
    if (hint.connected()) (void)hint.get_update();
    return numbered(static_cast<int>(ask->about().size()));
  }

  [[nodiscard]] IntakeCounters counters() const {
    return static_cast<QueryServerEndpoint&>(endpoint("server")).counters();
  }

  PushProxy<MotionCommand> hint{*this, "hint"};
  QueryServer<Ask, MotionCommand> server;
};

template <class Kit>
struct Counter {
  explicit Counter(Kit& kit, std::uint32_t depth = 4) : asker(kit.executive), answerer(kit.executive, depth) {
    kit.connect(asker.endpoint("question"), answerer.endpoint("server"));
  }

  /// Waits until `count` questions have come to the server.
  [[nodiscard]] bool has_been_asked(std::uint64_t count) {
    return eventually(asker.executive(), [&] { return answerer.counters().accepted == count; });
  }

  Asker asker;
  Answerer answerer;
};

}  // namespace orca::test
