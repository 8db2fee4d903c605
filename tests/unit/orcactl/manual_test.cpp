// SPDX-License-Identifier: GPL-3.0-or-later
#include "manual.hpp"

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <iostream>

using namespace orca::orcactl;
using Catch::Contains;

namespace {

// Returns whether a shell understands its script.
bool is_understood(const std::string& shell) {
  std::FILE* const pipe = popen((shell + " -n").c_str(), "w");
  REQUIRE(pipe != nullptr);
  std::fputs(completion_script(shell).c_str(), pipe);
  return pclose(pipe) == 0;
}

}  // namespace

TEST_CASE("every command and option is in help, man page and completion", "[orcactl]") {
  for (const Command& command : commands()) {
    const std::string name(command.name);
    CHECK_THAT(help_text(), Contains("\n  " + name));
    CHECK_THAT(completion_script("bash"), Contains("    " + name + ") options="));
    CHECK_THAT(completion_script("zsh"), Contains("'" + name + ":"));
    for (const OptionSpec& option : command.options) {
      CHECK_THAT(help_text(command), Contains(std::string(option.name)));
      CHECK_THAT(completion_script("bash"), Contains(std::string(option.name)));
    }
  }
  CHECK_THAT(man_page("1"), Contains(".TH ORCACTL 1"));
}

TEST_CASE("the lines of help fit a terminal", "[orcactl]") {
  std::string text = help_text();
  for (const Command& command : commands()) text += help_text(command);
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos;
       begin = end + 1, end = text.find('\n', begin)) {
    const std::string line = text.substr(begin, end - begin);
    if (line.starts_with("  ")) CHECK(line.size() <= 120);
  }
}

TEST_CASE("bash understands its completion script, and other shells have none", "[orcactl]") {
  CHECK(is_understood("bash"));
  CHECK(completion_script("fish").empty());
}

TEST_CASE("zsh understands its completion script, where it is installed", "[orcactl][tool]") {
  if (std::system("command -v zsh >/dev/null") != 0) {
    std::cout << "SKIPPED: there is no zsh; apt install zsh\n";
    return;
  }
  CHECK(is_understood("zsh"));
}
