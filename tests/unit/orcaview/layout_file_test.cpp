// SPDX-License-Identifier: GPL-3.0-or-later
#include "layout_file.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "temp_folder.hpp"

using namespace orca::view;
using orca::Code;

namespace {

std::string bytes_of(const std::string& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::size_t files_in(const orca::test::TempFolder& folder) {
  using Files = std::filesystem::directory_iterator;
  return static_cast<std::size_t>(std::distance(Files(folder.path()), Files()));
}

}  // namespace

TEST_CASE("a layout lies beside its graph, a component a line, and is read again", "[view]") {
  const orca::test::TempFolder folder;
  const std::string graph = folder.file("my.robot.xml");
  CHECK(layout_file_of(graph) == folder.file("my.robot.layout.json"));
  CHECK(read_layout(graph).value() == "{}");
  REQUIRE(keep_layout(graph, R"({"goto":[120,40.5],"dewey/base":[-3,0]})").ok());
  CHECK(bytes_of(layout_file_of(graph)) == "{\n\"dewey/base\": [-3,0],\n\"goto\": [120,40.5]\n}\n");
  CHECK(read_layout(graph).value() == R"({"dewey/base":[-3,0],"goto":[120,40.5]})");
  CHECK(files_in(folder) == 1);
}

TEST_CASE("an empty layout leaves no file", "[view]") {
  const orca::test::TempFolder folder;
  const std::string graph = folder.file("my.xml");
  REQUIRE(keep_layout(graph, R"({"goto":[1,2]})").ok());
  CHECK(keep_layout(graph, "{}").ok());
  CHECK(keep_layout(graph, "{}").ok());
  CHECK(files_in(folder) == 0);
}

TEST_CASE("a pipe in the place of a layout is an error at once", "[view]") {
  const orca::test::TempFolder folder;
  const std::string graph = folder.file("my.xml");
  REQUIRE(mkfifo(layout_file_of(graph).c_str(), 0600) == 0);
  CHECK(read_layout(graph).error().code == Code::unavailable);
}

TEST_CASE("what is no layout is neither kept nor overwritten", "[view]") {
  const orca::test::TempFolder folder;
  const std::string graph = folder.file("my.xml");
  for (const char* const text : {"", "null", "[]", R"({"a":1})", R"({"a":[1]})", R"({"a":[1,"2"]})",
                                 R"({"a":[1,1e300]})", "{\"a\":[1,2]"})
    CHECK(keep_layout(graph, text).error().code == Code::invalid_argument);
  CHECK(files_in(folder) == 0);
  std::ofstream(layout_file_of(graph)) << "{\"mine\": true}";
  CHECK(read_layout(graph).error().code == Code::data_loss);
  CHECK(keep_layout(graph, R"({"goto":[1,2]})").error().code == Code::failed_precondition);
  CHECK(bytes_of(layout_file_of(graph)) == "{\"mine\": true}");
}

TEST_CASE("a graph in a folder that nobody may write keeps no layout", "[view]") {
  const orca::test::TempFolder folder;
  const auto missing = folder.file("nowhere/my.xml");
  CHECK(keep_layout(missing, R"({"goto":[1,2]})").error().code == Code::unavailable);
}
