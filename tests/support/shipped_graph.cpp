// SPDX-License-Identifier: GPL-3.0-or-later
#include "shipped_graph.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <regex>

#include "temp_folder.hpp"

namespace orca::test {
namespace {

std::string without(const std::string& text, const std::string& pattern) {
  return std::regex_replace(text, std::regex(pattern), "");
}

std::string replaced(const std::string& text, const std::string& pattern, const std::string& by) {
  return std::regex_replace(text, std::regex(pattern), by);
}

// Returns the recording of some seconds of a robot with a laser, which is made when it is asked for first.
std::string recording_in(const TempFolder& folder) {
  std::string file = folder.file("run.mcap");
  if (std::filesystem::exists(file)) return file;
  const Run run = run_deployer(
      Words{source_file("graphs/pioneer_planner.xml"), "--until", "5 s", "--record", file} + virtual_clock());
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return file;
}

void insert_before(std::string& text, const std::string& mark, const std::string& more) {
  text.insert(text.rfind(mark), more);
}

// Returns the file of a robot whose camera has a sixteenth of the pixels, and so takes a fraction of the time.
std::string robot_with_small_camera() {
  const std::string text = read_text(source_file("sim/robots/pioneer_2dx_camera.urdf"));
  return replaced(replaced(text, "width=\"1280\"", "width=\"320\""), "height=\"720\"", "height=\"180\"");
}

// Returns the picture of a hall of 20 x 12 m with a pillar in the middle, 1.2 m wide.
std::string hall_with_pillar() {
  constexpr int kWidth = 200;
  constexpr int kHeight = 120;
  std::string text = "P5\n" + std::to_string(kWidth) + " " + std::to_string(kHeight) + "\n255\n";
  for (int row = 0; row < kHeight; ++row)
    for (int column = 0; column < kWidth; ++column)
      text += std::abs(row - kHeight / 2) <= 6 && std::abs(column - kWidth / 2) <= 6 ? '\0' : '\xff';
  return text;
}

}  // namespace

// The copy is read from another folder, so its paths become absolute.
ShippedGraph::ShippedGraph(const std::string& name)
    : text_(read_text(source_file("graphs/" + name + ".xml"))) {
  text_ = replaced(text_, "\\.\\./sim/", source_file("sim/"));
  text_ = replaced(text_, "\"tasks/", "\"" + source_file("graphs/tasks/"));
  text_ = replaced(text_, "(graph|file)=\"(?=[a-z][^\"]*\\.xml\")", "$1=\"" + source_file("graphs/"));
}

void ShippedGraph::remove(const std::string& component) {
  const std::string start = "\\s*<component name=\"" + component + "\"[^>]*";
  text_ = without(text_, start + "/>");
  text_ = without(text_, start + "[^/]>[^]*?</component>");
  text_ = without(text_, "\\s*<connect [^>]*\"" + component + "\\.[^>]*/>");
  text_ = without(text_, "; " + component + "(?=\")");
  text_ = without(text_, "\\s*<param name=\"required\" value=\"" + component + "\"/>");
}

void ShippedGraph::add(const std::string& elements) { insert_before(text_, "</graph>", elements); }

void ShippedGraph::watch_motion(const std::string& base) {
  const std::string watch = base.substr(0, base.rfind('/') + 1) + "watch";
  std::smatch found;
  const std::regex of_base("<component name=\"" + base + "\"[^>]*( process=\"[^\"]*\")");
  const std::string process = std::regex_search(text_, found, of_base) ? found[1].str() : "";
  insert_before(text_, "</graph>",
                "  <component name=\"" + watch + "\" type=\"test.MotionWatch\"" + process +
                    "/>\n  <connect from=\"" + base + ".OdometryPush\" to=\"" + watch + ".odometry\"/>\n");
  const std::string plugins = " plugins=\"" ORCA_BINARY_DIR "/tests/plugins\"";
  if (text_.find(plugins) == std::string::npos) text_.insert(text_.find('>', text_.find("<graph ")), plugins);
}

std::vector<std::string> shipped_graphs() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(source_file("graphs")))
    if (file.path().extension() == ".xml") names.push_back(file.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

Words needed_arguments(const std::string& graph, const TempFolder& folder) {
  if (graph == "replay") return {"--set", "recording=" + recording_in(folder)};
  if (graph == "intel_log") return {"--set", "log=" + recording_in(folder)};
  if (graph == "localize_log")
    return {"--set", "log=" + recording_in(folder), "--set", "map=" + source_file("sim/worlds/office.xml")};
  if (graph == "camera")
    return {"--set", "robot=" + folder.write("small_camera.urdf", robot_with_small_camera())};
  if (graph != "scout_hospital") return {};
  return {"--set", "map=" + folder.write("hall.pgm", hall_with_pillar()),
          "--set", "map_width=20 m",
          "--set", "x=2 m",
          "--set", "y=5.8 m",
          "--set", "goals=east: 18 5.8"};
}

std::string printed(const std::string& graph) {
  const TempFolder folder;
  const Run run = run_deployer(Words{source_file("graphs/" + graph + ".xml"), "--print"} +
                               needed_arguments(graph, folder));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return run.out;
}

}  // namespace orca::test
