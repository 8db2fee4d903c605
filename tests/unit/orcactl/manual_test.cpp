// SPDX-License-Identifier: GPL-3.0-or-later
#include "common/manual.hpp"

#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "commands.hpp"
#include "temp_folder.hpp"

using namespace orca::apps;
using Catch::Contains;
using namespace orca::test;
using orca::orcactl::program;

namespace {

// Returns whether a shell understands its script.
bool is_understood(const std::string& shell) {
  std::FILE* const pipe = popen((shell + " -n").c_str(), "w");
  REQUIRE(pipe != nullptr);
  std::fputs(completion_script(program(), shell).c_str(), pipe);
  return pclose(pipe) == 0;
}

// Returns what bash offers for the last of some words by the script.
std::string offered_for(const std::string& words) {
  const TempFolder folder;
  const std::string script = folder.write(
      "try.sh", completion_script(program(), "bash") + "COMP_WORDS=(" + words +
                    "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _orcactl; echo ${COMPREPLY[*]}\n");
  const std::string to = folder.file("offered");
  REQUIRE(std::system(("bash " + script + " > " + to).c_str()) == 0);
  return read_text(to);
}

}  // namespace

TEST_CASE("every command and option is in help, man page and completion", "[orcactl]") {
  for (const Command& command : program().commands) {
    const std::string name(command.name);
    CHECK_THAT(help_text(program()), Contains("\n  " + name));
    CHECK_THAT(completion_script(program(), "bash"), Contains("  " + name + ") options="));
    CHECK_THAT(completion_script(program(), "zsh"), Contains("  " + name + ") options="));
    CHECK_THAT(man_page(program()), Contains(".B " + name));
    for (const OptionSpec& option : command.options) {
      CHECK_THAT(help_text(program(), command), Contains(std::string(option.name)));
      CHECK_THAT(completion_script(program(), "bash"), Contains(std::string(option.name)));
    }
  }
  CHECK_THAT(man_page(program()), Contains(".TH ORCACTL 1"));
}

TEST_CASE("the lines of help fit a terminal", "[orcactl]") {
  std::string text = help_text(program());
  for (const Command& command : program().commands) text += help_text(program(), command);
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos;
       begin = end + 1, end = text.find('\n', begin)) {
    const std::string line = text.substr(begin, end - begin);
    CHECK(line.size() <= 120);
  }
}

TEST_CASE("bash completes commands, options and their values by its script", "[orcactl]") {
  CHECK(is_understood("bash"));
  CHECK(offered_for("orcactl --json ec") == "echo\n");
  CHECK(offered_for("orcactl echo --f") == "--for --field\n");
  CHECK(offered_for("orcactl log --level d") == "debug\n");
}

TEST_CASE("each program answers for its help, version, man page and completion", "[orcactl]") {
  const auto answer_to = [](const std::vector<std::string>& words) {
    return answer(program(), parse(program(), words)).value_or("nothing");
  };
  CHECK_THAT(answer_to({"--help"}), Contains("look at a running system"));
  CHECK_THAT(answer_to({"echo", "--help"}), Contains("the objects that pass a port"));
  CHECK_THAT(answer_to({"--version"}), Contains("orca orcactl 0."));
  CHECK_THAT(answer_to({"--man"}), Contains(".TH ORCACTL 1"));
  CHECK_THAT(answer_to({"--completion", "zsh"}), Contains("#compdef orcactl"));
  CHECK(answer_to({"ps"}) == "nothing");
  CHECK_FALSE(parse(program(), {"--completion", "fish"}).problems.empty());
}

TEST_CASE("zsh understands its completion script, where it is installed", "[orcactl][tool]") {
  if (std::system("command -v zsh >/dev/null") != 0) {
    std::cout << "SKIPPED: there is no zsh; apt install zsh\n";
    return;
  }
  CHECK(is_understood("zsh"));
}
