// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/plugin/index.hpp"

#include <set>

#include "orca/plugin/describe.hpp"
#include "places.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;

TEST_CASE("the index names the file that holds a type", "[plugin][index]") {
  const PluginIndex index({kShipped, kForTests});
  CHECK(index.file_of("orca.Goto").value() == kShipped + "/goto.so");
  CHECK(index.file_of("test.Statics").value() == test_plugin("test_statics"));
  CHECK(index.file_of("test.First").value() == test_plugin("test_two"));
  CHECK(index.file_of("test.hw.Second").value() == test_plugin("test_two"));
}

TEST_CASE("a type that no plugin holds is not found, and the error names the places searched",
          "[plugin][index]") {
  const PluginIndex index({kShipped, "/no/such/folder"});
  const auto file = index.file_of("orca.Gotto");
  REQUIRE_FALSE(file.has_value());
  CHECK(file.error().code == Code::not_found);
  CHECK_THAT(file.error().text(), Contains("\"orca.Gotto\"") && Contains(kShipped) &&
                                      Contains("/no/such/folder (no such folder)"));
}

TEST_CASE("a plugin that was copied without its list of types is named where its type is not found",
          "[plugin][index]") {
  const TempFolder folder;
  const std::string copy = folder.path().string();
  std::filesystem::copy_file(test_plugin("test_two"), copy + "/test_two.so");
  const auto found = PluginIndex({copy}).file_of("test.First");
  REQUIRE_FALSE(found.has_value());
  CHECK_THAT(found.error().message,
             Contains(copy + "/test_two.so is not looked into") && Contains("copy test_two.types, too"));
}

TEST_CASE("the first of two folders that hold a type wins", "[plugin][index]") {
  const std::string copy = kForTests + "/first";
  std::filesystem::create_directories(copy);
  for (const char* const extension : {".so", ".types"})
    std::filesystem::copy_file(kForTests + "/test_two" + extension, copy + "/test_two" + extension,
                               std::filesystem::copy_options::overwrite_existing);
  CHECK(PluginIndex({copy, kForTests}).file_of("test.First").value() == copy + "/test_two.so");
  CHECK(PluginIndex({kForTests, copy}).file_of("test.First").value() == test_plugin("test_two"));
  std::filesystem::remove_all(copy);
}

TEST_CASE("a type that two plugins of one folder hold is refused with both, and the others are found",
          "[plugin][index]") {
  const orca::test::TempFolder folder;
  static_cast<void>(folder.write("one.types", "component my.Both\ncomponent my.One\n"));
  static_cast<void>(folder.write("two.types", "component my.Both\n"));
  const PluginIndex index({folder.path().string()});
  const auto both = index.file_of("my.Both");
  REQUIRE_FALSE(both.has_value());
  CHECK(both.error().code == Code::already_exists);
  CHECK_THAT(both.error().text(), Contains("two plugins hold the type \"my.Both\"") &&
                                      Contains(folder.file("one.so")) && Contains(folder.file("two.so")));
  CHECK(index.file_of("my.One").value() == folder.file("one.so"));
}

TEST_CASE("the index knows what a type is, in the words of its author", "[plugin][index]") {
  CHECK(PluginIndex({kShipped}).text_of("orca.Goto") ==
        "A behaviour that drives to a goal in a straight line (thesis 11.1).");
  const orca::test::TempFolder folder;
  static_cast<void>(
      folder.write("one.types", "component my.Cook  Cooks; and more.\n\nhardware my.Pot\nhalf\n"));
  const PluginIndex index({folder.path().string()});
  CHECK(index.text_of("my.Cook") == "Cooks; and more.");
  CHECK(index.text_of("my.Pot").empty());
  CHECK(index.text_of("my.Guest").empty());
  CHECK(index.types(PluginKind::component) == std::vector<std::string>{"my.Cook"});
  CHECK(index.types(PluginKind::hardware) == std::vector<std::string>{"my.Pot"});
}

TEST_CASE("an index that is refreshed knows the plugins that have come, and not those that have gone",
          "[plugin][index]") {
  const orca::test::TempFolder folder;
  const std::string old = folder.write("old.types", "component my.Old\n");
  PluginIndex index({folder.path().string()});
  static_cast<void>(folder.write("new.types", "component my.New\n"));
  std::filesystem::remove(old);
  CHECK(index.file_of("my.Old").has_value());
  index.refresh();
  CHECK(index.file_of("my.New").value() == folder.file("new.so"));
  CHECK_FALSE(index.file_of("my.Old").has_value());
}

TEST_CASE("the index agrees with the plugin's manifest", "[plugin][index]") {
  for (const std::string& folder : {kShipped, kForTests}) {
    const PluginIndex index({folder});
    for (const PluginKind kind : {PluginKind::component, PluginKind::hardware}) {
      const std::vector<std::string> listed = index.types(kind);
      std::set<std::string> held;
      for (const std::string& type : listed) {
        const auto library = loaded(index.file_of(type).value());
        for (const TypeEntry* entry : library->types())
          if (entry->kind == kind) held.emplace(entry->type);
      }
      CHECK_FALSE(listed.empty());
      CHECK(std::vector<std::string>(held.begin(), held.end()) == listed);
    }
  }
}
