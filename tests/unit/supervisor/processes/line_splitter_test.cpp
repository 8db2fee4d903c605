// SPDX-License-Identifier: GPL-3.0-or-later
#include "processes/line_splitter.hpp"

#include <catch2/catch.hpp>

using namespace orca::supervisor;

namespace {
using Lines = std::vector<std::string>;
}

TEST_CASE("Lines are whole, however the bytes come", "[supervisor][processes]") {
  const std::string printed = "one\n\ntwo\r\nthree";
  const std::size_t step = GENERATE(1, 2, 3, 5, 100);
  LineSplitter splitter;
  Lines lines;
  for (std::size_t at = 0; at < printed.size(); at += step)
    for (auto& line : splitter.add(std::string_view(printed).substr(at, step))) lines.push_back(line);
  CHECK(lines == Lines{"one", "", "two"});
  CHECK(splitter.finish() == Lines{"three"});
  CHECK(splitter.finish().empty());
}

TEST_CASE("The rest of a long line is left out, and the next line is whole", "[supervisor][processes]") {
  LineSplitter splitter;
  for (int i = 0; i < 100; ++i) CHECK(splitter.add(std::string(100'000, 'a')).empty());
  CHECK(splitter.add("\nb\n") == Lines{std::string(LineSplitter::kLongest, 'a') + "...", "b"});
}

TEST_CASE("What a terminal would obey is written as an escape sequence", "[supervisor][processes]") {
  LineSplitter splitter;
  CHECK(splitter.add("\x1b[2J\n") == Lines{"\\x1b[2J"});
}
