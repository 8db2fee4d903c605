// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/xml/diagnostics.hpp"

using namespace orca::xml;

TEST_CASE("a diagnostic is one line: file, line, column, severity, code, message", "[xml][diagnostics]") {
  const Diagnostic error{Severity::error, "G017", {"graph.xml", 12, 7}, "no such port"};
  CHECK(error.text() == "graph.xml:12:7: error G017: no such port");
  const Diagnostic warning{Severity::warning, "G019", {"command line", 0, 0}, "never used"};
  CHECK(warning.text() == "command line: warning G019: never used");
}

TEST_CASE("a line finished elsewhere is printed as it is and counts as an error", "[xml][diagnostics]") {
  Diagnostics diagnostics;
  diagnostics.line({"graph.xml", 3, 1}, "hall.world:9:2: error W004: two walls cross");
  CHECK(diagnostics.has_errors());
  CHECK(diagnostics.text() == "hall.world:9:2: error W004: two walls cross\n");
}

TEST_CASE("diagnostics are sorted by file, line and column, and within one place as reported",
          "[xml][diagnostics]") {
  Diagnostics diagnostics;
  diagnostics.error("E3", {"a.xml", 10, 1}, "third");
  diagnostics.error("E1", {"a.xml", 2, 9}, "first");
  diagnostics.error("E2", {"a.xml", 2, 9}, "second");
  diagnostics.error("E4", {"b.xml", 1, 1}, "fourth");
  std::string order;
  for (const Diagnostic& d : diagnostics.sorted()) order += d.code;
  CHECK(order == "E1E2E3E4");
}

TEST_CASE("a warning alone is no error", "[xml][diagnostics]") {
  Diagnostics diagnostics;
  diagnostics.warning("G019", {"a.xml", 1, 1}, "never used");
  CHECK_FALSE(diagnostics.has_errors());
  CHECK(diagnostics.error_count() == 0);
  CHECK(diagnostics.sorted().size() == 1);
}

TEST_CASE("after fifty lines the rest is only counted", "[xml][diagnostics]") {
  Diagnostics diagnostics;
  for (int line = 1; line <= 53; ++line) diagnostics.error("E", {"a.xml", line, 1}, "wrong");
  const std::string text = diagnostics.text();
  CHECK(text.find("a.xml:50:1") != std::string::npos);
  CHECK(text.find("a.xml:51:1") == std::string::npos);
  CHECK(text.ends_with("... and 3 more\n"));
}

TEST_CASE("the first errors of a flood are kept, and all are counted", "[xml][diagnostics]") {
  Diagnostics diagnostics;
  for (int line = 1; line <= 30'000; ++line) diagnostics.error("E", {"a.xml", line, 1}, "wrong");
  CHECK(diagnostics.error_count() == 30'000);
  CHECK(diagnostics.sorted().size() == Diagnostics::kKept);
  CHECK(diagnostics.text().ends_with("... and 29950 more\n"));
}

TEST_CASE("what a terminal would obey is printed as an escape sequence, in one line", "[xml][diagnostics]") {
  Diagnostics diagnostics;
  diagnostics.error("G016", {"a\x1b[2J.xml", 2, 9}, "there is no \"x\ny\" \u202e");
  diagnostics.line({"b.xml", 3, 1}, "c.world:1:1: error W001: a\rb");
  CHECK(diagnostics.text() ==
        "a\\x1b[2J.xml:2:9: error G016: there is no \"x\\ny\" \\u202e\n"
        "c.world:1:1: error W001: a\\rb\n");
}

TEST_CASE("of a message of megabytes the beginning and the end are kept", "[xml][diagnostics]") {
  Diagnostics diagnostics;
  diagnostics.error("E", {"a.xml", 1, 1}, "first " + std::string(5'000'000, 'x') + " last");
  const std::string text = diagnostics.text();
  CHECK(text.size() < Diagnostics::kLongest + 100);
  CHECK(text.starts_with("a.xml:1:1: error E: first x"));
  CHECK(text.ends_with("x last\n"));
  CHECK(text.find("...(5000011 bytes)...") != std::string::npos);
  CHECK(diagnostics.json().size() < Diagnostics::kLongest + 300);
}
