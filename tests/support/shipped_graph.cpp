// SPDX-License-Identifier: GPL-3.0-or-later
#include "shipped_graph.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>

#include "deployer.hpp"
#include "temp_folder.hpp"

namespace orca::test {
namespace {

std::string without(const std::string& text, const std::string& pattern) {
  return std::regex_replace(text, std::regex(pattern), "");
}

void insert_before(std::string& text, const std::string& mark, const std::string& more) {
  text.insert(text.rfind(mark), more);
}

}  // namespace

// The copy is read from another folder, so its paths become absolute.
ShippedGraph::ShippedGraph(const std::string& name)
    : text_(std::regex_replace(read_text(source_file("graphs/" + name + ".xml")), std::regex("\\.\\./sim/"),
                               source_file("sim/"))) {}

void ShippedGraph::remove(const std::string& component) {
  const std::string start = "\\s*<component name=\"" + component + "\"[^>]*";
  text_ = without(text_, start + "/>");
  text_ = without(text_, start + "[^/]>[^]*?</component>");
  text_ = without(text_, "\\s*<connect [^>]*\"" + component + "\\.[^>]*/>");
  text_ = without(text_, "; " + component + "(?=\")");
}

void ShippedGraph::watch_motion(const std::string& base) {
  insert_before(text_, "</graph>",
                "  <component name=\"watch\" type=\"test.MotionWatch\"/>\n"
                "  <connect from=\"" +
                    base + ".OdometryPush\" to=\"watch.odometry\"/>\n");
  const std::string plugins = " plugins=\"" ORCA_BINARY_DIR "/tests/plugins\"";
  text_.insert(text_.find('>', text_.find("<graph ")), plugins);
}

std::vector<std::string> shipped_graphs() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(source_file("graphs")))
    if (file.path().extension() == ".xml") names.push_back(file.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace orca::test
