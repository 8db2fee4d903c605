// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <thread>

#include "executives.hpp"
#include "run/component/parts/order_queue.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using Catch::Contains;

namespace {

struct Desk {
  explicit Desk(Executive& executive) : strand(executive, {"life", 0}) {}
  std::shared_ptr<Order> add(const std::string& name, Status result = ok()) {
    return orders.add([this, name, result] {
      carried_out.push_back(name);
      return result;
    });
  }
  Strand strand;
  OrderQueue orders{strand};
  std::vector<std::string> carried_out;
};

void with_desk(const std::function<void(Desk&)>& body) {
  run_on(virtual_executives().front(), [&](Executive& executive) {
    Desk desk(executive);
    body(desk);
  });
}

}  // namespace

TEST_CASE("orders are carried out one by one, the oldest first", "[host][orders]") {
  with_desk([](Desk& desk) {
    const auto first = desk.add("first");
    const auto second = desk.add("second");
    CHECK(desk.orders.waits());
    CHECK(desk.orders.carry_out_next());
    CHECK(first->done());
    CHECK_FALSE(second->done());
    CHECK(desk.orders.waits());
    CHECK(desk.orders.carry_out_next());
    CHECK_FALSE(desk.orders.waits());
    CHECK_FALSE(desk.orders.carry_out_next());
    CHECK(desk.carried_out == std::vector<std::string>{"first", "second"});
  });
}

TEST_CASE("the giver of an order gets its result", "[host][orders]") {
  with_desk([](Desk& desk) {
    const auto order = desk.add("first", fail(Code::invalid_argument, "low is above high"));
    (void)desk.orders.carry_out_next();
    REQUIRE(order->done());
    CHECK_THAT(order->result().error().text(), Contains("low is above high"));
  });
}

TEST_CASE("an order may give another one, which comes last", "[host][orders]") {
  with_desk([](Desk& desk) {
    const auto outer = desk.orders.add([&desk] {
      desk.add("inner");
      return ok();
    });
    desk.add("second");
    while (desk.orders.carry_out_next()) continue;
    CHECK(outer->result().ok());
    CHECK(desk.carried_out == std::vector<std::string>{"second", "inner"});
  });
}

TEST_CASE("an order that has not been begun can be withdrawn, and no other one", "[host][orders]") {
  with_desk([](Desk& desk) {
    const auto first = desk.add("first");
    const auto second = desk.add("second");
    CHECK(second->withdraw());
    CHECK_FALSE(second->withdraw());
    while (desk.orders.carry_out_next()) continue;
    CHECK_FALSE(first->withdraw());
    CHECK_FALSE(second->done());
    CHECK(desk.carried_out == std::vector<std::string>{"first"});
  });
}

TEST_CASE("an order cannot be withdrawn while it is carried out", "[host][orders]") {
  with_desk([](Desk& desk) {
    std::shared_ptr<Order> order;
    bool withdrawn = true;
    order = desk.orders.add([&] {
      withdrawn = order->withdraw();
      return ok();
    });
    (void)desk.orders.carry_out_next();
    CHECK_FALSE(withdrawn);
    CHECK(order->done());
  });
}

TEST_CASE("at the end the orders that wait and those that come later are refused by name", "[host][orders]") {
  with_desk([](Desk& desk) {
    const auto early = desk.add("early");
    desk.orders.refuse_all();
    const auto late = desk.add("late");
    for (const auto& order : {early, late}) {
      REQUIRE(order->done());
      CHECK(order->result().error().code == Code::failed_precondition);
      CHECK_THAT(order->result().error().text(), Contains("life") && Contains("it has ended"));
    }
    CHECK_FALSE(desk.orders.carry_out_next());
    CHECK(desk.carried_out.empty());
  });
}

TEST_CASE("an order can be given from another thread while the strand carries out others", "[host][orders]") {
  run_on({ClockKind::steady, Backend::thread}, [](Executive& executive) {
    Desk desk(executive);
    std::vector<std::shared_ptr<Order>> given;
    std::thread other([&] {
      for (int i = 0; i < 1000; ++i) given.push_back(desk.add(std::to_string(i)));
    });
    while (desk.carried_out.size() < 1000)
      if (!desk.orders.carry_out_next()) std::this_thread::yield();
    other.join();
    for (std::size_t i = 0; i < given.size(); ++i) {
      CHECK(given[i]->done());
      CHECK(desk.carried_out[i] == std::to_string(i));
    }
  });
}
