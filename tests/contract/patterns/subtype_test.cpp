// SPDX-License-Identifier: GPL-3.0-or-later
// Objects of a derived type at ports that ask for its parent, for every link: they arrive whole.
#include "link_kits.hpp"
#include "orca/idl/navigation.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using idl::Door;
using idl::GoalPoint;
using idl::LaserRangeReadings;
using idl::RangeReadings;
using idl::SonarRangeReadings;

namespace {

Loan<Door> kitchen_door() {
  auto door = make_object<Door>();
  door->name() = "kitchen_door";
  door->reach_radius().distance(0.3);
  door->door_width().distance(0.95);
  door->passable(true);
  return door;
}

struct Guide : Peer {
  explicit Guide(Executive& executive) : Peer(executive, "guide") {}
  SendProxy<GoalPoint> goal{*this, "goal"};
  SendProxy<Door> door{*this, "door"};
};

struct Driver : Peer {
  explicit Driver(Executive& executive) : Peer(executive, "driver"), goal(*this, "goal", &Driver::on_goal) {}

  Status on_goal(const ObjectPtr<GoalPoint>& taken) {
    goals.push_back(taken);
    return ok();
  }

  std::vector<ObjectPtr<GoalPoint>> goals;
  SendServer<GoalPoint> goal;
};

struct DoorKeeper : Peer {
  explicit DoorKeeper(Executive& executive)
      : Peer(executive, "keeper"), door(*this, "door", &DoorKeeper::on_door) {}
  Status on_door(const ObjectPtr<Door>&) { return ok(); }
  SendServer<Door> door;
};

void check_whole(const ObjectPtr<GoalPoint>& goal) {
  REQUIRE(goal);
  CHECK(goal->name() == "kitchen_door");
  CHECK(goal.ref().type().name == "Door");
  const ObjectPtr<Door> door = goal.as<Door>();
  REQUIRE(door);
  CHECK(door->door_width().distance() == 0.95);
  CHECK(door->passable());
  CHECK(door->origin() == "guide");
}

struct Ranger : Peer {
  explicit Ranger(Executive& executive) : Peer(executive, "ranger") {}
  PushServer<SonarRangeReadings> sonar{*this, "sonar"};
  PushServer<LaserRangeReadings> laser{*this, "laser"};
  PushServer<RangeReadings> any{*this, "any"};
};

struct Viewer : Peer {
  explicit Viewer(Executive& executive) : Peer(executive, "viewer") {}

  template <class Kit>
  void view(Kit& kit, const Ranger& ranger, const std::string& port, const PushServerHandle& server) {
    kit.connect(ranger.endpoint(port), endpoint("ranges"));
    ranges.subscribe();
    REQUIRE(eventually(executive(), [&] { return server.subscriber_count() == 1; }));
  }

  PushProxy<RangeReadings> ranges{*this, "ranges"};
};

// Answers with a door if it is asked for one.
struct Porter : Peer {
  explicit Porter(Executive& executive)
      : Peer(executive, "porter"), where(*this, "where", &Porter::on_where) {}
  Result<Loan<Door>> on_where(const ObjectPtr<GoalPoint>& asked) {
    if (!asked.as<Door>()) return fail(Code::not_found, "that is no door");
    return copy_value(asked.as<Door>());
  }
  QueryServer<GoalPoint, Door> where;
};

struct Visitor : Peer {
  explicit Visitor(Executive& executive) : Peer(executive, "visitor") {}
  QueryProxy<Door, GoalPoint> where{*this, "where"};
};

struct Lodger : Peer {
  explicit Lodger(Executive& executive)
      : Peer(executive, "lodger"), where(*this, "where", &Lodger::on_where) {}
  Result<Loan<GoalPoint>> on_where(const ObjectPtr<GoalPoint>& asked) { return copy_value(asked); }
  QueryServer<GoalPoint, GoalPoint> where;
};

struct DoorSeeker : Peer {
  explicit DoorSeeker(Executive& executive) : Peer(executive, "seeker") {}
  QueryProxy<GoalPoint, Door> where{*this, "where"};
};

}  // namespace

CONTRACT_CASE("a Door that is sent as a GoalPoint arrives as a Door", "[contract][subtype]") {
  Guide guide(kit.executive);
  Driver driver(kit.executive);
  kit.connect(guide.endpoint("goal"), driver.endpoint("goal"));
  driver.open();
  REQUIRE(guide.goal.send(kitchen_door()).ok());
  REQUIRE(guide.goal.send(*kitchen_door()).ok());
  REQUIRE(guide.goal.send(make_object<GoalPoint>()).ok());
  while (driver.handle_one()) continue;
  REQUIRE(driver.goals.size() == 3);
  check_whole(driver.goals[0]);
  check_whole(driver.goals[1]);
  CHECK(driver.goals[2].ref().type().name == "GoalPoint");
  CHECK_FALSE(driver.goals[2].template as<Door>());
}

CONTRACT_CASE("a port of Doors may be connected to one that takes GoalPoints", "[contract][subtype]") {
  Guide guide(kit.executive);
  Driver driver(kit.executive);
  kit.connect(guide.endpoint("door"), driver.endpoint("goal"));
  driver.open();
  REQUIRE(guide.door.send(kitchen_door()).ok());
  CHECK(driver.handle_one());
  check_whole(driver.goals.at(0));
}

CONTRACT_CASE("a subscriber to RangeReadings may be connected to sonar or laser", "[contract][subtype]") {
  Ranger ranger(kit.executive);
  Viewer at_sonar(kit.executive);
  at_sonar.view(kit, ranger, "sonar", ranger.sonar);
  auto echoes = ranger.sonar.loan();
  echoes->ranges() = {1.5, 2.5};
  echoes->half_lobe(0.2);
  ranger.sonar.push(std::move(echoes));
  const auto heard = at_sonar.ranges.get_update_wait_max(5s);
  REQUIRE(heard);
  CHECK(heard->ranges() == std::vector{1.5, 2.5});
  REQUIRE(heard.template as<SonarRangeReadings>());
  CHECK(heard.template as<SonarRangeReadings>()->half_lobe() == 0.2);
  CHECK_FALSE(heard.template as<LaserRangeReadings>());

  Viewer at_laser(kit.executive);
  at_laser.view(kit, ranger, "laser", ranger.laser);
  auto scan = ranger.laser.loan();
  scan->angle_increment(0.01);
  ranger.laser.push(std::move(scan));
  const auto seen = at_laser.ranges.get_update_wait_max(5s);
  REQUIRE(seen.template as<LaserRangeReadings>());
  CHECK(seen.template as<LaserRangeReadings>()->angle_increment() == 0.01);
}

CONTRACT_CASE("one server may push objects of several derived types", "[contract][subtype]") {
  Ranger ranger(kit.executive);
  Viewer viewer(kit.executive);
  viewer.view(kit, ranger, "any", ranger.any);
  ranger.any.push(make_object<SonarRangeReadings>());
  CHECK(viewer.ranges.get_update_wait_max(5s).ref().type().name == "SonarRangeReadings");
  ranger.any.push(idl::LaserRangeReadings());
  CHECK(viewer.ranges.get_update_wait_max(5s).ref().type().name == "LaserRangeReadings");
  ranger.any.push(RangeReadings());
  CHECK(viewer.ranges.get_update_wait_max(5s).ref().type().name == "RangeReadings");
}

CONTRACT_CASE("a question may be of a derived type, and so may the answer", "[contract][subtype]") {
  Visitor visitor(kit.executive);
  Porter porter(kit.executive);
  kit.connect(visitor.endpoint("where"), porter.endpoint("where"));
  porter.open();
  const auto id = visitor.where.query_request(kitchen_door());
  REQUIRE(id);
  REQUIRE(eventually(kit.executive, [&] { return porter.handle_one(); }));
  const auto answer = visitor.where.query_receive_wait(*id, 5s);
  REQUIRE(answer);
  CHECK((*answer).template as<Door>()->door_width().distance() == 0.95);
}

TEMPLATE_LIST_TEST_CASE("ends whose types do not fit in their direction are not connected",
                        "[contract][subtype]", LinkKits) {
  ExecutiveOptions options = TestType::executives().front();
  run_on_each({options}, [](Executive& executive) {
    LocalLinks links;
    Guide guide(executive);
    DoorKeeper keeper(executive);
    const Status refused = links.connect(guide.endpoint("goal"), keeper.endpoint("door"));
    REQUIRE_FALSE(refused.ok());
    CHECK_THAT(refused.error().text(), Contains("guide.goal (SendProxy of GoalPoint)") &&
                                           Contains("keeper.door (SendServer of Door)"));
    DoorSeeker seeker(executive);
    Lodger lodger(executive);
    CHECK_FALSE(links.connect(seeker.endpoint("where"), lodger.endpoint("where")).ok());
  });
}
