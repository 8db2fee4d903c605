// SPDX-License-Identifier: GPL-3.0-or-later
#include "template_folder.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "temp_folder.hpp"

using namespace orca;
using namespace orca::orcactl;
using namespace orca::test;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

// A present folder of its own, and templates of one kind beside it.
class Place {
 public:
  Place() : before_(fs::current_path()) {
    fs::create_directories(templates() / "component");
    fs::create_directory(folder_.path() / "here");
    put("component/@NAME@.cpp", "class @CLASS@ : Component {};  // @TYPE@, \"@TYPE@\"\n");
    put("component/graph.xml", "<component name=\"base\"/><component name=\"@NAME@\"/>\n");
    fs::current_path(folder_.path() / "here");
  }
  ~Place() { fs::current_path(before_); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;

  [[nodiscard]] fs::path templates() const { return folder_.path() / "templates"; }
  void put(const std::string& file, const std::string& text) const {
    std::ofstream(templates() / file) << text;
  }
  [[nodiscard]] Result<std::vector<std::string>> make(const std::string& kind,
                                                      const std::string& name) const {
    return make_folder(templates(), kind, name);
  }
  [[nodiscard]] Error refusal(const std::string& kind, const std::string& name) const {
    const auto made = make(kind, name);
    REQUIRE_FALSE(made);
    return made.error();
  }

 private:
  const TempFolder folder_;
  const fs::path before_;
};

}  // namespace

TEST_CASE("a new folder has the files of its template with names in place of marks", "[orcactl][new]") {
  const Place place;
  const auto made = place.make("component", "follow_light");
  REQUIRE(made);
  CHECK(*made == std::vector<std::string>{"follow_light.cpp", "graph.xml"});
  CHECK(read_text("follow_light/follow_light.cpp") ==
        "class FollowLight : Component {};  // my.FollowLight, \"my.FollowLight\"\n");
  CHECK_THAT(read_text("follow_light/graph.xml"), Contains("<component name=\"follow_light\"/>"));
}

TEST_CASE("each part of a name between _ begins with a capital in the class", "[orcactl][new]") {
  const auto [name, own] = GENERATE(table<std::string, std::string>(
      {{"a", "A"}, {"light2", "Light2"}, {"FollowLight", "FollowLight"}, {"a__b_", "AB"}, {"x_1", "X1"}}));
  const Place place;
  REQUIRE(place.make("component", name));
  CHECK_THAT(read_text(name + "/" + name + ".cpp"), Contains("class " + own + " :"));
}

TEST_CASE("a name that cannot be one of a class and a folder is refused", "[orcactl][new]") {
  const std::string name = GENERATE("", "2lights", "_light", "../light", "follow-light", "a b", "l\xc3\xaght",
                                    "a.b", std::string(41, 'a'));
  const Place place;
  const Error error = place.refusal("component", name);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.message, Contains("write a letter, then letters, digits and _, 40 at most"));
  CHECK(fs::is_empty("."));
}

TEST_CASE("a name that the template or CMake uses itself is refused", "[orcactl][new]") {
  const std::string name = GENERATE("base", "component", "test", "all");
  const Place place;
  CHECK_THAT(place.refusal("component", name).message, Contains("write another one, such as my_" + name));
  CHECK(fs::is_empty("."));
}

TEST_CASE("what is there already stays as it is", "[orcactl][new]") {
  const Place place;
  fs::create_directory("light");
  std::ofstream("dark") << "a file";
  for (const char* name : {"light", "dark"}) {
    CHECK(place.refusal("component", name).code == Code::already_exists);
    CHECK_THAT(place.refusal("component", name).message, Contains("already, which stays as it is"));
  }
  CHECK(fs::is_empty("light"));
  CHECK(read_text("dark") == "a file");
}

TEST_CASE("an unknown kind is refused with the kinds that there are", "[orcactl][new]") {
  const Place place;
  const std::string kind = GENERATE("robot", "", "../templates/component", "object");
  CHECK_THAT(place.refusal(kind, "light").message, Contains("new expects one of component, not"));
}

TEST_CASE("where there are no templates, the message says what brings them", "[orcactl][new]") {
  const Place place;
  fs::remove_all(place.templates());
  CHECK_THAT(place.refusal("component", "light").message, Contains("there are no templates in"));
}
