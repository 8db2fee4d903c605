// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/push.hpp"
#include "orca/patterns/query.hpp"
#include "orca/patterns/send.hpp"

using namespace orca;
using idl::MotionCommand;

namespace {

// Keeps the contracts that ports declare.
struct Declared : PortOwner {
  void declare_port(PortDeclaration declaration) override { declarations.push_back(std::move(declaration)); }
  Status on_command(const ObjectPtr<MotionCommand>&) { return ok(); }
  Result<Loan<MotionCommand>> on_ask(const ObjectPtr<idl::Ask>&) { return full_stop(); }
  std::vector<PortDeclaration> declarations;
};

}  // namespace

TEST_CASE("a proxy is required and keeps the latest object, unless its author says otherwise",
          "[patterns][declaration]") {
  Declared owner;
  const PushProxy<MotionCommand> plain(owner, "plain");
  const PushProxy<MotionCommand> special(owner, "special",
                                         {.text = "Why.", .optional = true, .manual = true, .depth = 5});
  const PortDeclaration& first = owner.declarations.at(0);
  CHECK(first.contract.name == "plain");
  CHECK(first.contract.pattern == Pattern::push);
  CHECK(first.contract.role == Role::proxy);
  CHECK(first.contract.type == type_id(object_type<MotionCommand>()));
  CHECK(first.contract.required);
  CHECK(first.contract.queue == QueuePolicy{});
  CHECK_FALSE(first.contract.from_device);
  CHECK_FALSE(first.contract.many);
  CHECK_FALSE(first.manual);
  const PortDeclaration& second = owner.declarations.at(1);
  CHECK_FALSE(second.contract.required);
  CHECK(second.contract.queue.depth == 5);
  CHECK(second.contract.text == "Why.");
  CHECK(second.manual);
}

TEST_CASE("a server is never required, and Send and Query servers have room for sixteen",
          "[patterns][declaration]") {
  Declared owner;
  const PushServer<MotionCommand> push(owner, "push");
  const SendServer<MotionCommand> send(owner, "send", &Declared::on_command);
  const QueryServer<idl::Ask, MotionCommand> query(owner, "query", &Declared::on_ask);
  for (const PortDeclaration& declared : owner.declarations) {
    CHECK(declared.contract.role == Role::server);
    CHECK_FALSE(declared.contract.required);
  }
  CHECK(owner.declarations.at(1).contract.queue.depth == 16);
  CHECK(owner.declarations.at(1).on_object != nullptr);
  CHECK(owner.declarations.at(2).contract.queue.depth == 16);
  CHECK(owner.declarations.at(2).on_request != nullptr);
}

TEST_CASE("a Query port names the type of its request and that of its reply", "[patterns][declaration]") {
  Declared owner;
  const QueryProxy<idl::Ask, MotionCommand> proxy(owner, "question");
  const PortContract& contract = owner.declarations.at(0).contract;
  CHECK(contract.type.name == "Ask");
  REQUIRE(contract.reply.has_value());
  CHECK(contract.reply->name == "MotionCommand");
}

TEST_CASE("a port array takes many edges, and its owner subscribes them itself", "[patterns][declaration]") {
  Declared owner;
  const PushProxyArray<MotionCommand> array(owner, "motion");
  CHECK(owner.declarations.at(0).contract.many);
  CHECK(owner.declarations.at(0).manual);
}

TEST_CASE("ports lend empty objects of their own types", "[patterns][declaration]") {
  Declared owner;
  const PushServer<MotionCommand> push(owner, "push");
  const SendProxy<MotionCommand> send(owner, "send");
  const QueryProxy<idl::Ask, MotionCommand> query(owner, "query");
  const Loan<MotionCommand> pushed = push.loan();
  const Loan<MotionCommand> sent = send.loan();
  const Loan<idl::Ask> asked = query.loan();
  REQUIRE((pushed && sent && asked));
  CHECK(*pushed == MotionCommand());
  CHECK(*sent == MotionCommand());
  CHECK(*asked == idl::Ask());
}
