// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/base/random.hpp"
#include "orca/xml/document.hpp"

using namespace orca::xml;

namespace {

Document must_read(std::string_view text) {
  Diagnostics diagnostics;
  auto document = read_text(text, "test.xml", diagnostics);
  INFO(diagnostics.text());
  REQUIRE(document.has_value());
  REQUIRE_FALSE(diagnostics.has_errors());
  return *document;
}

std::string at(const Position& position) {
  return std::to_string(position.line) + ":" + std::to_string(position.column);
}

}  // namespace

TEST_CASE("elements, attributes and values know their line and column", "[xml][document]") {
  const Document document =
      must_read("<?xml version=\"1.0\"?>\n<graph  name = 'g'>\n  <arg\n    name=\"a\"/></graph>");
  CHECK(at(document.root.position()) == "2:1");
  const Attribute* name = document.root.attribute("name");
  REQUIRE(name != nullptr);
  CHECK(at(name->position) == "2:9");
  CHECK(at(name->value_position) == "2:17");
  REQUIRE(document.root.children().size() == 1);
  const Element& arg = document.root.children()[0];
  CHECK(at(arg.position()) == "3:3");
  CHECK(at(arg.attribute("name")->position) == "4:5");
}

TEST_CASE("a column counts characters, not bytes", "[xml][document]") {
  const Document document = must_read("<r><!-- åäö --><e/></r>");
  CHECK(at(document.root.children()[0].position()) == "1:16");
}

TEST_CASE("references are resolved in values and texts", "[xml][document]") {
  const Document document =
      must_read("<r v='&lt;&#65;&#x42;&amp;&quot;&apos;'>1 &gt; 0<![CDATA[ & <2>]]></r>");
  CHECK(document.root.attribute("v")->value == "<AB&\"'");
  CHECK(document.root.text() == "1 > 0 & <2>");
}

TEST_CASE("the text of an element leaves out its children and says where it starts", "[xml][document]") {
  const Document document = must_read("<r>\n  a<x>no</x>b</r>");
  CHECK(document.root.text() == "\n  ab");
  CHECK(at(document.root.text_position()) == "2:3");
}

TEST_CASE("comments and blanks around the root are allowed", "[xml][document]") {
  CHECK(must_read("\n <!-- before --> <r/> <!-- after -->\n").root.name() == "r");
}

TEST_CASE("a missing attribute is null", "[xml][document]") {
  CHECK(must_read("<r a='1'/>").root.attribute("b") == nullptr);
}

TEST_CASE("a flaw that leaves the tree readable gives the tree and the error", "[xml][document]") {
  Diagnostics diagnostics;
  const auto document = read_text("<r a='1' a='2' b='&nbsp;'><c/></r>", "test.xml", diagnostics);
  REQUIRE(document.has_value());
  CHECK(diagnostics.error_count() == 2);
  CHECK(document->root.attributes().size() == 2);
  CHECK(document->root.attribute("a")->value == "1");
  CHECK_FALSE(document->root.attribute("b")->intact);
  CHECK(document->root.children().size() == 1);
}

TEST_CASE("an escaped text is read back unchanged", "[xml][document]") {
  orca::RandomStream random(1, "xml", "escape");
  const std::string alphabet = "ab <>&\"'\n\r\t;#x]-$";
  for (int run = 0; run < 300; ++run) {
    std::string text;
    for (int i = 0; i < 20; ++i) text += alphabet[random() % alphabet.size()];
    INFO(text);
    REQUIRE(must_read("<r v=\"" + escaped(text) + "\"/>").root.attribute("v")->value == text);
  }
}

TEST_CASE(
    "a character of a file has one to four bytes; control characters and broken UTF-8 are no characters",
    "[xml][document]") {
  CHECK(character_size("a") == 1);
  CHECK(character_size("\n") == 1);
  CHECK(character_size("\xc3\xb6x") == 2);
  CHECK(character_size("\xe2\x82\xac") == 3);
  CHECK(character_size("\xf0\x9f\xa4\x96") == 4);
  for (const std::string_view none :
       {"", "\x1b", "\x7f", "\xc3", "\xc3x", "\x80", "\xc0\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80"})
    CHECK(character_size(none) == 0);
}

TEST_CASE("reading a file with any damage ends with a tree or with an error", "[xml][document]") {
  const std::string good =
      "<?xml version='1.0'?><g a='1'><!-- c --><p v=\"x &lt; y\"/>t<![CDATA[u]]><q><r/></q></g>";
  orca::RandomStream random(1, "xml", "damage");
  for (std::size_t cut = 0; cut < good.size(); ++cut) {
    Diagnostics diagnostics;
    const auto document = read_text(good.substr(0, cut), "cut.xml", diagnostics);
    REQUIRE((!document.has_value() && diagnostics.has_errors()));
  }
  for (int run = 0; run < 5000; ++run) {
    std::string bad = good;
    for (int i = 0; i < 3; ++i) bad[random() % bad.size()] = static_cast<char>(random() % 128);
    Diagnostics diagnostics;
    const auto document = read_text(bad, "flip.xml", diagnostics);
    INFO(bad << "\n" << diagnostics.text());
    REQUIRE((document.has_value() || diagnostics.has_errors()));
    REQUIRE(diagnostics.text().find("G129") == std::string::npos);
  }
}
