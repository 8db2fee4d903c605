// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>

#include "meshes.hpp"
#include "orca/sim/robot_file.hpp"
#include "orca/sim/world.hpp"
#include "orca/sim/world_file.hpp"
#include "scout.hpp"
#include "temp_folder.hpp"

using namespace orca::sim;
using namespace orca::sim::test;
using orca::test::TempFolder;

namespace {

std::string as_text_stl(const Mesh& mesh) {
  std::string text = "solid thing\n";
  for (const Triangle& t : mesh.triangles) {
    text += "facet normal 0 0 0\n outer loop\n";
    for (const Vec3& p : t)
      text +=
          "  vertex " + std::to_string(p.x) + ' ' + std::to_string(p.y) + ' ' + std::to_string(p.z) + '\n';
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid thing\n";
}

void append(std::string& bytes, const void* value, std::size_t size) {
  bytes.append(static_cast<const char*>(value), size);
}

std::string as_binary_stl(const Mesh& mesh) {
  std::string bytes = "solid, as some programs begin binary files";
  bytes.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  append(bytes, &count, 4);
  for (const Triangle& t : mesh.triangles) {
    bytes.append(12, '\0');
    for (const Vec3& p : t)
      for (const double value : {p.x, p.y, p.z}) {
        const auto narrow = static_cast<float>(value);
        append(bytes, &narrow, 4);
      }
    bytes.append(2, '\0');
  }
  return bytes;
}

// A cube of 1 m on the floor with four corners per face, in all notations of a corner.
const char* const kObjCube = R"(# a cube
o cube
v -0.5 -0.5 0
v 0.5 -0.5 0
v 0.5 0.5 0
v -0.5 0.5 0
v -0.5 -0.5 1
v 0.5 -0.5 1
v 0.5 0.5 1
v -0.5 0.5 1
vn 0 0 1
f 4 3 2 1
f 5/1 6/1 7/1 8/1
f 1//1 2//1 6//1 5//1
f -6 -5 -1 -2
f 2 3 7 6
f 4 1 5 8
)";

double area_of(const Outline& outline) {
  double twice = 0.0;
  for (const Segment& e : outline.edges) twice += cross(e.a, e.b);
  return 0.5 * twice;
}

// A table: a top of 1.2 x 0.8 m between 0.7 and 0.75 m, as a box mesh and as a box.
WorldModel table_of(bool mesh) {
  WorldModel world{"table", {}, {}};
  if (mesh) {
    world.obstacles.push_back(
        mesh_obstacle("table", placed(box_mesh(1.2, 0.8, 0.05), {1, 1, 1}, {2.0, 0.0, 0.0}, 0.7)));
  } else {
    world.obstacles.push_back({"table", Box{{2.0, 0.0, 0.0}, {0.6, 0.4}}, 0.75, 0.7});
  }
  return world;
}

// Returns how far a Scout gets when it drives ahead for ten seconds.
double way_through(const WorldModel& model, const RobotModel& robot, bool& touched) {
  World world(model, {.seed = 1, .realism = Realism::ideal});
  const RobotId id = *world.add_robot("dewey", robot, {});
  REQUIRE(world.set_velocity_command(id, 0.5, 0.0));
  touched = false;
  for (int i = 0; i < 1000; ++i) {
    world.step();
    touched = touched || !world.contacts().empty();
  }
  return world.pose(id).x;
}

}  // namespace

TEST_CASE("a mesh is the same from text STL, binary STL and OBJ", "[sim][mesh]") {
  const TempFolder folder;
  const Mesh cube = box_mesh(1.0, 1.0, 1.0);
  for (const auto& [name, bytes] : {std::pair<std::string, std::string>{"cube.stl", as_text_stl(cube)},
                                    {"cube.STL", as_binary_stl(cube)},
                                    {"cube.obj", kObjCube}}) {
    INFO(name);
    const auto mesh = read_mesh(folder.write(name, bytes));
    REQUIRE(mesh);
    CHECK(mesh->triangles.size() == 12);
    CHECK(height_range_of(*mesh) == std::pair(0.0, 1.0));
    CHECK(area_of(section_of(*mesh, 0.5)) == Approx(1.0));
  }
}

TEST_CASE("a mesh of a million faces is read, one more is refused", "[sim][mesh]") {
  const TempFolder folder;
  Mesh many;
  const Mesh cube = box_mesh(1.0, 1.0, 1.0);
  for (std::size_t i = 0; i < 1'000'000; ++i) many.triangles.push_back(cube.triangles[i % 12]);
  const auto mesh = read_mesh(folder.write("many.stl", as_binary_stl(many)));
  REQUIRE(mesh);
  CHECK(mesh->triangles.size() == 1'000'000);
  many.triangles.push_back(cube.triangles[0]);
  const auto refused = read_mesh(folder.write("too_many.stl", as_binary_stl(many)));
  REQUIRE_FALSE(refused);
  CHECK_THAT(refused.error().text(), Catch::Contains("more than 1000000 faces"));
}

TEST_CASE("a mesh with any damage is read or refused", "[sim][mesh]") {
  const TempFolder folder;
  orca::RandomStream random(4, "test", "damage");
  const Mesh cube = box_mesh(1.0, 1.0, 1.0);
  const std::array files{std::pair<std::string, std::string>{"cube.stl", as_text_stl(cube)},
                         std::pair<std::string, std::string>{"binary.stl", as_binary_stl(cube)},
                         std::pair<std::string, std::string>{"cube.obj", kObjCube}};
  int refused = 0;
  for (int i = 0; i < 1500; ++i) {
    auto [name, bytes] = files[static_cast<std::size_t>(i) % files.size()];
    const auto at = static_cast<std::size_t>(random.uniform(0.0, static_cast<double>(bytes.size())));
    if (i % 2 == 0) bytes.resize(at);
    if (i % 2 != 0) bytes[at] = static_cast<char>(random.uniform(0.0, 255.0));
    const auto mesh = read_mesh(folder.write(name, bytes));
    refused += mesh ? 0 : 1;
    if (mesh) CHECK(!mesh->triangles.empty());
    if (!mesh) CHECK(mesh.error().message.size() > 10);
  }
  CHECK(refused > 500);
}

TEST_CASE("the section of a closed mesh is closed and has its solid to the left, at every height",
          "[sim][mesh]") {
  orca::RandomStream random(3, "test", "boulder");
  const Mesh stone = boulder(random, {1.0, 2.0, 0.5}, 0.5);
  const auto [low, high] = height_range_of(stone);
  for (int i = 0; i < 200; ++i) {
    const Outline section = section_of(stone, random.uniform(low, high));
    // Each corner is the end of one edge and the beginning of another, bit for bit.
    for (const Segment& e : section.edges) CHECK(std::ranges::count(section.edges, e.b, &Segment::a) == 1);
    CHECK(area_of(section) > 0.0);
  }
  CHECK(section_of(stone, high).edges.empty());
  CHECK(section_of(stone, low - 0.01).edges.empty());
}

TEST_CASE("a plane through the corners of a mesh cuts the parts above it", "[sim][mesh]") {
  const Mesh cube = box_mesh(1.0, 1.0, 1.0);
  CHECK(area_of(section_of(cube, 0.0)) == Approx(1.0));
  CHECK(section_of(cube, 1.0).edges.empty());
}

TEST_CASE("a table top is seen at its own height only, box or mesh", "[sim][mesh][caster]") {
  const bool mesh = GENERATE(false, true);
  const Caster caster(table_of(mesh));
  const auto range_at = [&](double height) { return caster.cast({{0, 0}, {1, 0}, 10.0, height}).range; };
  CHECK(range_at(0.3) == 10.0);
  CHECK(range_at(0.69) == 10.0);
  CHECK(range_at(0.7) == Approx(1.4));
  CHECK(range_at(0.74) == Approx(1.4));
  CHECK(range_at(0.75) == 10.0);
}

TEST_CASE("all solids of a text STL are read", "[sim][mesh]") {
  const TempFolder folder;
  const std::string one = as_text_stl(box_mesh(1.0, 1.0, 1.0));
  const auto faces = [&](const std::string& text) {
    std::ofstream(folder.file("shelf.stl")) << text;
    const auto mesh = read_mesh(folder.file("shelf.stl"));
    return mesh ? mesh->triangles.size() : 0;
  };
  CHECK(faces(one) == 12);
  CHECK(faces(one + one + "\n\n") == 24);
  CHECK(faces(one + "facet\n") == 0);
}

TEST_CASE("a place under a table is one that a robot can get to, one in a solid mesh is not", "[sim][mesh]") {
  const auto errors = [](const std::string& elements) {
    orca::xml::Diagnostics diagnostics;
    static_cast<void>(read_world_text(
        "<world name=\"w\" version=\"1\">" + elements + "<place name=\"p\" x=\"0 m\" y=\"0 m\"/></world>",
        ORCA_SOURCE_DIR "/tests/data/worlds/w.xml", diagnostics));
    return diagnostics.text();
  };
  const std::string box = "<box x=\"0 m\" y=\"0 m\" length=\"1 m\" width=\"1 m\"";
  CHECK(errors(box + " bottom=\"0.7 m\"/>").empty());
  CHECK_THAT(errors(box + "/>"), Catch::Contains("error W012"));
  const TempFolder folder;
  std::ofstream(folder.file("cube.stl")) << as_text_stl(box_mesh(1.0, 1.0, 1.0));
  const std::string mesh = "<mesh file=\"" + folder.file("cube.stl") + "\" y=\"0 m\" x=\"";
  CHECK_THAT(errors(mesh + "0 m\"/>"), Catch::Contains("error W012"));
  CHECK(errors(mesh + "0.6 m\"/>").empty());
}

TEST_CASE("a robot passes under a table that is higher than itself, box or mesh", "[sim][mesh][world]") {
  const bool mesh = GENERATE(false, true);
  const WorldModel table = table_of(mesh);
  bool touched = false;
  CHECK(way_through(table, scout(), touched) > 4.0);
  CHECK_FALSE(touched);
  RobotModel tall = scout();
  tall.parts = {{Part::Cylinder{0.205, 0.8}, {.x = 0.0, .y = 0.0, .z = 0.45}}};
  std::tie(tall.bottom, tall.top) = height_range_of(tall.parts);
  CHECK(way_through(table, tall, touched) == Approx(1.4 - 0.205).margin(0.01));
  CHECK(touched);
  World world(table, {});
  CHECK(world.add_robot("under", scout(), {2.0, 0.0, 0.0}));
  CHECK_FALSE(world.add_robot("through", tall, {2.0, 0.3, 0.0}));
}

TEST_CASE("a robot is refused where it would stand in a mesh, also wholly inside, and not beside it",
          "[sim][mesh][world]") {
  WorldModel model{"w", {mesh_obstacle("house", box_mesh(4.0, 4.0, 2.0))}, {}};
  World world(model, {});
  CHECK_FALSE(world.add_robot("inside", scout(), {0.5, 0.5, 0.0}));
  CHECK_FALSE(world.add_robot("at the wall", scout(), {2.1, 0.0, 0.0}));
  CHECK(world.add_robot("beside", scout(), {2.3, 0.0, 0.0}));
}

TEST_CASE("a world file may hold a mesh, scaled, turned and lifted", "[sim][mesh][world_file]") {
  const TempFolder folder;
  folder.write("cube.obj", kObjCube);
  const std::string world =
      folder.write("w.xml",
                   "<world name='w' version='1'><mesh name='cube' file='cube.obj' x='3 m' "
                   "y='1 m' yaw='90 deg' z='0.2 m' scale='0.5'/></world>");
  orca::xml::Diagnostics diagnostics;
  const auto model = read_world(world, {}, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(model);
  const Obstacle& cube = model->obstacles.front();
  CHECK(cube.name == "cube");
  CHECK(cube.bottom == Approx(0.2));
  CHECK(cube.height == Approx(0.7));
  CHECK(Caster(*model).cast({{0, 1}, {1, 0}, 10.0, 0.3}).range == Approx(2.75));
  CHECK(Caster(*model).cast({{0, 1}, {1, 0}, 10.0, 0.1}).range == 10.0);
}

TEST_CASE("a robot's body may be a mesh: what counts is its convex hull", "[sim][mesh][robot_file]") {
  const TempFolder folder;
  folder.write("body.stl", as_binary_stl(box_mesh(0.4, 0.3, 0.2)));
  const std::string file = folder.write("r.urdf", R"x(<robot name="r"><link name="base">
<inertial><mass value="10"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="0.5"/></inertial>
<collision><origin xyz="0 0 0.1"/><geometry><mesh filename="body.stl" scale="1 1 2"/></geometry></collision>
</link><orca radius="0.3 m"><drive type="differential" max_speed="1 m/s" max_steer_speed="2 rad/s"
max_acceleration="1 m/s2" max_steer_acceleration="4 rad/s2" track="0.3 m" wheel_diameter="0.15 m"/></orca></robot>)x");
  orca::xml::Diagnostics diagnostics;
  const auto robot = read_robot(file, diagnostics);
  INFO(diagnostics.text());
  REQUIRE(robot);
  CHECK(std::get<Part::Hull>(robot->parts.front().form).corners.size() == 8);
  CHECK(robot->bottom == Approx(0.1));
  CHECK(robot->top == Approx(0.5));
  const Bounds plan = bounds_of(robot->footprint);
  CHECK(plan.high.x == Approx(0.2));
  CHECK(plan.high.y == Approx(0.15));
  bool touched = false;
  CHECK(way_through(test_room(), *robot, touched) == Approx(3.0 - 0.3 - 0.2).margin(0.01));
  CHECK(touched);
}
