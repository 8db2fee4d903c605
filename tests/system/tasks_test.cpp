// SPDX-License-Identifier: GPL-3.0-or-later
// Robots that do tasks, in a world that is not as it should be.
#include <catch2/catch.hpp>

#include <chrono>
#include <string>

#include "deployer.hpp"
#include "operated.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using Catch::EndsWith;
using Catch::StartsWith;
using namespace std::chrono_literals;

namespace {

/// Runs of graphs/pioneer_tasks.xml in an office in which something happens.
struct Office {
  TempFolder folder{};
  std::string events{};  // elements of a world file

  [[nodiscard]] Run run(const Words& more = {}) const {
    std::string world = read_text(source_file("sim/worlds/office.xml"));
    world.insert(world.rfind("</world>"), events);
    return run_deployer(
        Words{source_file("graphs/pioneer_tasks.xml"), "--set", "world=" + folder.write("office.xml", world),
              "--set", "map=" + source_file("sim/worlds/office.xml")} +
            virtual_clock() + more,
        Seconds(120));
  }

  [[nodiscard]] Run run_task(const std::string& steps, const Words& more = {}) const {
    const std::string text = "<task name=\"test\" version=\"1\">\n" + steps + "\n</task>\n";
    return run(Words{"--set", "task=" + folder.write("task.xml", text)} + more);
  }
};

std::string shut(double x, double y) {
  return "<box name=\"leaf\" x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(y) +
         "\" length=\"1\" width=\"0.08\" height=\"2 m\" comes=\"1 s\"/>";
}

Words with_task(const std::string& task) {
  return {source_file("graphs/pioneer_tasks.xml"), "--set", "task=" + source_file("graphs/tasks/" + task)};
}

}  // namespace

TEST_CASE("a robot takes visitors on a tour", "[system][tasks]") {
  const Run run = Office{}.run();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"kitchen", "library", "office_2", "start"});
  CHECK(run.contacts().empty());
  CHECK(run.says("This is the library."));
}

TEST_CASE("a room whose door is shut is left out, and said so", "[system][tasks]") {
  const Run run = Office{.events = shut(3.6, 7.0)}.run();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"library", "office_2", "start"});
  CHECK(run.says("The kitchen cannot be reached today."));
  CHECK(run.contacts().empty());
}

TEST_CASE("a robot whose way back is blocked asks people to clear it", "[system][tasks]") {
  const Run run = Office{.events = R"(<box name="crate" x="1" y="6" length="0.8" width="0.8" height="1 m"
    comes="40 s"/>)"}
                      .run({"--set", "pilot.blocked_after=4 s", "--until", "200 s"});
  INFO(run.out << run.err);
  CHECK(run.says("alarm BLOCKED: \"start\" was not reached"));
  CHECK(run.says("alarm QUESTION: I cannot get on. Please clear my way."));
  CHECK(run.contacts().empty());
}

TEST_CASE("a room with another door is reached by that", "[system][tasks]") {
  const Run run = Office{.events = shut(9.0, 5.0)}.run_task(R"(<Drive to="office_2" within="120 s"/>)");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"office_2"});
  CHECK(run.contacts().empty());
  CHECK(run.says("\"office_2_door\" is shut"));
  CHECK(run.says("another way to \"office_2\": by workshop_door, office_workshop_door (mission 1)"));
}

TEST_CASE("a robot waits at the only door of a room, and drives on when somebody opens it",
          "[system][tasks]") {
  const Office office{
      .events = R"(<leaf name="kitchen_door" from="3.125 7" to="4.075 7" kind="slides" starts="open"/>
    <shut of="kitchen_door" at="1 s"/><open of="kitchen_door" at="25 s"/>)"};
  const Run run = office.run_task(R"(<Drive to="kitchen" within="120 s"/>)");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.goals() == Words{"kitchen"});
  CHECK(run.arrivals().back().t > 25.0);
  CHECK(run.arrivals().back().t < 45.0);
  CHECK(run.contacts().empty());
}

TEST_CASE("a robot passes a door that is 10 cm wider than it is, from three directions", "[system][tasks]") {
  const std::string world = source_file("sim/worlds/narrow_door.xml");
  for (const std::string place : {"straight", "aside_30", "aside_60"}) {
    const Run run = run_deployer(
        Words{source_file("graphs/pioneer_tasks.xml"), "--set", "world=" + world, "--set", "map=" + world,
              "--set", "places=" + world, "--set", "ways=" + source_file("sim/ways/narrow_door.xml"), "--set",
              "task=" + source_file("sim/experiments/tasks/through.xml"), "--set", "place=" + place} +
            virtual_clock(),
        Seconds(60));
    INFO(place << run.err);
    CHECK(run.exit_code() == 0);
    CHECK(run.goals() == Words{"goal"});
    CHECK(run.contacts().empty());
  }
}

TEST_CASE("a robot that waits at a shut door gives up in time, and says so", "[system][tasks]") {
  const Run run = Office{.events = shut(3.6, 7.0)}.run_task(R"(<Drive to="kitchen" within="120 s"/>)");
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("waits at a door on the way to \"kitchen\": it is shut or too narrow"));
  CHECK(run.says("blocked: by \"traverse\", a door on the way to \"kitchen\" has stayed shut (mission 1)"));
}

TEST_CASE("a leg that is blocked though its door is open is given up for another way", "[system][tasks]") {
  const Office office{.events =
                          R"(<cylinder name="bin" x="9" y="4.3" radius="20 cm" height="1 m" comes="1 s"/>)"};
  const Run run = office.run_task(R"(<Drive to="office_2" within="240 s"/>)");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"office_2"});
  CHECK(run.says("another way to \"office_2\" after it was blocked"));
  CHECK(run.contacts().empty());
}

TEST_CASE("a task that nothing can save fails with its cause and its mission", "[system][tasks]") {
  const Run run = Office{.events = shut(3.6, 7.0)}.run_task(
      R"(<Drive to="library"/><Drive to="kitchen" within="20 s"/>)");
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("timed out: not reached within 20 s (mission 2)"));
}

TEST_CASE("a robot that is carried off looks around and goes on; if it may not wait, the task can",
          "[system][tasks]") {
  const Office office{.events = R"(<kidnap robot="Pioneer" at="8 s" x="14" y="6"/>)"};
  const std::string drives = R"(<Drive to="kitchen"/><Drive to="library"/>)";
  const Run run = office.run_task(drives);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"kitchen", "library"});

  const Words impatient{"--set", "pilot.lost_wait=0 s"};
  const Run waits = office.run_task("<Try>" + drives + R"(<Catch reason="lost" then="resume" times="3">
    <Check when="localization.state is LOCALIZATION_LOCALIZED" within="30 s"/></Catch></Try>)",
                                    impatient);
  INFO(waits.err);
  CHECK(waits.exit_code() == 0);
  CHECK(waits.goals() == Words{"kitchen", "library"});

  const Run without = office.run_task(drives, impatient);
  INFO(without.err);
  CHECK(without.exit_code() == 1);
  CHECK(without.says("lost: it is not known any more where the robot is (mission 1)"));
}

TEST_CASE("a robot that patrols goes to charge in time, and on from where it was", "[system][tasks]") {
  // The second one is as if it had been charged for ten minutes.
  const Office office{
      .events =
          R"(<drain robot="Pioneer" at="20 s" to="24 %"/><drain robot="Pioneer" at="100 s" to="90 %"/>)"};
  const Words patrol{"--set", "task=" + source_file("graphs/tasks/patrol.xml")};
  const Run run = office.run(patrol + Words{"--until", "260 s"});
  INFO(run.err);
  const Words reached = run.goals();
  REQUIRE(reached.size() > 3);
  CHECK(reached[0] == "kitchen");
  CHECK(reached[1] == "before_dock");
  CHECK(reached[2] == "dock");
  CHECK(reached[3] == "library");
  CHECK(run.says("I go on."));
  CHECK(run.contacts().empty());  // That of the charger is none.

  // Without a Dock nobody brings it to the contacts, where the other one is after 68 s.
  const Run alone = office.run(patrol + Words{"--set", "dock.docks=nowhere", "--until", "120 s"});
  INFO(alone.err);
  CHECK(alone.exit_code() == 0);
  CHECK(alone.goals() == Words{"kitchen"});
  CHECK_FALSE(alone.says("I go on."));
  CHECK(alone.contacts().empty());

  // Without that handler it stands somewhere with an empty battery.
  std::string text = read_text(source_file("graphs/tasks/patrol.xml"));
  const auto begin = text.find("<On when=\"battery");
  text.erase(begin, text.find("</On>", begin) + 5 - begin);
  const Run bare = Office{.events = R"(<drain robot="Pioneer" at="20 s" to="0.3 %"/>)"}.run(
      {"--set", "task=" + office.folder.write("bare.xml", text), "--until", "200 s"});
  INFO(bare.err);
  REQUIRE_FALSE(bare.arrivals().empty());
  CHECK(bare.arrivals().back().t < 150.0);
  CHECK(bare.says("the time limit has ended the run"));
}

TEST_CASE("a robot whose charger does not charge tries three times, and says so", "[system][tasks]") {
  std::string world = read_text(source_file("sim/worlds/office.xml"));
  const std::string charger = R"(<charger place="dock" reach="3 cm" touch="front"/>)";
  REQUIRE(world.find(charger) != std::string::npos);
  world.erase(world.find(charger), charger.size());
  const TempFolder folder;
  const std::string task = "<task name=\"test\" version=\"1\"><Drive to=\"dock\" within=\"200 s\"/></task>";
  const Run run = run_deployer(Words{source_file("graphs/pioneer_tasks.xml"), "--set", "place=corridor_east",
                                     "--set", "world=" + folder.write("office.xml", world), "--set",
                                     "task=" + folder.write("task.xml", task)} +
                               virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("undone: the battery is not charged there; is the charger on, and are its contacts clean?"));
  CHECK(run.contacts().size() == 3);  // This world knows of no charger there.
}

TEST_CASE("a robot that patrols reports the room in which something has changed, and no other",
          "[system][tasks]") {
  const Words patrol{"--set", "task=" + source_file("graphs/tasks/patrol.xml"), "--until", "60 s"};
  const std::string crates =
      R"(<box name="crate" x="2.6" y="10.4" length="1.2" width="0.8" height="1 m" comes="1 s"/>
    <box name="crate_2" x="5.3" y="9.2" length="0.6" width="0.9" height="1 m" comes="1 s"/>)";
  const Run changed = Office{.events = crates}.run(patrol);
  INFO(changed.err);
  CHECK(changed.goals() == Words{"kitchen", "library"});
  CHECK(changed.says("kitchen: something has changed"));
  CHECK_FALSE(changed.says("library: something has changed"));
  CHECK_FALSE(Office{}.run(patrol).says("something has changed"));
}

TEST_CASE("a task goes on where it was when its code is exchanged, and obeys an operator",
          "[system][tasks]") {
  Operated robot(with_task("tour.xml"));
  robot.step("30s");  // on the way to the library
  CHECK_THAT(robot.order(Words{"swap", "task", ORCA_BINARY_DIR "/plugins/task_tree.so"} + kBriefly).out,
             Contains("orca.TaskTree/2"));
  const std::string tree = robot.order({"tasks"}).out;
  CHECK_THAT(tree, Contains("task: tour, on the way"));
  CHECK_THAT(tree, Contains("done            Drive to=kitchen"));
  CHECK_THAT(tree, Contains("now             Drive to=library"));
  const std::string json = robot.order({"tasks", "--json"}).out;
  CHECK_THAT(json, StartsWith("[\n") && EndsWith("]\n") && Contains("\"component\": \"task\""));
  CHECK_THAT(json, Contains("\"phase\": \"running\"") && Contains("\"text\": \"Drive to=library"));
  CHECK_THAT(robot.refused({"set", "task.behaviours", "pilot; avoit"}),
             Contains("no behaviour \"avoit\" is connected"));
  robot.step("50s");  // on the way to the office
  robot.order({"tasks", "skip"});
  robot.order({"tasks", "pause"});
  robot.step("60s");
  CHECK_THAT(robot.order({"tasks"}).out, Contains("task: tour, paused"));
  robot.order({"tasks", "resume"});
  const Run run = robot.to_the_end();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"kitchen", "library", "start"});
  CHECK(run.arrivals().back().t > 130.0);
  CHECK(run.says("skipped: Drive to=office_2"));
}

TEST_CASE("a robot delivers a letter when people say that it is there and taken", "[system][tasks]") {
  Operated robot(with_task("deliver.xml"));
  robot.step("10s");
  CHECK_THAT(robot.refused({"tasks", "yes"}), Contains("the task asks nothing now"));
  CHECK_THAT(robot.refused({"tasks", "resume"}), Contains("the task is not paused"));
  robot.step("30s");
  CHECK_THAT(run_orcactl({"alarms"}).out, Contains("Please put the letter on me. Is it there?"));
  robot.order({"tasks", "yes"});
  robot.step("60s");
  CHECK_THAT(run_orcactl({"alarms"}).out, Contains("Have you taken it?"));
  robot.order({"tasks", "yes"});
  const Run run = robot.to_the_end();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK_FALSE(run.says("refused: "));  // nor does anybody ask for a route before the world is known
  CHECK(run.goals() == Words{"office_2", "kitchen", "start"});
  CHECK(run.says("The letter is delivered."));
}

TEST_CASE("an operator sends a robot here and there, and sees how far it is and why it waits",
          "[system][tasks]") {
  Operated robot(Words{source_file("graphs/pioneer_localize.xml")});
  robot.step("5s");
  CHECK_THAT(robot.order({"go"}).out,
             Contains("command: on the way to kitchen, ") && Contains(" m left; then office_2, meeting"));
  const std::string json = robot.order({"go", "--json"}).out;
  CHECK_THAT(json, StartsWith("[\n") && EndsWith("]\n") && Contains("\"going_to\": \"kitchen\""));
  CHECK_THAT(json, Contains("\"left\": ") && Contains("\"missed\": 0"));
  robot.order({"go", "library"});
  robot.order({"go", "--queue", "2", "6"});
  CHECK_THAT(robot.order({"go"}).out,
             Contains("on the way to library, ") && Contains("then point_1") &&
                 Contains("the last one: kitchen: cancelled: there are other goals"));
  robot.order(Words{"swap", "command", ORCA_BINARY_DIR "/plugins/command.so"} + kBriefly);
  CHECK_THAT(robot.order({"go"}).out, Contains("on the way to library, ") && Contains("then point_1"));
  robot.step("55s");
  CHECK_THAT(robot.order({"go"}).out, Contains("command: no goal; the last one: point_1: reached"));

  CHECK_THAT(robot.refused({"go", "kichen"}), Contains("did you mean \"kitchen\"?"));
  CHECK_THAT(robot.refused({"go", "3"}), Contains("needs two of them: orcactl go 3.2 4"));

  robot.order({"go", "--repeat", "kitchen", "library"});
  robot.order({"go", "--cancel"});
  CHECK_THAT(robot.order({"go"}).out, Contains("command: no goal"));
  REQUIRE(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(robot.program, Seconds(20)).goals() == Words{"library", "point_1"});
}

TEST_CASE("a letter that nobody hands over is not delivered, and the robot comes back and says so",
          "[system][tasks]") {
  const Run run = Office{}.run({"--set", "task=" + source_file("graphs/tasks/deliver.xml")});
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.goals() == Words{"office_2", "start"});
  CHECK(run.says("Nobody answers. I ask again in a minute."));
  CHECK(run.says("no answer: \"Please put the letter on me. Is it there?\""));
}

TEST_CASE("a robot looks for a can at three places, and brings it to the table", "[system][tasks]") {
  const Run run = run_deployer(Words{source_file("graphs/pioneer_fetch_task.xml")} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"near_kitchen_can", "near_library_can", "library_can", "near_meeting_table",
                             "meeting_table", "start"});
  CHECK(run.says("Pioneer has taken 'can'"));
  CHECK(run.says("Pioneer has put down 'can' at (13."));
  CHECK(run.contacts().empty());
}

TEST_CASE("a robot that finds no can anywhere comes back and says so", "[system][tasks]") {
  const Run run = run_deployer(Words{source_file("graphs/pioneer_fetch_task.xml"), "--set",
                                     "world=" + source_file("sim/worlds/office.xml")} +
                               virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.goals() == Words{"near_kitchen_can", "near_library_can", "near_office_2_can", "start"});
  CHECK(run.says("I have not brought the can. I come back."));
  CHECK(
      run.says("task: work() failed: undone: nothing came between the paddles where the thing should stand "
               "(mission 3)"));
  CHECK(run.contacts().empty());
}

TEST_CASE("a robot that stands where it is to fetch something tries at once", "[system][tasks]") {
  const TempFolder folder;
  const std::string task = folder.write("task.xml",
                                        "<task name=\"test\" version=\"1\"><Retry attempts=\"2\">"
                                        "<Drive to=\"kitchen_can\" within=\"100 s\"/></Retry></task>");
  const Run run = run_deployer(Words{source_file("graphs/pioneer_fetch_task.xml"), "--set", "task=" + task} +
                               virtual_clock());
  INFO(run.err);
  CHECK(run.says("where the thing should stand (mission 1)"));
  CHECK(run.says("where the thing should stand (mission 2)"));
}

TEST_CASE("a robot sees all of a building that it can reach, comes back, and waits for the map to be saved",
          "[system][tasks]") {
  const Words store{source_file("graphs/pioneer_map.xml"), "--set",
                    "world=" + source_file("sim/worlds/store.xml")};
  const auto floor_known = [](const Run& run) {
    const std::size_t at = run.err.find(" m2 are known to be free");
    REQUIRE(at != std::string::npos);
    return std::stoi(run.err.substr(run.err.rfind(' ', at - 1) + 1));
  };
  const Run run = run_deployer(store + virtual_clock(), Seconds(120));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
  REQUIRE_FALSE(run.arrivals().empty());
  CHECK(run.arrivals().back().name == "explore");
  CHECK(run.arrivals().back().x == Approx(0.9).margin(0.25));
  CHECK(run.arrivals().back().y == Approx(3.6).margin(0.25));
  CHECK(run.says("Please save the map"));
  CHECK(floor_known(run) >= 41);  // of 48 m2 with walls and furniture

  const Run stays = run_deployer(store + Words{"--set", "explorer.least_width=100 m"} + virtual_clock());
  INFO(stays.err);
  CHECK(floor_known(stays) < 30);
}

TEST_CASE("a border of the map that cannot be reached is left out, and the robot goes on and comes back",
          "[system][tasks]") {
  const TempFolder folder;
  std::string world = read_text(source_file("sim/worlds/store.xml"));
  world.insert(world.rfind("</world>"),  // too low for the laser, too high for the robot
               R"(<box name="kerb" x="4 m" y="4.5 m" length="0.2 m" width="1 m" height="0.1 m"/>)");
  const Run run = run_deployer(
      Words{source_file("graphs/pioneer_map.xml"), "--set", "world=" + folder.write("world.xml", world)} +
          virtual_clock(),
      Seconds(120));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("m is left out: "));
  CHECK(run.says("nothing new can be reached"));
  REQUIRE_FALSE(run.arrivals().empty());
  CHECK(run.arrivals().back().name == "explore");
}

TEST_CASE("a task whose pilot has failed stands, asks for help, and has failed if nobody comes",
          "[system][tasks]") {
  const Run run = Office{}.run({"--fail", "pilot=throw@25s"});
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.goals() == Words{"kitchen"});
  CHECK(run.says("alarm QUESTION: My pilot has failed, and I stand."));
  CHECK(run.says("task: work() failed: no answer: \"My pilot has failed"));
}

TEST_CASE("all faults of a task file are reported with their places before the robot starts",
          "[system][tasks]") {
  const TempFolder folder;
  const std::string task = folder.write("bad.xml", R"(<task name="bad" version="1">
  <Drve to="kitchen"/>
  <Repeat><Say text="for ever"/></Repeat>
</task>)");
  const std::string lost = folder.write("lost.xml", R"(<task name="lost" version="1">
  <Drive to="kitchn"/>
  <Drive to="library"/>
  <Drive to="hall > libary"/>
  <Drve to="kitchen"/>
</task>)");
  const std::string never = folder.write("never.xml", R"(<task name="never" version="1">
  <Check when="localization.state is LOCALIZATION_LOCALISED" within="5 s"/>
</task>)");
  const Words check{"--check", source_file("graphs/pioneer_tasks.xml"), "--set"};
  const Run faults = run_deployer(check + Words{"task=" + task});
  CHECK(faults.exit_code() == kRefusedByComponent);
  CHECK_THAT(faults.err, Contains(task + ":2:3: error K002") && Contains("did you mean \"Drive\""));
  CHECK_THAT(faults.err, Contains(task + ":3:3: error K013"));
  const Run places = run_deployer(check + Words{"task=" + lost});
  CHECK_THAT(places.err, Contains(lost + ":2:3: error K010") && Contains("did you mean \"kitchen\""));
  CHECK_THAT(places.err, Contains(lost + ":4:3: error K010") && Contains(lost + ":5:3: error K002"));
  const Run words = run_deployer(check + Words{"task=" + never});
  CHECK(words.exit_code() == kRefusedByComponent);
  CHECK_THAT(words.err,
             Contains(never + ":2:16: error K009") && Contains("did you mean \"LOCALIZATION_LOCALIZED\""));
}
