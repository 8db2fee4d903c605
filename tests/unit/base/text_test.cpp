// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/text.hpp"

#include <catch2/catch.hpp>

#include <vector>

using namespace orca;

using Names = std::vector<std::string>;

TEST_CASE("a list of names for people stops at twenty, or at the given limit", "[base][text]") {
  CHECK(listed(Names{}) == "nothing");
  CHECK(listed(Names{"a", "b"}) == "a, b");
  CHECK(listed(Names(20, "x")).ends_with("x, x"));
  CHECK(listed(Names(23, "x")).ends_with("x, x and 3 more"));
  CHECK(listed(Names{"a", "b", "c"}, 2) == "a, b and 1 more");
}

TEST_CASE("parts are joined by a separator, which stands between them only", "[base][text]") {
  CHECK(joined(Names{}, "; ").empty());
  CHECK(joined(Names{"a"}, "; ") == "a");
  CHECK(joined(Names{"a", "", "c"}, "; ") == "a; ; c");
}

TEST_CASE("a text in quotes is printed as it is, with nothing escaped", "[base][text]") {
  CHECK(in_quotes("a \"b\"") == "\"a \"b\"\"");
  CHECK(in_quotes("") == "\"\"");
}
