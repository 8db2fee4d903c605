// SPDX-License-Identifier: GPL-3.0-or-later
// What the deployer is to write is written, or the exit status is 1. It overwrites no file that it reads.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

const std::string kGraph = "graphs/scout_goto.xml";
const Words kShort{"--set", "goals=near: 3.6 6", "--clock", "virtual"};

// Runs the deployer from a shell, which redirects its output or limits it.
Run run_in_shell(const std::string& command, const Words& words) {
  Subprocess program(Words{"/bin/sh", "-c", command, "sh"} + deployer(words));
  return finish(program, Seconds(30));
}

Run run_with_full_stdout(const Words& words) { return run_in_shell("exec \"$@\" >/dev/full", words); }

std::string content(const std::string& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// A copy of the shipped graph and of all that it reads, which a test may try to destroy.
class OwnCopy {
 public:
  OwnCopy() {
    for (const char* part : {"graphs", "sim/worlds", "sim/robots"}) {
      fs::create_directories(folder_.file(part));
      fs::copy(source_file(part), folder_.file(part), fs::copy_options::recursive);
    }
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  const TempFolder folder_;
};

}  // namespace

TEST_CASE("standard output that cannot be written is an error, whatever is written", "[system][output]") {
  const std::string graph = source_file(kGraph);
  for (const Words& words :
       {Words{graph} + kShort, Words{graph, "--print"}, Words{graph, "--print", "--json"},
        Words{graph, "--list-ports"}, Words{graph, "--dot"}, Words{graph, "--mermaid"},
        Words{graph, "--check", "--json"}, Words{"--diff", graph, graph, "--json"}, Words{"--schema"},
        Words{"--rnc"}, Words{"--help"}, Words{"--version"},
        Words{"--describe", ORCA_BINARY_DIR "/plugins/goto.so"}}) {
    CAPTURE(words);
    const Run run = run_with_full_stdout(words);
    INFO(run.err);
    CHECK(run.exit_code() == 1);
    CHECK(run.says("error: cannot write to standard output: No space left on device"));
  }
}

TEST_CASE("a wrong graph stays exit status 2 without a standard output", "[system][output]") {
  CHECK(run_with_full_stdout({"/no/such.xml", "--check", "--json"}).exit_code() == 2);
}

TEST_CASE("a standard output that is closed is an error, and no file takes its place", "[system][output]") {
  const TempFolder folder;
  const Run run =
      run_in_shell("exec \"$@\" >&-", Words{source_file(kGraph), "--trace", folder.file("trace")} + kShort);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("error: cannot write to standard output: Bad file descriptor"));
  CHECK_THAT(content(folder.file("trace")), !Contains("arrived near"));
}

TEST_CASE("a reader that goes away is an error, not a signal that ends the program", "[system][output]") {
  const Run run = run_in_shell("{ sleep 1; \"$@\"; echo $? >&2; } | true", {"--schema"});
  CHECK(run.says("error: cannot write to standard output: Broken pipe\n1"));
}

TEST_CASE("a trace or picture that cannot be written makes the exit status 1, and the reason is on screen",
          "[system][output]") {
  const TempFolder folder;
  for (const char* name : {"full.trace", "full.svg", "full.png"})
    fs::create_symlink("/dev/full", folder.file(name));
  for (const auto& [option, name] :
       {std::pair{"--trace", "full.trace"}, {"--picture", "full.svg"}, {"--picture", "full.png"}}) {
    CAPTURE(name);
    const Run run = run_deployer(Words{source_file(kGraph), option, folder.file(name)} + kShort);
    CHECK(run.exit_code() == 1);
    CHECK(run.says("No space left on device"));
    CHECK(run.arrivals().size() == 1);  // the robot is not stopped by it
    CHECK(run.trace_hash());
  }
}

TEST_CASE("a limit on the size of files is an error like a full device", "[system][output]") {
  const TempFolder folder;
  const Run run = run_in_shell("ulimit -f 8; exec \"$@\"",
                               Words{source_file(kGraph), "--trace", folder.file("trace")} + kShort);
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("cannot write the trace: File too large"));
}

TEST_CASE("a trace or picture in no folder is known before anything moves", "[system][output]") {
  for (const Words& words : {Words{"--trace", "/no/such/trace"}, Words{"--picture", "/no/such/run.svg"}}) {
    const Run run = run_deployer(Words{source_file(kGraph)} + words + kShort);
    CHECK(run.exit_code() == 3);
    CHECK(run.out.empty());
    CHECK(run.says("No such file or directory"));
  }
}

TEST_CASE("a trace or picture into a pipe that nobody reads is an error, not a wait", "[system][output]") {
  const TempFolder folder;
  REQUIRE(mkfifo(folder.file("pipe.svg").c_str(), 0600) == 0);
  for (const char* option : {"--trace", "--picture"}) {
    const Run run = run_deployer(Words{source_file(kGraph), option, folder.file("pipe.svg")} + kShort);
    CHECK(run.ended);
    CHECK(run.exit_code() == 3);
    CHECK(run.says("nobody reads this pipe"));
  }
}

TEST_CASE("no output overwrites the graph or a file that it reads", "[system][output]") {
  const OwnCopy copy;
  const std::string graph = copy.file("graphs/run.svg");  // so that a picture may have this name
  fs::copy_file(copy.file(kGraph), graph);
  for (const auto& [option, name] : {std::pair{"--trace", "graphs/run.svg"},
                                     {"--picture", "graphs/run.svg"},
                                     {"--trace", "sim/worlds/office.xml"},
                                     {"--trace", "sim/robots/nomad_scout.urdf"}}) {
    CAPTURE(option, name);
    const std::string before = content(copy.file(name));
    const Run run = run_deployer(Words{graph, option, copy.file(name)} + kShort);
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.out.empty());
    CHECK(run.says("would overwrite a file that has been read"));
    CHECK(content(copy.file(name)) == before);
  }
}

TEST_CASE("no output overwrites a file that a component reads only when it starts", "[system][output]") {
  const OwnCopy copy;
  const std::string goals = copy.file("goals.txt");
  std::ofstream(goals) << "near: 3.6 6\n";
  std::string graph = content(copy.file(kGraph));
  const std::string param = R"(<param name="goals" value="${goals}"/>)";
  graph.replace(graph.find(param), param.size(), R"(<param name="goals_file" value="../goals.txt"/>)");
  std::ofstream(copy.file("graphs/from_file.xml")) << graph;
  const Words words{copy.file("graphs/from_file.xml"), "--clock", "virtual"};
  CHECK(run_deployer(words).arrivals().size() == 1);
  const Run run = run_deployer(words + Words{"--trace", goals});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("would overwrite a file that the graph names"));
  CHECK(content(goals) == "near: 3.6 6\n");
}

TEST_CASE("trace and picture are two files", "[system][output]") {
  const TempFolder folder;
  const std::string file = folder.file("both.svg");
  const Run run = run_deployer(Words{source_file(kGraph), "--trace", file, "--picture", file} + kShort);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("the picture would overwrite the trace"));
}
