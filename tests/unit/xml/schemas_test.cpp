// SPDX-License-Identifier: GPL-3.0-or-later
// The schemas that are shipped for editors, beside those of graphs, are what the readers' rules give. With ORCA_APPROVE=1 they are
// written anew.
#include <catch2/catch.hpp>
#include <filesystem>

#include "approval.hpp"
#include "batch/experiment/rules.hpp"
#include "files/world/world_rules.hpp"
#include "orca/robot_file/rules.hpp"
#include "orca/xml/schema.hpp"
#include "task_tree/task_rules.hpp"

namespace {

void check_shipped(const char* file, const orca::xml::FileRules& rules,
                   const orca::xml::SchemaOptions& options) {
  const std::filesystem::path xsd = std::filesystem::path(ORCA_SOURCE_DIR) / file;
  orca::test::check_approved(xsd, schema(rules, options));
  std::filesystem::path rnc = xsd;
  orca::test::check_approved(rnc.replace_extension(".rnc"),
                             schema(rules, options, orca::xml::SchemaLanguage::rnc));
}

}  // namespace

TEST_CASE("the schemas of worlds, robots, experiments and tasks are those of the readers' rules",
          "[xml][schema]") {
  check_shipped("sim/worlds/orca-world.xsd", orca::sim::detail::kWorldFile, {.title = "Orca's worlds"});
  check_shipped("sim/experiments/orca-experiment.xsd", orca::batch::kExperimentFile,
                {.title = "Orca's experiments"});
  check_shipped("graphs/tasks/orca-task.xsd", orca::tasks::kTaskFile, {.title = "Orca's tasks"});
  // The elements of URDF itself are not Orca's; any content of theirs is allowed.
  check_shipped("sim/robots/orca-robot.xsd", orca::robot_file::kRobotFile,
                {.title = "Orca's robots, which are URDF with an element <orca>",
                 .others = {"link", "joint", "material", "transmission", "gazebo", "sensor"}});
}

TEST_CASE("a schema names a second element of one name after its parent", "[xml][schema]") {
  const std::string text = schema(orca::sim::detail::kWorldFile, {.title = "Worlds"});
  CHECK(text.find("<xs:complexType name=\"door\">") != std::string::npos);
  CHECK(text.find("<xs:element name=\"door\" type=\"door_in_room\"/>") != std::string::npos);
}

TEST_CASE("a schema says the range of a number, and which units it may have", "[xml][schema]") {
  const std::string text = schema(orca::robot_file::kRobotFile, {.title = "Robots"});
  CHECK(text.find("<xs:documentation>More than 0 to 100000 m.</xs:documentation>") != std::string::npos);
  CHECK(text.find("(m/s|mm/s|cm/s|km/h)") != std::string::npos);
}
