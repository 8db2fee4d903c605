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

TEST_CASE("a long text in quotes, or a long name in a list, loses its middle", "[base][text]") {
  CHECK(in_quotes(std::string(300, 'a')) == "\"" + std::string(300, 'a') + "\"");
  CHECK(in_quotes(std::string(301, 'a')) ==
        "\"" + std::string(150, 'a') + "...(301 bytes)..." + std::string(150, 'a') + "\"");
  CHECK(listed(Names(20, std::string(1'000'000, 'n'))).size() < 20 * 250);
  CHECK(listed(Names{std::string(200, 'n')}) == std::string(200, 'n'));
  CHECK(listed(Names{std::string(201, 'n')}) ==
        std::string(100, 'n') + "...(201 bytes)..." + std::string(100, 'n'));
}

TEST_CASE("a shortened text holds whole characters only", "[base][text]") {
  CHECK(shortened("abcdef", 6) == "abcdef");
  CHECK(shortened("abcdefg", 6) == "abc...(7 bytes)...efg");
  CHECK(shortened("ab\u00e4\u00e4yz", 6) == "ab...(8 bytes)...yz");
  CHECK(shortened("abc", 0) == "...(3 bytes)...");
  for (std::size_t most = 0; most < 12; ++most)
    CHECK(shortened("\u20ac\u20ac\u20ac\u20ac", most).find('\\') == std::string::npos);
}

TEST_CASE("a printable text has nothing that a terminal obeys, and everything else as it was",
          "[base][text]") {
  CHECK(printable("").empty());
  CHECK(printable("plain \"text\" \\ 100 %") == "plain \"text\" \\ 100 %");
  CHECK(printable("\u00e4\u20ac\U0001f600") == "\u00e4\u20ac\U0001f600");
  CHECK(printable("a\nb\rc\td") == "a\\nb\\rc\\td");
  CHECK(printable(std::string("\0\x1b[31m\x7f", 7)) == "\\x00\\x1b[31m\\x7f");
  CHECK(printable("\x7f\u0080\u009f\u00a0") == "\\x7f\\u0080\\u009f\u00a0");
  CHECK(printable("\u009b\u2028\u202e\u2066\u200f") == "\\u009b\\u2028\\u202e\\u2066\\u200f");
  CHECK(printable("\xff \xc3 \xe2\x82 \xed\xa0\x80 \xc0\xaf \xf5\x80\x80\x80") ==
        "\\xff \\xc3 \\xe2\\x82 \\xed\\xa0\\x80 \\xc0\\xaf \\xf5\\x80\\x80\\x80");
}

TEST_CASE("a fitting text has no more columns than the terminal, with a sign that something is left out",
          "[base][text]") {
  CHECK(fitting("abcdef", 6) == "abcdef");
  CHECK(fitting("abcdefg", 6) == "abc...");
  CHECK(fitting("", 0).empty());
  CHECK(fitting("abc", 2) == "..");
  CHECK(fitting("abc", 0).empty());
  CHECK(fitting("\u00e4\u00e4\u00e4\u00e4\u00e4", 4) == "\u00e4...");
  // Wide characters take two columns.
  CHECK(fitting("\u4e2d\u6587", 4) == "\u4e2d\u6587");
  CHECK(fitting("\u4e2d\u6587\u4e2d", 5) == "\u4e2d...");
}
