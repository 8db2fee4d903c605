// SPDX-License-Identifier: GPL-3.0-or-later
// Texts that are not well-formed, and the one line of error for each.
#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "orca/xml/document.hpp"

using namespace orca::xml;
using namespace std::string_literals;

namespace {

std::string errors_of(std::string_view text) {
  Diagnostics diagnostics;
  const auto document = read_text(text, "f.xml", diagnostics);
  CHECK(diagnostics.has_errors());
  return diagnostics.text();
}

}  // namespace

TEST_CASE("a file that is missing, a folder, or empty is named with the reason", "[xml][reading]") {
  Diagnostics diagnostics;
  CHECK_FALSE(read_file("no/such/file.xml", diagnostics));
  CHECK(diagnostics.text() ==
        "no/such/file.xml:1:1: error G101: the file cannot be read: No such file or directory\n");
  Diagnostics copied;  // as by a graph that was copied to another folder
  CHECK_FALSE(read_file("no/../such/sim/worlds/office.xml", copied));
  CHECK(copied.text().find("No such file or directory; Orca's own is " ORCA_BINARY_DIR
                           "/share/orca/sim/worlds/office.xml") != std::string::npos);
  Diagnostics folder;
  CHECK_FALSE(read_file(ORCA_SOURCE_DIR, folder));
  CHECK(folder.text().find("Is a directory") != std::string::npos);
  CHECK(errors_of("") == "f.xml:1:1: error G102: the file is empty, an XML document is expected\n");
  CHECK(errors_of(" \n ").find("error G102") != std::string::npos);
}

TEST_CASE("a file is read from disk", "[xml][reading]") {
  const auto path = std::filesystem::temp_directory_path() / "orca_xml_reading_test.xml";
  std::ofstream(path) << "<r/>";
  Diagnostics diagnostics;
  const auto document = read_file(path.string(), diagnostics);
  std::filesystem::remove(path);
  REQUIRE(document.has_value());
  CHECK(document->root.position().file == path.string());
}

TEST_CASE("lines that lead editors to schemas are skipped, behind an XML declaration or without one",
          "[xml][reading]") {
  for (const std::string text :
       {"<?xml-model href='a.xsd'?>\n<r/>", "<?xml version='1.0'?><?xml-model href='a.xsd'?>\n<r/>"}) {
    Diagnostics diagnostics;
    const auto document = read_text(text, "f.xml", diagnostics);
    INFO(diagnostics.text());
    REQUIRE(document.has_value());
    CHECK(document->root.position().line == 2);
  }
}

TEST_CASE("a line for editors that is not closed hides nothing", "[xml][reading]") {
  CHECK(errors_of("<?xml version='1.0'?><?xml-model href='a.xsd'><a b='?>'/>").find("1:22: error G120") !=
        std::string::npos);
}

TEST_CASE("encodings other than UTF-8 are refused with a hint", "[xml][reading]") {
  CHECK(
      errors_of("\xFF\xFE<\0r\0"s).find("1:1: error G105: the file is UTF-16 or UTF-32; save it as UTF-8") !=
      std::string::npos);
  CHECK(errors_of("<\0r\0/\0>\0"s).find("G105") != std::string::npos);
  CHECK(errors_of("<?xml version='1.0' encoding='ISO-8859-1'?><r/>")
            .find("G105: the file declares the encoding \"iso-8859-1\"") != std::string::npos);
  CHECK(
      errors_of("<r>\n caf\xE9</r>").find("f.xml:2:5: error G106: the byte 0xe9 at offset 8 is not UTF-8") !=
      std::string::npos);
}

TEST_CASE("a byte order mark is an error, and the rest of the file is still checked", "[xml][reading]") {
  const std::string text = errors_of("\xEF\xBB\xBF<r a='1' a='2'/>");
  CHECK(text.find("G104") != std::string::npos);
  CHECK(text.find("G116") != std::string::npos);
}

TEST_CASE("the first byte that is not text is named", "[xml][reading]") {
  CHECK(errors_of("<r>\0</r>"s).find("f.xml:1:4: error G106: the byte 0x00 at offset 3") !=
        std::string::npos);
  CHECK(errors_of("\x7F"
                  "ELF\x02")
            .find("1:1: error G106: the byte 0x7f at offset 0") != std::string::npos);
  CHECK(errors_of("{\"name\": 1}").find("1:1: error G107: this is not XML: it starts with \"{\"") !=
        std::string::npos);
}

TEST_CASE("each mistake gives one error at its place", "[xml][reading]") {
  const auto [text, expected] = GENERATE(table<std::string, std::string>({
      {"<!-- only -->", "1:14: error G108: there is no element"},
      {"<a/><b/>", "1:5: error G109: <b> is a second root element"},
      {"<a/>tail", "1:5: error G109: there is text outside"},
      {"<a><b>\n<c/>",
       "2:5: error G110: the file ends here, but <b> from line 1, column 4 is not closed, nor the 1"},
      {"<a><b x='1'", "1:12: error G110: the file ends inside the tag <b> from line 1, column 4"},
      {"<a x='1", "1:8: error G110: the file ends inside the value of attribute \"x\" from line 1, column 6"},
      {"<a>\n <b>\n </a>",
       "3:2: error G111: the end tag </a> does not fit: <b> from line 2, column 2 is open"},
      {"<a>\n <b>\n </bb></a>", "3:2: error G111: the end tag </bb> does not fit"},
      {"<a></a></b>", "1:8: error G111: the end tag </b> closes nothing"},
      {"<a/></b", "1:5: error G111: the end tag </b> closes nothing"},
      {"<a/></", "1:5: error G111: the end tag </> closes nothing"},
      {"<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>", "1:1: error G112"},
      {"<a>1 < 2</a>", "1:6: error G113: no name follows \"<\""},
      {"<a ,b='1'/>", "1:4: error G113: \",\" does not belong in the tag <a>"},
      {"<a b='1'c='2'/>", "1:9: error G113: a blank is missing"},
      {"<a></a b>", "1:8: error G113: the end tag </a> is not closed"},
      {"<a b/>", "1:4: error G114: attribute \"b\" has no value"},
      {"<a b=1/>", "1:6: error G114: the value of attribute \"b\" must stand in quotes"},
      {"<a b=“1”/>", "typographic"},
      {"<a b='1>\n <c d='2'/></a>",
       "2:2: error G115: \"<\" in the value of attribute \"b\" from line 1, column 6"},
      {"<a b='1' b='2'/>", "1:10: error G116: attribute \"b\" is given already at line 1, column 4"},
      {"<a b='&nbsp;'/>", "1:7: error G117: the entity &nbsp; is not defined"},
      {"<a>R&D</a>", "1:5: error G117: a '&' for itself is written &amp;"},
      {"<a>&#0;</a>", "1:4: error G118: the character reference &#0;"},
      {"<a>&#xD800;</a>", "1:4: error G118"},
      {"<a><!-- x </a>", "1:4: error G119: the comment is not closed"},
      {"<a><!-- x -- y --></a>", "1:11: error G119: \"--\" may not stand inside"},
      {"<a><![CDATA[ x ]></a>", "1:4: error G119: the CDATA section is not closed"},
      {"<a><?php x ?></a>", "1:4: error G120: processing instructions"},
      {"<?xml version='1.0'?><!-- --><?xml-model href='a.xsd'?><a/>", "1:30: error G120"},
      {"<?xml version='2.0'?><a/>",
       "1:1: error G122: the file declares version \"2.0\" of XML; only 1.0 is read"},
      {"<?xml version='1.1'?><a/>", "1:1: error G122"},
      {"<?xml encoding='UTF-8'?><a/>", "1:1: error G122: the XML declaration has no version"},
      {"<?xml?>\n<a/>", "1:1: error G122: the XML declaration has no version"},
      {"<a>\n<b\u00a0c='1'/></a>", "2:3: error G113: a no-break space (U+00A0) stands here"},
      {"<a b='1'\u00a0c='2'/>", "1:9: error G113: a no-break space (U+00A0) stands here"},
      {"<a b\u00a0= '2'/>", "1:5: error G113: a no-break space (U+00A0) stands here"},
      {"<a b=\u3000'2'/>", "1:6: error G113: a blank of another kind (U+3000) stands here"},
      {"<a b='2'\u2003 \u2003/>", "1:9: error G113: a blank of another kind (U+2003) stands here"},
      {"<a></a\u202f>", "1:7: error G113: a blank of another kind (U+202F) stands here"},
      {"\u00a0<a/>", "1:1: error G109: a no-break space (U+00A0) stands here"},
      {"<a/>\u00a0", "1:5: error G109: there is a no-break space (U+00A0) outside the root element"},
      {" <?xml version='1.0'?><a/>", "1:2: error G120: the XML declaration may only stand at the very start"},
  }));
  const std::string found = errors_of(text);
  INFO(text << "\n" << found);
  CHECK(found.find(expected) != std::string::npos);
  CHECK(std::count(found.begin(), found.end(), '\n') == 1);
}

TEST_CASE("several mistakes are reported together", "[xml][reading]") {
  const std::string found = errors_of("<a b='1' b='2'>\n<c d=3/>\n<e f='&x;'/>\n</a>");
  for (const char* place : {"1:10: error G116", "2:6: error G114", "3:7: error G117"})
    CHECK(found.find(place) != std::string::npos);
}

TEST_CASE("nesting, attributes, elements and size are limited, and the error names the limit",
          "[xml][reading]") {
  const auto nested = [](std::size_t depth) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += "<a>";
    for (std::size_t i = 0; i < depth; ++i) text += "</a>";
    return text;
  };
  Diagnostics diagnostics;
  CHECK(read_text(nested(Limits::kNesting), "f.xml", diagnostics).has_value());
  CHECK(diagnostics.text().empty());
  CHECK(errors_of(nested(Limits::kNesting + 1)).find("error G121") != std::string::npos);
  std::string wide = "<a";
  for (std::size_t i = 0; i <= Limits::kAttributes; ++i) wide += " x" + std::to_string(i) + "='1'";
  CHECK(errors_of(wide + "/>").find("error G121: more than 64 attributes") != std::string::npos);
  std::string many = "<a>";
  for (std::size_t i = 0; i < Limits::kElements; ++i) many += "<b/>";
  CHECK(errors_of(many + "</a>").find("error G121: there are more than 500000 elements") !=
        std::string::npos);
  CHECK(errors_of(std::string(Limits::kBytes + 1, ' ')).find("G103") != std::string::npos);
}

TEST_CASE("end tags that cross each other are one error, and hide no other", "[xml][reading]") {
  const std::string crossed =
      "f.xml:1:7: error G111: the end tag </a> does not fit: <b> from line 1, column 4 is open and needs "
      "</b> first\n";
  CHECK(errors_of("<a><b></a></b>") == crossed);
  CHECK(errors_of("<r><b><c></b></c><d/></r>") ==
        "f.xml:1:10: error G111: the end tag </b> does not fit: <c> from line 1, column 7 is open and needs "
        "</c> "
        "first\n");
  const std::string twice = errors_of("<r><b><c></b></c></c></r>");
  CHECK(std::count(twice.begin(), twice.end(), '\n') == 2);  // the second </c> closes nothing
  const std::string after = errors_of("<r><b><c></b></c><d e=1/></r>");
  CHECK(after.find("error G114") != std::string::npos);
}

TEST_CASE("an end tag too many in the middle is one error", "[xml][reading]") {
  CHECK(errors_of("<a><b></c></b></a>") ==
        "f.xml:1:7: error G111: the end tag </c> does not fit: <b> from line 1, column 4 is open and needs "
        "</b> "
        "first\n");
  const std::string after = errors_of("<a><b></c></b><d e=1/><b></b></a>");
  CHECK(std::count(after.begin(), after.end(), '\n') == 2);
  CHECK(after.find("error G114") != std::string::npos);
}

TEST_CASE("a line ends with LF, CR LF, or CR alone", "[xml][reading]") {
  CHECK(errors_of("<a>\n\n <b c=1/></a>").starts_with("f.xml:3:7: "));
  CHECK(errors_of("<a>\r\n\r\n <b c=1/></a>").starts_with("f.xml:3:7: "));
  CHECK(errors_of("<a>\r\r <b c=1/></a>").starts_with("f.xml:3:7: "));
  CHECK(errors_of("<a>\n\r <b c=1/></a>").starts_with("f.xml:3:7: "));
  CHECK(errors_of("<a>\r\n\r <b\r c=1/></a>").starts_with("f.xml:4:4: "));
}

TEST_CASE("a blank of another kind in a text or value is part of it", "[xml][reading]") {
  Diagnostics diagnostics;
  const auto document = read_text("<a b='1\u00a0m'>x\u00a0y</a>", "f.xml", diagnostics);
  REQUIRE(document.has_value());
  CHECK(document->root.attribute("b")->value == "1\u00a0m");
  CHECK(document->root.text() == "x\u00a0y");
}

TEST_CASE("names of megabytes fill no message", "[xml][reading]") {
  const std::string name(4'000'000, 'n');
  for (const std::string& text :
       {"<" + name + "></b>", "<a></" + name + "></a>", "<a " + name + "></a>", "<a " + name + "=1></a>",
        "<a " + name + "='1' " + name + "='2'/>", "<" + name + " x='1'y='2'", "<a/><" + name + "/>"}) {
    const std::string found = errors_of(text);
    CHECK(found.size() < 1000);
    CHECK(found.find("nnn...(4000000 bytes)...nnn") != std::string::npos);
  }
}

TEST_CASE("the number of errors reported is limited", "[xml][reading]") {
  Diagnostics diagnostics;
  std::string text = "<a>";
  for (int i = 0; i < 100000; ++i) text += "&";
  CHECK(read_text(text + "</a>", "f.xml", diagnostics).has_value() == false);
  CHECK(diagnostics.error_count() <= 1001);
}
