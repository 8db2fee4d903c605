// SPDX-License-Identifier: GPL-3.0-or-later
// The ports of a component meet its code.
#include "run/component/parts/port_set.hpp"

#include <catch2/catch.hpp>

#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;

namespace {

PortContract question() {
  PortContract contract;
  contract.name = "limits";
  contract.pattern = Pattern::query;
  contract.role = Role::proxy;
  contract.type = type_id(object_type<idl::Ask>());
  contract.reply = type_id(object_type<idl::MotionCommand>());
  return contract;
}

// Binds a component whose code declares that port to the ports of a graph that was checked with question().
// Returns the outcome, and the endpoint that the code was given.
Status bound(const PortContract& declared, Endpoint*& given) {
  Status outcome;
  run_on({}, [&](Executive& executive) {
    Strand strand(executive, {"planner", 0});
    PortHome home{strand, "planner"};
    PortSet ports(home);
    ports.add(question());
    PortDeclaration declaration;
    declaration.contract = declared;
    declaration.slot = &given;
    outcome = ports.bind({declaration});
    if (outcome.ok()) CHECK(given == ports.find("limits"));
  });
  return outcome;
}

}  // namespace

TEST_CASE("code that declares the ports of the checked graph is given their endpoints", "[host][ports]") {
  Endpoint* given = nullptr;
  CHECK(bound(question(), given).ok());
  CHECK(given != nullptr);
  PortContract reworded = question();
  reworded.text = "The robot's limits.";
  reworded.required = true;
  reworded.queue.depth = 7;
  CHECK(bound(reworded, given).ok());
}

TEST_CASE("code that declares a port otherwise than in the checked graph is refused, whatever is different",
          "[host][ports]") {
  PortContract declared = question();
  SECTION("its name") { declared.name = "limit"; }
  SECTION("its pattern") { declared.pattern = Pattern::send; }
  SECTION("its role") { declared.role = Role::server; }
  SECTION("the type of its objects") { declared.type = type_id(object_type<idl::Alarm>()); }
  SECTION("the layout of its objects") { ++declared.type.hash; }
  SECTION("the type of its answers") { declared.reply = type_id(object_type<idl::Ask>()); }
  SECTION("that it has answers") { declared.reply.reset(); }
  SECTION("that it takes many edges") { declared.many = true; }
  Endpoint* given = nullptr;
  const Status refused = bound(declared, given);
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::failed_precondition);
  CHECK_THAT(refused.error().text(), Contains("its port \"" + declared.name + "\" is not as it was"));
  CHECK(given == nullptr);
}
