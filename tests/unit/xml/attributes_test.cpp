// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/xml/attributes.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <optional>

using namespace orca;
using namespace orca::xml;

namespace {

constexpr std::array<std::string_view, 2> kColours{"red", "green"};
constexpr std::array kPartAttributes{
    AttributeRule{.name = "name", .required = true, .value = {.form = ValueRule::Form::name}},
    AttributeRule{
        .name = "length",
        .value = {.form = ValueRule::Form::number, .unit = "m", .min = 0, .max = 10, .above_min = true}},
    AttributeRule{.name = "count", .value = {.form = ValueRule::Form::integer, .min = 1, .max = 4}},
    AttributeRule{.name = "wait", .value = {.form = ValueRule::Form::number, .unit = "s", .min = 0}},
    AttributeRule{.name = "angles", .value = {.form = ValueRule::Form::number, .unit = "rad"}},
    AttributeRule{.name = "colour", .value = {.choices = kColours}}};
constexpr std::array<std::string_view, 2> kEnds{"from", "to"};
constexpr std::array kLineAttributes{AttributeRule{.name = "from", .required = true},
                                     AttributeRule{.name = "to", .required = true}};
constexpr std::array<std::string_view, 1> kForeign{"xmlns:tool"};

constexpr ElementRule kPart{.name = "part", .attributes = kPartAttributes};
constexpr ElementRule kLine{.name = "line", .attributes = kLineAttributes, .telling = kEnds};
constexpr std::array kInGroup{&kPart};
constexpr ElementRule kGroup{.name = "group", .children = kInGroup};
constexpr std::array kInRoot{&kGroup, &kLine};
constexpr ElementRule kRoot{.name = "root", .children = kInRoot, .foreign = kForeign};
constexpr std::array kElements{&kRoot, &kGroup, &kPart, &kLine};
constexpr FileRules kFile{"a test", kElements, {"E1", "E2", "E3", "E4", "E5", "E6", "E7", "E8", "E9"}};

// One <part> and the messages about it.
struct Part {
  explicit Part(const std::string& attributes)
      : document(read_text("<part " + attributes + "/>", "f", diagnostics)),
        part(document.value().root, kPart, kFile, reporter) {}

  Diagnostics diagnostics;
  Reporter reporter{diagnostics};
  std::optional<Document> document;
  Attributes part;
};

// Returns the messages about the children of a <root> with this inside.
std::string errors_in_root(const std::string& inside) {
  Diagnostics diagnostics;
  Reporter reporter(diagnostics);
  const auto document = read_text("<root xmlns:tool=\"x\">" + inside + "</root>", "f", diagnostics);
  const Attributes root(document.value().root, kRoot, kFile, reporter);
  for (const auto& [child, rule] : root.children())
    static_cast<void>(Attributes(*child, *rule, kFile, reporter).children());
  return diagnostics.text();
}

}  // namespace

TEST_CASE("attributes are read by their rules, in SI", "[xml][attributes]") {
  const Part p(R"(name="leg_1" length="250 mm" count="3" wait="50 ms" angles="90 -45 deg" colour="red")");
  CHECK(p.part.name("name") == "leg_1");
  CHECK(p.part.number("length") == 0.25);
  CHECK(p.part.integer("count") == 3);
  CHECK(p.part.duration("wait") == std::chrono::milliseconds{50});
  const auto angles = p.part.numbers("angles", 2);
  REQUIRE(angles);
  CHECK(angles->at(0) == Approx(1.5707963267948966));
  CHECK(angles->at(1) == Approx(-0.7853981633974483));
  CHECK(p.part.choice("colour") == "red");
  CHECK(p.diagnostics.text().empty());
}

TEST_CASE("an attribute that is missing has the reader's default, or no value", "[xml][attributes]") {
  const Part p("name=\"a\"");
  CHECK_FALSE(p.part.number("length"));
  CHECK(p.part.number_or("length", 2.5) == 2.5);
  CHECK(p.part.duration_or("wait", Duration{7}) == Duration{7});
  CHECK(p.diagnostics.text().empty());
  CHECK_FALSE(p.part.require("length"));
  CHECK(p.diagnostics.text() == "f:1:1: error E4: <part> needs the attribute \"length\"\n");
}

TEST_CASE("a value that breaks its rule is reported with the code of that rule", "[xml][attributes]") {
  const Part p(R"(name="1st" length="0 m" count="5" wait="3 kg" colour="gren" angles="1 x")");
  CHECK_FALSE(p.part.name("name"));
  CHECK_FALSE(p.part.number("length"));
  CHECK_FALSE(p.part.integer("count"));
  CHECK_FALSE(p.part.number("wait"));
  CHECK_FALSE(p.part.choice("colour"));
  CHECK_FALSE(p.part.numbers("angles", 1));
  CHECK(p.diagnostics.text() ==
        "f:1:13: error E6: name: \"1st\" is not a name: a letter, then letters, digits and _, at most 200\n"
        "f:1:26: error E8: length: \"0 m\" is out of range: more than 0 and at most 10 m is allowed\n"
        "f:1:38: error E8: count: \"5\" is out of range: 1 to 4 is allowed\n"
        "f:1:47: error E7: wait: \"3 kg\": \"kg\" measures a mass; a time is expected: write s, ms, us, ns, "
        "min or h\n"
        "f:1:61: error E9: colour: \"gren\" is not one of: red, green; did you mean \"green\"?\n"
        "f:1:75: error E7: angles: \"1 x\": \"x\" is not a unit that Orca knows; an angle is expected: write "
        "rad or "
        "deg\n");
}

TEST_CASE("exactly the requested number of numbers is read", "[xml][attributes]") {
  const Part p(R"(name="a" angles="1 2 3")");
  CHECK(p.part.numbers("angles", 3) == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(p.part.bare_numbers("angles", 3) == std::vector<double>{1.0, 2.0, 3.0});
  CHECK_FALSE(p.part.numbers("angles", 2));
  CHECK(p.diagnostics.text() == "f:1:24: error E6: angles: \"1 2 3\" holds 3 numbers, expected 2\n");
}

TEST_CASE("a bare number has no unit, not even a percent sign", "[xml][attributes]") {
  const Part p(R"(name="a" length="50 %")");
  CHECK_FALSE(p.part.bare_number("length"));
  CHECK_THAT(p.diagnostics.text(), Catch::StartsWith("f:1:24: error E6: length: \"50 %\" is not a number"));
}

TEST_CASE("a misspelt attribute is reported once and taken for what it was meant to be",
          "[xml][attributes]") {
  const Part p(R"(nmae="a" lenght="2 m")");
  CHECK(p.part.name("name") == "a");
  CHECK(p.part.number("length") == 2.0);
  CHECK(p.diagnostics.error_count() == 2);
  CHECK_THAT(p.diagnostics.text(),
             Catch::Contains("f:1:7: error E3: <part> has no attribute \"nmae\"; it has: name, "
                             "length, count, wait, angles, colour; did you mean \"name\"?"));
}

TEST_CASE("a misspelt attribute does not replace the one that is there as well", "[xml][attributes]") {
  const Part p(R"(name="a" length="1 m" lenght="2 m")");
  CHECK(p.part.number("length") == 1.0);
  CHECK(p.diagnostics.error_count() == 1);
}

TEST_CASE("a value that is not well-formed is reported only once", "[xml][attributes]") {
  const Part p(R"(name="a" length="&wide;")");
  CHECK_FALSE(p.part.number("length"));
  CHECK(p.diagnostics.error_count() == 1);
}

TEST_CASE("an element without a rule may have any attributes", "[xml][attributes]") {
  Diagnostics diagnostics;
  Reporter reporter(diagnostics);
  const auto document = read_text("<x a='1.5' b='&lt;'>text</x>", "f", diagnostics);
  const Attributes x(document.value().root, kFile, reporter);
  CHECK(x.number("a") == 1.5);
  CHECK(x.text("b") == "<");
  CHECK(diagnostics.text().empty());
}

TEST_CASE("content that an element may not hold is reported, with the place where it belongs",
          "[xml][matching]") {
  CHECK(errors_in_root("<line from='a' to='b'/>").empty());
  CHECK(errors_in_root("<part name='a'/>") ==
        "f:1:22: error E2: <part> does not belong in <root>; it goes into <group>\n");
  CHECK(errors_in_root("<root/>") ==
        "f:1:22: error E2: <root> does not belong in <root>; it is the root of the file\n");
  CHECK(errors_in_root("<zebra/>") ==
        "f:1:22: error E1: there is no element <zebra> in <root>; it may contain: group, line\n");
  CHECK(errors_in_root("<line from='a'/>") == "f:1:22: error E4: <line> needs the attribute \"to\"\n");
  CHECK(errors_in_root("<group>so</group>") ==
        "f:1:29: error E5: the text \"so\" inside <group> means nothing; a test says everything in "
        "attributes\n");
}

TEST_CASE("an unknown element is taken for the nearest one, or for the one that its attributes suggest",
          "[xml][matching]") {
  CHECK_THAT(
      errors_in_root("<gruop><part/></gruop>"),
      Catch::Contains("error E1: there is no element <gruop>") && Catch::Contains("did you mean \"group\"?"));
  // Nothing more is reported as missing, which shows that it is read as a <line>.
  CHECK_THAT(errors_in_root("<arrow from='a' to='b'/>"), Catch::EndsWith("did you mean \"line\"?\n"));
}

TEST_CASE("hints stop after two hundred questions", "[xml][reporter]") {
  Diagnostics diagnostics;
  Reporter reporter(diagnostics);
  const std::vector<std::string> names{"laser"};
  for (int i = 0; i < 200; ++i) CHECK(reporter.nearest("lasre", names) == "laser");
  CHECK_FALSE(reporter.has_hints());
  CHECK_FALSE(reporter.nearest("lasre", names));
  CHECK(reporter.hint("lasre", names).empty());
}
