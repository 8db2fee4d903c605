// SPDX-License-Identifier: GPL-3.0-or-later
// Loading graphs from texts, for tests.
#pragma once

#include <catch2/catch.hpp>

#include <map>
#include <string>
#include <variant>

#include "fake_catalogue.hpp"

/// Returns the graph of a text that must be good.
inline orca::graph::Graph must_load(const std::string& text, const orca::graph::LoadOptions& options = {},
                                    const std::string& file = "test.xml") {
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  auto graph = orca::graph::load_text(text, file, options, catalogue, diagnostics);
  INFO(text << "\n" << diagnostics.text());
  REQUIRE(graph.has_value());
  return *graph;
}

/// Files by name; "main.xml" is the one that is loaded, the others are what it includes.
using Files = std::map<std::string, std::string>;

inline std::optional<orca::graph::Graph> load_files(const Files& files, orca::xml::Diagnostics& diagnostics,
                                                    const orca::graph::LoadOptions& options = {}) {
  FakeCatalogue catalogue;
  const auto read = [&](const std::string& path) -> orca::Result<std::string> {
    const auto found = files.find(path);
    if (found == files.end()) return orca::fail(orca::Code::not_found, "No such file or directory");
    return found->second;
  };
  return orca::graph::load_text(files.at("main.xml"), "main.xml", options, catalogue, diagnostics, read);
}

inline orca::graph::Graph must_load(const Files& files, const orca::graph::LoadOptions& options = {}) {
  orca::xml::Diagnostics diagnostics;
  auto graph = load_files(files, diagnostics, options);
  INFO(diagnostics.text());
  REQUIRE(graph.has_value());
  return *graph;
}

/// Returns the messages about files, "" if there are none.
inline std::string said_about(const Files& files, const orca::graph::LoadOptions& options = {}) {
  orca::xml::Diagnostics diagnostics;
  const bool loaded = load_files(files, diagnostics, options).has_value();
  CHECK(loaded == !diagnostics.has_errors());
  return diagnostics.text();
}

/// Returns the messages about a text, "" if there are none.
inline std::string said_about(const std::string& text, const orca::graph::LoadOptions& options = {}) {
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  const bool loaded = orca::graph::load_text(text, "test.xml", options, catalogue, diagnostics).has_value();
  CHECK(loaded == !diagnostics.has_errors());
  return diagnostics.text();
}

/// A base and an avoider that hears its sonars; `content` goes into the avoider.
inline std::string robot_with(const std::string& content) {
  return "<graph name='robot'><hardware name='robot' type='orca.hw.Sim'/>"
         "<component name='base' type='orca.RobotBaseServer' hardware='robot'/>"
         "<component name='avoid' type='orca.SonarAvoid'>" +
         content + "</component><connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/></graph>";
}

/// A base with sonars, and the connection by which an avoider hears them.
inline const std::string kSonarBase =
    "<hardware name='robot' type='orca.hw.Sim'/><component name='base' type='orca.RobotBaseServer' "
    "hardware='robot'/>";
inline const std::string kSonarEdge = "<connect from='base.SonarRangeReadingsPush' to='avoid.sonar'/>";

/// Options with which a link within a process that needs two is no error.
inline const orca::graph::LoadOptions kAnyLink{.any_link = true};

/// Returns the distance [m] at which an avoider of the graph stops.
inline double stop_distance(const orca::graph::Graph& graph, const char* component = "avoid") {
  return std::get<double>(graph.find_component(component)->params.at("stop_distance"));
}
