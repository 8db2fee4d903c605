// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/contract.hpp"

#include <catch2/catch.hpp>

using namespace orca;

TEST_CASE("a port of which nothing is declared may stay unconnected, takes one edge, and has no period",
          "[base][contract]") {
  const PortContract port;
  CHECK_FALSE(port.required);
  CHECK_FALSE(port.many);
  CHECK_FALSE(port.from_device);
  CHECK(port.period == Duration{0});
  CHECK_FALSE(port.reply.has_value());
  CHECK(port.queue == QueuePolicy{});
}

TEST_CASE("a parameter of which nothing is declared is no file and may change at any time",
          "[base][contract]") {
  const ParamContract param;
  CHECK_FALSE(param.file);
  CHECK_FALSE(param.fixed);
  CHECK_FALSE(param.min.has_value());
  CHECK_FALSE(param.max.has_value());
}

TEST_CASE("a trigger that names neither a period nor ports lets laps follow one another",
          "[base][contract]") {
  const Trigger trigger;
  CHECK(trigger.kind == Trigger::Kind::free_running);
  CHECK(trigger.period == Duration{0});
  CHECK_FALSE(trigger.waits_for_ports());
  CHECK(Trigger{Trigger::Kind::on_any, 0s, {"in"}}.waits_for_ports());
  CHECK(Trigger{Trigger::Kind::on_all, 0s, {"in"}}.waits_for_ports());
  CHECK_FALSE(Trigger{Trigger::Kind::period, 1s, {}}.waits_for_ports());
}

TEST_CASE("an edge keeps the latest object and may drop any number; with more room it may drop none",
          "[base][contract]") {
  const QueuePolicy latest;
  CHECK(latest.depth == 1);
  CHECK(latest.overflow == QueuePolicy::Overflow::drop_oldest);
  CHECK(latest.accepted_drops() == std::nullopt);
  CHECK(QueuePolicy{.depth = 2}.accepted_drops() == 0U);
  CHECK(QueuePolicy{.overflow = QueuePolicy::Overflow::drop_newest}.accepted_drops() == 0U);
  CHECK(QueuePolicy{.depth = 2, .drop_limit = 3}.accepted_drops() == 3U);
  CHECK(QueuePolicy{.drop_limit = 3}.accepted_drops() == 3U);
  CHECK(QueuePolicy{.depth = 2, .drop_limit = QueuePolicy::kAnyDrops}.accepted_drops() == std::nullopt);
}

TEST_CASE("each policy and each type of parameter is called what the graph and the docs call it",
          "[base][contract]") {
  using Overflow = QueuePolicy::Overflow;
  CHECK(std::string(to_string(Overflow::drop_oldest)) == "drop_oldest");
  CHECK(std::string(to_string(Overflow::drop_newest)) == "drop_newest");
  CHECK(std::string(to_string(Overflow::block)) == "block");
  CHECK(std::string(to_string(Overflow::refuse)) == "refuse");
  CHECK(std::string(to_string(ParamType::boolean)) == "true or false");
  CHECK(std::string(to_string(ParamType::integer)) == "integer");
  CHECK(std::string(to_string(ParamType::real)) == "number");
  CHECK(std::string(to_string(ParamType::text)) == "text");
  CHECK(std::string(to_string(ParamType::text_list)) == "list of texts separated by ';'");
}
