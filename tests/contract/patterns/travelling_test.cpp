// SPDX-License-Identifier: GPL-3.0-or-later
// The plain structs of the IDL files that travel on their own (ADR 0031): each by Push, Send and Query, over every link.
#include "all_objects.hpp"
#include "link_kits.hpp"
#include "random_object.hpp"

using namespace orca;
using namespace orca::test;

namespace {

template <class T>
struct Giver : Peer {
  explicit Giver(Executive& executive) : Peer(executive, "giver") {}
  PushServer<T> pushed{*this, "pushed"};
  SendProxy<T> sent{*this, "sent"};
  QueryProxy<T, T> asked{*this, "asked"};
};

// Keeps what is sent to it, and answers each question with the question's value.
template <class T>
struct StructTaker : Peer {
  explicit StructTaker(Executive& executive) : Peer(executive, "taker") {}

  Status on_sent(const ObjectPtr<T>& object) {
    kept = object;
    return ok();
  }
  Result<Loan<T>> on_asked(const ObjectPtr<T>& object) { return make_object(static_cast<const T&>(*object)); }

  ObjectPtr<T> kept;
  PushProxy<T> pushed{*this, "pushed"};
  SendServer<T> sent{*this, "sent", &StructTaker::on_sent};
  QueryServer<T, T> asked{*this, "asked", &StructTaker::on_asked};
};

template <class T>
void check_arrived(const ObjectPtr<T>& object, const T& value, const std::string& origin) {
  REQUIRE(object);
  CHECK(static_cast<const T&>(*object) == value);
  CHECK(object->origin() == origin);
  CHECK(object->seq() == 1);
  CHECK(object.ref().type().name == Reflection<T>::name);
}

template <class Kit, class T>
void check_push(Kit& kit, Giver<T>& giver, StructTaker<T>& taker, const T& value) {
  kit.connect(giver.endpoint("pushed"), taker.endpoint("pushed"));
  taker.pushed.subscribe();
  REQUIRE(eventually(kit.executive, [&] { return giver.pushed.subscriber_count() == 1; }));
  giver.pushed.push(value);
  check_arrived(taker.pushed.get_update_wait_max(5s), value, "giver");
}

template <class Kit, class T>
void check_send(Kit& kit, Giver<T>& giver, StructTaker<T>& taker, const T& value) {
  kit.connect(giver.endpoint("sent"), taker.endpoint("sent"));
  REQUIRE(giver.sent.send(value).ok());
  REQUIRE(eventually(kit.executive, [&] { return taker.handle_one(); }));
  check_arrived(taker.kept, value, "giver");
}

template <class Kit, class T>
void check_query(Kit& kit, Giver<T>& giver, StructTaker<T>& taker, const T& value) {
  kit.connect(giver.endpoint("asked"), taker.endpoint("asked"));
  const auto id = giver.asked.query_request(make_object(value));
  REQUIRE(id);
  REQUIRE(eventually(kit.executive, [&] { return taker.handle_one(); }));
  const auto answer = giver.asked.query_receive_wait(*id, 5s);
  REQUIRE(answer);
  check_arrived(*answer, value, "taker");
}

template <class T, class Kit>
void check_travels(Kit& kit) {
  INFO(Reflection<T>::name);
  const T value = random_object<T>(3);
  Giver<T> giver(kit.executive);
  StructTaker<T> taker(kit.executive);
  taker.open();
  check_push(kit, giver, taker, value);
  check_send(kit, giver, taker, value);
  check_query(kit, giver, taker, value);
}

template <class Kit, class... T>
void check_all_travel(Kit& kit, std::tuple<T...>*) {
  (check_travels<T>(kit), ...);
}

}  // namespace

TEMPLATE_LIST_TEST_CASE(
    "each plain struct that the thesis lets travel is pushed, sent, asked for and answered",
    "[contract][travelling]", LinkKits) {
  on_each_executive<TestType>(
      [](TestType& kit) { check_all_travel(kit, static_cast<TravellingStructs*>(nullptr)); });
}

CONTRACT_CASE("a WorldCoordinate6DOF at a port of WorldCoordinate3D arrives whole",
              "[contract][travelling]") {
  Giver<idl::WorldCoordinate3D> giver(kit.executive);
  StructTaker<idl::WorldCoordinate3D> taker(kit.executive);
  taker.open();
  kit.connect(giver.endpoint("sent"), taker.endpoint("sent"));
  const auto value = random_object<idl::WorldCoordinate6DOF>(5);
  REQUIRE(giver.sent.send(value).ok());
  REQUIRE(eventually(kit.executive, [&] { return taker.handle_one(); }));
  CHECK(taker.kept->point() == value.point());
  CHECK(taker.kept->origin() == "giver");
  const auto whole = taker.kept.template as<idl::WorldCoordinate6DOF>();
  REQUIRE(whole);
  CHECK(static_cast<const idl::WorldCoordinate6DOF&>(*whole) == value);
}
