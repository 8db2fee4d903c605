// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are no plugins, or not for this runtime. They are refused with the fault and the remedy, and
// removed from memory again.
#include <fstream>

#include "places.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;

TEST_CASE("a file that does not exist is not found", "[plugin][bad]") {
  const Error error = refusal(test_plugin("none"));
  CHECK(error.code == Code::not_found);
  CHECK(error.where == test_plugin("none"));
  CHECK_THAT(error.text(), Contains("no such plugin"));
  CHECK(refusal(kForTests).code == Code::not_found);
}

TEST_CASE("a file that is no shared library is refused as that", "[plugin][bad]") {
  const std::string path = kForTests + "/text.so";
  std::ofstream(path) << "This is a text.\n";
  const Error error = refusal(path);
  std::filesystem::remove(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK(error.where == path);
  CHECK_THAT(error.text(), Contains("is no shared library"));
}

TEST_CASE("a program is refused as a program", "[plugin][bad]") {
  const std::string this_program = std::filesystem::read_symlink("/proc/self/exe").string();
  CHECK_THAT(refusal(this_program).text(), Contains("is no shared library, but a program"));
}

TEST_CASE("a library without a manifest is refused and never mapped", "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_no_manifest");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("is not an Orca plugin") && Contains("orca_add_component()"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin that holds two classes with one type is refused and unloaded", "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_twice");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("two classes with the type \"test.First\"") &&
                               Contains("give one of them another name"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin for a newer ABI version is refused with both versions and what to do", "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_abi_newer");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("plugin ABI " + std::to_string(kAbiVersion + 1)) &&
                               Contains("this is ABI " + std::to_string(kAbiVersion)) &&
                               Contains("the plugin is newer") &&
                               Contains("use the Orca that it was built with"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin for an older ABI version is refused with both versions and what to do", "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_abi_older");
  const Error error = refusal(path);
  CHECK_THAT(error.text(), Contains("plugin ABI " + std::to_string(kAbiVersion - 1)) &&
                               Contains("the plugin is older") && Contains("build it again"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin whose manifest has another size is refused with both sizes", "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_manifest_size");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains(std::to_string(sizeof(Manifest) - 8) + " bytes") &&
                               Contains("(" + std::to_string(sizeof(Manifest)) + " bytes)"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin that uses what no library provides is refused with the readable name", "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_undefined_symbol");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("orca::test::beyond_all_libraries(double)") && Contains("LINK"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin that needs a library that is not there is refused with the library's name",
          "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_missing_library");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("libraries that are not found: libgone_for_ever.so.7"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin built without the recipe is refused with the symbols that would keep it in memory",
          "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_pinned");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("could never be unloaded") && Contains("pinning::") &&
                               Contains("exports more than its manifest") &&
                               Contains("orca_add_component()"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin with a thread_local variable that has a destructor is refused", "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_thread_local");
  CHECK_THAT(refusal(path).text(), Contains("could never be unloaded") && Contains("thread_local"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin with functions that would be called after it was unloaded is refused", "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_endings");
  CHECK_THAT(refusal(path).text(),
             Contains("could crash the process after it was unloaded, when that ends, by on_exit()") &&
                 Contains("when one of its threads ends, by pthread_key_create()"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE(
    "a plugin built for other layouts of the objects is refused with each type and the field that differs",
    "[plugin][bad]") {
  const std::string path = test_plugin("bad/bad_layout");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(
      error.text(),
      Contains(
          R"x(another layout of the object type GoalPoint: the field "creation_time.ns" is "int64 {us}" in the )x"
          R"x(plugin and "int64 {ns}" in this Orca; build it again)x") &&
          Contains("uses the object type Balloon, which this Orca does not have"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin whose static initialisation ends the process is refused, and this process lives on",
          "[plugin][bad][trial]") {
  const auto [how, text] = GENERATE(table<std::string, std::string>(
      {{"throws", "threw std::runtime_error: the static initialisation smokes"},
       {"exits", "ended the process with exit(4)"},
       {"crashes", "ended the process with the signal SEGV"},
       {"hangs", "did not return within 5 s"}}));
  const std::string path = test_plugin("bad/bad_static_" + how);
  const Error error = refusal(path);
  CHECK(error.where == path);
  CHECK_THAT(error.text(), Contains("its static initialisation " + text));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE(
    "a plugin with an object whose creation or end ends the process is refused, be it component or hardware",
    "[plugin][bad][trial]") {
  CHECK_THAT(refusal(test_plugin("bad/bad_constructor_exits")).text(),
             Contains("the constructor or destructor of test.Leaves ended the process with exit(5)"));
  CHECK_THAT(refusal(test_plugin("bad/bad_hardware_exits")).text(),
             Contains("the constructor or destructor of test.hw.Leaves ended the process with exit(6)"));
}
