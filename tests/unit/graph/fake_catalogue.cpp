// SPDX-License-Identifier: GPL-3.0-or-later
#include "fake_catalogue.hpp"

using namespace orca;

namespace {

PortContract port(const char* name, Pattern pattern, Role role, const char* type) {
  PortContract result;
  result.name = name;
  result.pattern = pattern;
  result.role = role;
  result.type = {type, 0x1000, std::string(type) + "{ranges:sequence<double> {m},half_lobe:double {rad}}"};
  return result;
}

PortContract pushes(const char* name, const char* type) {
  return port(name, Pattern::push, Role::server, type);
}
PortContract reads(const char* name, const char* type) {
  PortContract result = pushes(name, type);
  result.from_device = true;
  return result;
}
PortContract receives(const char* name, const char* type) {
  return port(name, Pattern::push, Role::proxy, type);
}
PortContract sends(const char* name, const char* type) {
  return port(name, Pattern::send, Role::proxy, type);
}
PortContract accepts(const char* name, const char* type) {
  return port(name, Pattern::send, Role::server, type);
}

PortContract query(const char* name, Role role, const char* request, const char* reply) {
  PortContract result = port(name, Pattern::query, role, request);
  result.reply = TypeId{reply, 0x2000, std::string(reply) + "{}"};
  return result;
}

// Makes the object of a port extend a type that other ports name.
PortContract derived(PortContract result, const char* parent) {
  result.type.ancestors = {pushes("", parent).type};
  return result;
}

PortContract required(PortContract result) {
  result.required = true;
  return result;
}

PortContract many(PortContract result) {
  result.many = true;
  return result;
}

ParamContract real(const char* name, const char* unit, double min, double max, double value) {
  ParamContract result;
  result.name = name;
  result.unit = unit;
  result.min = min;
  result.max = max;
  result.default_value = value;
  return result;
}

ParamContract param(const char* name, ParamType type, ParamValue value) {
  ParamContract result;
  result.name = name;
  result.type = type;
  result.default_value = std::move(value);
  return result;
}

ParamContract choice(const char* name, std::vector<std::string> choices) {
  ParamContract result = param(name, ParamType::text, choices.front());
  result.choices = std::move(choices);
  return result;
}

ParamContract file(const char* name) {
  ParamContract result = param(name, ParamType::text, std::string());
  result.file = true;
  return result;
}

Contract component(const char* type, std::vector<PortContract> ports,
                   std::vector<ParamContract> params = {}) {
  Contract result;
  result.type = type;
  result.library = "fake.so";
  result.ports = std::move(ports);
  result.params = std::move(params);
  return result;
}

Contract device(const char* type, std::vector<ParamContract> params) {
  Contract result = component(type, {}, std::move(params));
  result.kind = PluginKind::hardware;
  return result;
}

Contract sonar_avoid() {
  ParamContract samples = param("samples", ParamType::integer, std::int64_t{8});
  samples.min = 1;
  samples.max = 64;
  ParamContract gain = param("gain", ParamType::real, 1.0);
  gain.min = 0.0;
  PortContract sonar = required(receives("sonar", "SonarRangeReadings"));
  sonar.queue.depth = 3;
  return component("orca.SonarAvoid",
                   {sonar, receives("odometry", "Odometry"), pushes("motion", "MotionCommand")},
                   {real("stop_distance", "m", 0.05, 5.0, 0.5), real("sector", "rad", 0.0, 3.2, 1.0),
                    real("max_speed", "m/s", 0.0, 2.0, 0.6), real("rate", "Hz", 0.1, 100.0, 10.0),
                    real("share", "", 0.0, 1.0, 0.5), gain, samples,
                    param("verbose", ParamType::boolean, false), choice("mode", {"stop", "turn", "creep"}),
                    file("map"), param("label", ParamType::text, std::string("a")),
                    param("zones", ParamType::text_list, std::vector<std::string>{})});
}

Contract base_server(bool bound) {
  Contract result = component("orca.RobotBaseServer", {}, {real("max_command_age", "s", 0.01, 1.0, 0.2)});
  result.needs_hardware = true;
  if (!bound) return result;
  result.ports = {accepts("MotionCommandSend", "MotionCommand"),
                  derived(reads("SonarRangeReadingsPush", "SonarRangeReadings"), "RangeReadings"),
                  reads("OdometryPush", "Odometry"),
                  query("LimitsQuery", Role::server, "LimitsRequest", "Limits")};
  return result;
}

Contract old_logger() {
  PortContract sonar = receives("sonar", "SonarRangeReadings");
  sonar.type.hash = 0x999;
  sonar.type.layout = "SonarRangeReadings{ranges:sequence<double> {cm},half_lobe:double {rad}}";
  return component("orca.OldLogger", {sonar});
}

Contract older_logger() {
  PortContract sonar = receives("sonar", "SonarRangeReadings");
  sonar.type.hash = 0x888;
  sonar.type.layout = "SonarRangeReadings{ranges:sequence<double> {m}}";
  return component("orca.OlderLogger", {sonar});
}

Contract old_range_viewer() {
  PortContract ranges = receives("ranges", "RangeReadings");
  ranges.type.hash = 0x777;
  ranges.type.layout = "RangeReadings{ranges:sequence<double> {cm},half_lobe:double {rad}}";
  return component("orca.OldRangeViewer", {ranges});
}

}  // namespace

FakeCatalogue::FakeCatalogue() {
  add(sonar_avoid());
  add(::component("orca.LaserAvoid",
                  {required(derived(receives("laser", "LaserRangeReadings"), "RangeReadings")),
                   receives("sonar", "SonarRangeReadings"), pushes("motion", "MotionCommand")}));
  add(::component("orca.TwoRingAvoid",
                  {required(receives("sonar", "SonarRangeReadings")),
                   many(receives("more_sonars", "SonarRangeReadings")), pushes("motion", "MotionCommand")}));
  add(::component(
      "orca.Command",
      {sends("goal", "GoalPoint"), sends("clients", "ClientList"), receives("arrived", "Arrived")},
      {param("goals", ParamType::text, std::string())}));
  add(::component("orca.Goto",
                  {accepts("GoalSend", "GoalPoint"), pushes("ArrivedPush", "Arrived"),
                   pushes("MotionPush", "MotionCommand"), required(receives("localizer", "RobotPose"))}));
  add(::component("orca.MotionCommandFuser",
                  {many(receives("motion", "MotionCommand")), sends("base", "MotionCommand"),
                   accepts("ClientListSend", "ClientList")}));
  add(::component("orca.Porter", {derived(sends("door", "Door"), "GoalPoint"),
                                  derived(accepts("DoorSend", "Door"), "GoalPoint")}));
  add(::component("orca.Guide", {required(derived(sends("door", "Door"), "GoalPoint"))}));
  add(::component("orca.RangeViewer", {required(receives("ranges", "RangeReadings"))}));
  add(::component("orca.RangeCollector", {many(receives("ranges", "RangeReadings"))}));
  add(old_range_viewer());
  add(::component("orca.Relay", {many(receives("in", "RobotPose")), pushes("out", "RobotPose")}));
  add(::component("orca.TwinGoto", {pushes("slow", "MotionCommand"), pushes("fast", "MotionCommand")}));
  add(::component("orca.Localizer", {pushes("pose", "RobotPose"), receives("odometry", "Odometry")}));
  add(::component("orca.Planner", {query("limits", Role::proxy, "LimitsRequest", "Limits"),
                                   query("area", Role::proxy, "LimitsRequest", "Area")}));
  add(::component("orca.Label", {}, {param("label", ParamType::text, std::string())}));
  add(::component("test.Clock", {}));
  add(old_logger());
  add(older_logger());
  add(base_server(true));
  add(device("orca.hw.Sim",
             {file("world"), file("robot"), choice("realism", {"ideal", "nominal", "harsh", "recorded"})}));
  add(device("orca.hw.Deep",
             {real("depth", "m", 0.0, 1e4, 0.0), param("ship", ParamType::text, std::string("raft"))}));
  add(device("orca.hw.NomadScout", {param("port", ParamType::text, std::string("/dev/ttyS0")),
                                    real("silence", "s", 0.1, 10.0, 1.0)}));
}

void FakeCatalogue::add_folders(const std::vector<std::string>& folders) {
  std::string call = "folders";
  for (const std::string& folder : folders) call += " " + folder;
  calls.push_back(call);
}

Result<Contract> FakeCatalogue::find(const std::string& type, PluginKind kind) const {
  if (type == "orca.Broken")
    return fail(Code::failed_precondition, "broken.so: undefined symbol: orca::lost()");
  const auto found = types_.find(type);
  if (found != types_.end() && found->second.kind == kind) return found->second;
  return fail(Code::not_found, "no plugin in plugins/ holds the type \"" + type + "\"");
}

Result<Contract> FakeCatalogue::hardware(const std::string& type) {
  calls.push_back("hardware " + type);
  return find(type, PluginKind::hardware);
}

std::vector<orca::HardwareFault> FakeCatalogue::validate_hardware(const graph::HardwareUse& use) {
  calls.push_back("validate " + use.name);
  if (use.type == "orca.hw.Deep" && std::get<double>(use.params.at("depth")) == 0.0)
    return {{"ship", "the sea is 0 m deep", {"depth"}}};
  const auto world = use.params.find("world");
  const std::string path = world == use.params.end() ? "" : std::get<std::string>(world->second);
  if (path.ends_with("broken.world")) {
    return {{"", "broken.world:4:3: error W001: two walls cross"},
            {"", "broken.world:9:3: error W002: the floor has no size"}};
  }
  if (path.ends_with("foggy.world")) return {{"world", "its fog hides everything", {}, false, true}};
  if (path.ends_with("flooded.world")) return {{"world", "it is under water; take another"}};
  return {};
}

std::vector<orca::HardwareFault> FakeCatalogue::hardware_conflicts(const graph::HardwareUse& use,
                                                                   const graph::HardwareUse& earlier) {
  if (use.type != earlier.type) return {};
  if (use.type == "orca.hw.Sim" && use.params.at("world") == earlier.params.at("world"))
    return {{"world",
             "hardware \"" + earlier.name + "\" has this world too, which lives in one process",
             {},
             true}};
  if (use.type != "orca.hw.NomadScout" || use.params.at("port") != earlier.params.at("port")) return {};
  return {{"port", "hardware \"" + earlier.name + "\" is on this port already"}};
}

Result<Contract> FakeCatalogue::component(const std::string& type, const graph::HardwareUse* hardware) {
  calls.push_back("component " + type + (hardware == nullptr ? "" : " with " + hardware->name));
  if (type == "orca.RobotBaseServer") return base_server(hardware != nullptr);
  return find(type, PluginKind::component);
}

std::vector<graph::ComponentFault> FakeCatalogue::try_components(const graph::Graph& graph,
                                                                 const graph::Candidates& candidates) {
  std::vector<graph::ComponentFault> faults;
  for (const std::string& name : candidates.names) {
    calls.push_back((candidates.doubtful.contains(name) ? "doubt " : "try ") + name);
    const graph::ComponentNode& node = *graph.find_component(name);
    const auto label = node.params.find("label");
    if (label == node.params.end()) continue;
    const std::string& text = std::get<std::string>(label->second);
    if (text == "torn") faults.push_back({name, "label", "nobody can read it; write another"});
    if (text == "lost") faults.push_back({name, "", "configure() ended the process with exit(3)"});
  }
  return faults;
}

std::vector<std::string> FakeCatalogue::unfit(PluginKind /*kind*/, const std::string& type) {
  if (type != "test.Clock") return {};
  return {"uses time, which reads the machine's clock; use now()",
          "uses rand, which draws random numbers that the run's seed does not decide; use random(\"name\")"};
}

std::vector<std::string> FakeCatalogue::messages(const std::string& object_type, bool /*leave*/) const {
  if (object_type == "LaserRangeReadings") return {"sensor_msgs/msg/LaserScan"};
  if (object_type == "MotionCommand") return {"geometry_msgs/msg/Twist", "geometry_msgs/msg/TwistStamped"};
  return {};
}

std::vector<std::string> FakeCatalogue::type_names(PluginKind kind) const {
  std::vector<std::string> names;
  for (const auto& [name, contract] : types_)
    if (contract.kind == kind) names.push_back(name);
  return names;
}
