// SPDX-License-Identifier: GPL-3.0-or-later
// Object types that are not Orca's own: their libraries make them known, and everything that treats all types alike treats them so.
#include "orca/plugin/object_library.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "orca/base/hash.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/object_library.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/plugin/describe.hpp"
#include "orca/text/object_xml.hpp"
#include "orca/xml/diagnostics.hpp"
#include "places.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kFolder = kForTests + "/objects";
const std::string kLight = kFolder + "/test_light.so";

// Returns a known type of the library, which stays in memory from then on.
const ObjectType& type_of_light(const std::string& name) {
  const Status loaded = load_object_library(kLight);
  INFO((loaded.ok() ? "" : loaded.error().text()));
  REQUIRE(loaded.ok());
  const ObjectType* const type = find_object_type(name);
  REQUIRE(type != nullptr);
  return *type;
}

std::string refused(const std::string& file) {
  const Status loaded = load_object_library(file);
  return loaded.ok() ? "" : loaded.error().text();
}

// Writes a copy of the library with other bytes in place of some, wherever they stand.
std::string changed_copy(const TempFolder& folder, const std::string& name, const std::string& from,
                         const std::string& to) {
  REQUIRE(from.size() == to.size());
  std::string bytes = read_text(kLight);
  std::size_t count = 0;
  for (std::size_t at = 0; (at = bytes.find(from, at)) != std::string::npos; at += to.size(), ++count)
    bytes.replace(at, to.size(), to);
  REQUIRE(count > 0);
  return folder.write(name, bytes);
}

}  // namespace

TEST_CASE("a library makes its object types known, and they stay", "[plugin][objects]") {
  const auto own = object_types();
  const ObjectType& light = type_of_light("test.Light");
  CHECK(object_types().size() >= own.size());
  CHECK(std::ranges::is_sorted(object_types(), {}, &ObjectType::name));
  CHECK(find_object_type("Odometry") == &object_type<idl::Odometry>());
  CHECK(find_object_type("Light") == nullptr);
  CHECK(load_object_library(kLight).ok());
  CHECK(find_object_type("test.Light") == &light);
  CHECK(is_mapped(kLight));
  const auto libraries = object_libraries();
  const auto found = std::ranges::find(libraries, kLight, &ObjectLibrary::file);
  REQUIRE(found != libraries.end());
  CHECK(found->types == std::vector<std::string>{"test.Coloured", "test.Light", "test.SureRanges"});
}

TEST_CASE("the types of a library extend Orca's and each other", "[plugin][objects]") {
  const ObjectType& sure = type_of_light("test.SureRanges");
  const ObjectType& ranges = object_type<idl::RangeReadings>();
  const ObjectType& light = type_of_light("test.Light");
  CHECK(sure.parent == &ranges);
  CHECK(find_subtype(ranges, sure.layout_hash) == &sure);
  CHECK(find_subtype(light, type_of_light("test.Coloured").layout_hash) == find_object_type("test.Coloured"));
  CHECK(light.layout.starts_with("test.Light{creation_time:"));
}

TEST_CASE("objects of a library's types are pooled, written, read and shown like others",
          "[plugin][objects]") {
  const ObjectType& type = type_of_light("test.Light");
  const std::string text = R"(<test.Light source="SUN" stamp="2"><spots x="1" brightness="5"/></test.Light>)";
  xml::Diagnostics diagnostics;
  std::optional<ObjectLoan> object = from_xml(text, "test", diagnostics, nullptr);
  INFO(diagnostics.text());
  REQUIRE(object);
  CHECK(&object->type() == &type);
  CHECK(type.stamp(object->get()) == TimePoint(2s));
  std::vector<std::byte> bytes;
  type.serialize(object->get(), bytes);
  ObjectLoan copy = make_object(type);
  REQUIRE(type.deserialize(bytes, copy.get()).ok());
  CHECK(type.equal(object->get(), copy.get()));
  CHECK_THAT(to_xml(type, copy.get()), Contains(R"(source="SUN")") && Contains(R"(brightness="5")"));
  CHECK_THAT(type.dump(copy.get()), Contains("brightness: 5 lx"));
  CHECK(pool_statistics(type).live == 2);
}

TEST_CASE("a plugin loads the library beside it, and leaves it when it is unloaded", "[plugin][objects]") {
  const std::string path = kFolder + "/test_light_sensor.so";
  {
    auto plugin = PluginLibrary::load(path);
    INFO((plugin ? "" : plugin.error().text()));
    REQUIRE(plugin);
    const TypeEntry* const entry = (*plugin)->find(PluginKind::component, "test.LightSensor");
    REQUIRE(entry != nullptr);
    const Result<Contract> contract = describe_component(*entry, path, nullptr);
    REQUIRE(contract);
    CHECK(contract->ports.at(0).type.name == "test.Light");
    CHECK(contract->ports.at(1).type.ancestors.at(0).name == "RangeReadings");
    CHECK(is_mapped(path));
  }
  CHECK_FALSE(is_mapped(path));
  CHECK(is_mapped(kLight));
}

TEST_CASE("an index lists the object types of its folders", "[plugin][objects]") {
  const PluginIndex index({kFolder});
  CHECK(index.object_types().at("test.Light").library == kLight);
  CHECK(index.object_types().at("test.Light").text == "What a sensor of light sees.");
  CHECK(index.object_libraries().size() == 3);
  CHECK(index.types(PluginKind::component) == std::vector<std::string>{"test.LightSensor"});
}

TEST_CASE("a type of a name that is taken is refused, with both libraries", "[plugin][objects]") {
  (void)type_of_light("test.Light");
  const std::string again = kFolder + "/test_light_again.so";
  CHECK_THAT(refused(again),
             Contains(again + ": has the object type test.Light, which " + kLight + " has, too") &&
                 Contains("another module"));
  CHECK_FALSE(is_mapped(again));
  CHECK_THROWS_WITH(detail::add_object_types(object_types()), Contains("has the object type"));
}

TEST_CASE("a library of the same name with other fields is refused with the first that differs",
          "[plugin][objects]") {
  (void)type_of_light("test.Light");
  const TempFolder folder;
  const std::string same = folder.write("test_light.so", read_text(kLight));
  CHECK(refused(same).empty());
  CHECK_FALSE(is_mapped(same));
  const std::string other = folder.write("test_light.so", read_text(kFolder + "/test_light_again.so"));
  CHECK_THAT(refused(other), Contains("a library of this name is in memory, " + kLight) &&
                                 Contains(R"("spots.brightness" is "double {cd}" in this library)") &&
                                 Contains("start the system again"));
}

TEST_CASE("a plugin for another layout of a library's type is refused with the field that differs",
          "[plugin][objects]") {
  (void)type_of_light("test.Light");
  const TempFolder folder;
  const std::string hash = std::to_string(find_object_type("test.Light")->layout_hash);
  std::string bytes = read_text(kFolder + "/test_light_sensor.so");
  const auto change = [&bytes](const std::string& from, const std::string& to) {
    const std::size_t at = bytes.find(from);
    REQUIRE(at != std::string::npos);
    for (std::size_t next = at; next != std::string::npos; next = bytes.find(from, next))
      bytes.replace(next, from.size(), to);
  };
  change("5LightELm" + hash, "5LightELm" + std::string(hash.size(), '1'));
  change("brightness:double {lx}", "brightness:double {cd}");
  const auto plugin = PluginLibrary::load(folder.write("test_light_sensor.so", bytes));
  REQUIRE_FALSE(plugin);
  CHECK_THAT(plugin.error().text(),
             Contains("another layout of the object type test.Light") &&
                 Contains(R"("double {cd}" in the plugin and "double {lx}" in the library)"));
}

TEST_CASE("a library for another Orca is refused with what has changed", "[plugin][objects]") {
  const TempFolder folder;
  Fnv1a hash;
  hash.add_text(detail::part_layout("Point"));
  const std::string digits = std::to_string(hash.value());
  const std::string part =
      changed_copy(folder, "part.so", "5PointELm" + digits, "5PointELm" + std::string(digits.size(), '1'));
  CHECK_THAT(refused(part), Contains("was built for another layout of Point, which its types extend or hold; "
                                     "build it again with this Orca"));
  const std::string pool = changed_copy(folder, "pool.so", "orca::detail::Pool ", "orca::detail::Poll ");
  CHECK_THAT(refused(pool), Contains("orca::detail::Poll") && Contains("build it again"));
}

TEST_CASE("what is no library of object types is refused as that", "[plugin][objects]") {
  const TempFolder folder;
  CHECK_THAT(refused(folder.file("none.so")), Contains("there is no such library"));
  CHECK_THAT(refused(folder.write("text.so", "This is a text.\n")), Contains("is no shared library"));
  CHECK_THAT(refused(test_plugin("test_two")),
             Contains("is no library of object types") && Contains("orca_generate_idl()"));
}

TEST_CASE("a library that throws while it is loaded is refused, and nothing happens to the process",
          "[plugin][objects]") {
  const std::string path = kFolder + "/test_throwing_objects.so";
  CHECK_THAT(refused(path), Contains("its static initialisation") && Contains("when it was tried out"));
  CHECK(refused(path) == refused(path));
  CHECK_FALSE(is_mapped(path));
  CHECK(find_object_type("test_other.Thing") == nullptr);
}
