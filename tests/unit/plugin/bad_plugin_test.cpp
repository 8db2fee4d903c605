// SPDX-License-Identifier: GPL-3.0-or-later
// Files that are no plugins, or not for this runtime: refused with what is wrong and what to do, and gone
// again.
#include <fstream>

#include "places.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;

TEST_CASE("a file that does not exist is not found", "[plugin][bad]") {
  const Error error = refusal(test_plugin("none"));
  CHECK(error.code == Code::not_found);
  CHECK(error.where == test_plugin("none"));
  CHECK_THAT(error.text(), Contains("no such plugin"));
  CHECK(refusal(kForTests).code == Code::not_found);
}

TEST_CASE("a file that is no shared library is refused in the loader's words", "[plugin][bad]") {
  const std::string path = kForTests + "/text.so";
  std::ofstream(path) << "This is a text.\n";
  const Error error = refusal(path);
  std::filesystem::remove(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK(error.where == path);
  CHECK_THAT(error.text(), Contains("cannot be loaded"));
}

TEST_CASE("a library without a manifest is refused and unloaded", "[plugin][bad]") {
  const std::string path = test_plugin("bad_no_manifest");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("is not an Orca plugin") && Contains("orca_add_component()"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin for another ABI version is refused with both versions and unloaded", "[plugin][bad]") {
  const std::string path = test_plugin("bad_abi_version");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("plugin ABI " + std::to_string(kAbiVersion + 1)) &&
                               Contains("this is ABI " + std::to_string(kAbiVersion)) &&
                               Contains("build it again"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin whose manifest has another size is refused with both sizes and unloaded",
          "[plugin][bad]") {
  const std::string path = test_plugin("bad_manifest_size");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains(std::to_string(sizeof(Manifest) - 8) + " bytes") &&
                               Contains("(" + std::to_string(sizeof(Manifest)) + " bytes)"));
  CHECK_FALSE(is_mapped(path));
}

TEST_CASE("a plugin that uses what no library provides is refused with the readable name", "[plugin][bad]") {
  const std::string path = test_plugin("bad_undefined_symbol");
  const Error error = refusal(path);
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("orca::test::beyond_all_libraries(double)") && Contains("LINK"));
  CHECK_FALSE(is_mapped(path));
}
