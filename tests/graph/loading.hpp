// SPDX-License-Identifier: GPL-3.0-or-later
// Loading graphs from texts, for tests.
#pragma once

#include <catch2/catch.hpp>

#include <string>

#include "fake_catalogue.hpp"

/// The graph of a text that must be good.
inline orca::graph::Graph must_load(const std::string& text, const orca::graph::LoadOptions& options = {},
                                    const std::string& file = "test.xml") {
  FakeCatalogue catalogue;
  orca::xml::Diagnostics diagnostics;
  auto graph = orca::graph::load_text(text, file, options, catalogue, diagnostics);
  INFO(text << "\n" << diagnostics.text());
  REQUIRE(graph.has_value());
  return *graph;
}

/// What is said about a text, "" if nothing.
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
