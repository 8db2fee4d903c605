// SPDX-License-Identifier: GPL-3.0-or-later
#include "web_files.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "temp_folder.hpp"

using namespace orca::view;

TEST_CASE("the page's own files are found by their names, and nothing else is", "[view]") {
  const orca::test::TempFolder folder;
  std::filesystem::create_directory(folder.file("inner"));
  for (const char* const name : {"index.html", "view.js", "secret.txt", ".hidden.js", "inner/deep.js"})
    std::ofstream(folder.file(name)) << name;
  const WebFiles files(folder.path().string());

  REQUIRE(files.find("/"));
  CHECK(files.find("/")->text == "index.html");
  CHECK(files.find("/")->type == "text/html; charset=utf-8");
  CHECK(files.find("/?x=1")->text == "index.html");
  REQUIRE(files.find("/view.js"));
  CHECK(files.find("/view.js")->type == "text/javascript; charset=utf-8");
  for (const char* const target :
       {"", "view.js", "/secret.txt", "/.hidden.js", "/inner/deep.js", "/../web_files_test.cpp",
        "//etc/passwd", "/%2e%2e/x.js", "/nobody.js", "/lib/view.js", "/lib/../view.js"})
    CHECK_FALSE(files.find(target));
}
