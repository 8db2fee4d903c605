// SPDX-License-Identifier: GPL-3.0-or-later
// A file that is part of the graph several times has its errors once.
#include "reading/report.hpp"

#include <catch2/catch.hpp>

#include "orca/xml/names.hpp"

using namespace orca;
using orca::graph::Report;

namespace {

const xml::Position kShared{"arm.xml", 3, 5};
const xml::Position kAlone{"main.xml", 3, 5};

// Returns how many of the messages are reported, all at one place with one code.
std::size_t reported(const std::vector<std::string>& messages, const xml::Position& place = kShared) {
  xml::Diagnostics diagnostics;
  Report report(diagnostics);
  report.share(kShared.file);
  for (const std::string& message : messages) report.error("G017", place, message);
  return diagnostics.error_count();
}

}  // namespace

TEST_CASE("an error in a shared file is reported once, whatever contexts its copies have",
          "[graph][report]") {
  CHECK(reported({"\"left/avoid\" has no port", "\"right/avoid\" has no port"}) == 1);
  CHECK(reported({"avoid has no port", "right/avoid has no port"}) == 1);
  CHECK(reported({"the port of Platforms/Dewey/avoid", "the port of Platforms/Huey/left/avoid"}) == 1);
  for (const std::string context : {"a", "z", "A", "Z", "0", "9", "_", "aZ_9"}) {
    CAPTURE(context);
    CHECK(reported({"the port of " + context + "/avoid", "the port of b/avoid"}) == 1);
  }
}

TEST_CASE("errors in a shared file that differ in more than contexts are all reported", "[graph][report]") {
  CHECK(reported({"the port of left/avoid", "the port of left/fuser"}) == 2);
  CHECK(reported({"avoid, at left/base", "fuser, at left/base"}) == 2);
  CHECK(reported({"avoid (left/base)", "fuser (left/base)"}) == 2);
  CHECK(reported({"the rate of left/avoid: 3", "the rate of left/avoid: 4"}) == 2);
}

TEST_CASE("errors in other files are reported each time", "[graph][report]") {
  CHECK(reported({"left/avoid has no port", "right/avoid has no port"}, kAlone) == 2);
}

TEST_CASE("the same error at another place, or of another kind, is another error", "[graph][report]") {
  xml::Diagnostics diagnostics;
  Report report(diagnostics);
  report.share(kShared.file);
  report.error("G017", kShared, "left/avoid");
  report.error("G016", kShared, "right/avoid");
  report.error("G017", {kShared.file, 4, 5}, "right/avoid");
  CHECK(diagnostics.error_count() == 3);
}

TEST_CASE("a name that only lacks its context is guessed", "[graph][report]") {
  xml::Diagnostics diagnostics;
  Report report(diagnostics);
  const std::vector<std::string> names{"left/avoid", "left/base"};
  CHECK(report.hint_in_contexts("base", names) == xml::did_you_mean("left/base"));
  CHECK(report.hint_in_contexts("left/avoit", names) == xml::did_you_mean("left/avoid"));
  CHECK(report.hint_in_contexts("something else", names).empty());
}
