// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/graph/port_list.hpp"

#include "loading.hpp"

using namespace orca::graph;

namespace {

const std::string kText =
    "<graph name='g'><hardware name='robot' type='orca.hw.Sim'/>"
    "<component name='base' type='orca.RobotBaseServer' hardware='robot'>"
    "<port name='OdometryPush' as='odom'/><port name='LimitsQuery' disabled='true'/></component>"
    "<component name='avoid' type='orca.SonarAvoid'/>"
    "<component name='fuser' type='orca.MotionCommandFuser'><port name='motion' "
    "candidates='avoid'/></component>"
    "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/><connect from='base.odom' "
    "to='avoid.odometry'/>"
    "<connect from='fuser.base' to='base.MotionCommandSend'/></graph>";

}  // namespace

TEST_CASE("every port is listed with its pattern, role, type and the other ends", "[graph][ports]") {
  FakeCatalogue catalogue;
  CHECK(
      ports_text(list_ports(must_load(kText), catalogue)) ==
      "base.MotionCommandSend       SendServer   MotionCommand            from fuser.base\n"
      "base.SonarRangeReadingsPush  PushServer   SonarRangeReadings       to avoid.sonar\n"
      "base.odom                    PushServer   Odometry                 to avoid.odometry\n"
      "base.LimitsQuery             QueryServer  LimitsRequest -> Limits  disabled\n"
      "avoid.sonar                  PushProxy    SonarRangeReadings       from base.SonarRangeReadingsPush\n"
      "avoid.odometry               PushProxy    Odometry                 from base.odom\n"
      "avoid.motion                 PushServer   MotionCommand            to fuser.motion\n"
      "fuser.motion[]               PushProxy    MotionCommand            one of avoid.motion, named at run "
      "time\n"
      "fuser.base                   SendProxy    MotionCommand            to base.MotionCommandSend\n"
      "fuser.ClientListSend         SendServer   ClientList               not connected\n");
}

TEST_CASE("the JSON form of a port holds the name that its author gave it", "[graph][ports]") {
  FakeCatalogue catalogue;
  const std::string json = ports_json(list_ports(must_load(kText), catalogue));
  CHECK(json.find("\"port\": \"base.odom\",\n    \"declared_as\": \"OdometryPush\"") != std::string::npos);
  CHECK(json.find("\"disabled\": true") != std::string::npos);
}

TEST_CASE("a connection between processes is listed with its link", "[graph][ports]") {
  FakeCatalogue catalogue;
  Graph graph = must_load(kText);
  graph.components[1].process = "behaviours";
  graph.edges[0].link = Link::shm;
  const std::vector<ListedPort> ports = list_ports(graph, catalogue);
  const std::string text = ports_text(ports);
  CHECK(text.find("SonarRangeReadings       to avoid.sonar (shm)\n") != std::string::npos);
  CHECK(text.find("SonarRangeReadings       from base.SonarRangeReadingsPush (shm)\n") != std::string::npos);
  CHECK(text.find("to avoid.odometry\n") != std::string::npos);
  const std::string json = ports_json(ports);
  CHECK(json.find("\"declared_as\": \"sonar\",\n    \"process\": \"behaviours\"") != std::string::npos);
  CHECK(json.find("\"links\": [\n      \"shm\"\n    ]") != std::string::npos);
}
