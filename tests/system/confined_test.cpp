// SPDX-License-Identifier: GPL-3.0-or-later
// What a host process whose code is hostile can do to the rest of the system, to files and to the kernel.
#include <unistd.h>

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

namespace fs = std::filesystem;

// A folder that is no temporary one, where a host process may write.
class Precious {
 public:
  Precious() : path_(std::string(ORCA_BINARY_DIR) + "/tests/precious_" + std::to_string(getpid())) {
    fs::create_directories(path_ + "/empty");
    std::ofstream(path_ + "/precious") << "keep me";
  }
  ~Precious() { fs::remove_all(path_); }
  Precious(const Precious&) = delete;
  Precious& operator=(const Precious&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] bool is_untouched() const {
    std::ifstream file(path_ + "/precious");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    using Entries = fs::directory_iterator;
    return text == "keep me" && std::distance(Entries(path_), Entries()) == 2;
  }

 private:
  const std::string path_;
};

Words attack(const Precious& precious) {
  return deployer(Words{system_graph("attacker.xml"), "--set", "precious=" + precious.path()} +
                  with_test_plugins());
}

// Returns the lines of the attempts that were not refused. Where the kernel lacks a part, only those that the other part forbids count.
Words successes(const std::string& log) {
  const bool has_all = log.find("this kernel does not keep host processes from") == std::string::npos;
  if (!has_all) WARN("this kernel lacks a part; only calls of the kernel are looked at");
  Words all;
  for (const std::string& line : split_lines(log))
    if (line.find("NOT refused") != std::string::npos &&
        (has_all || line.find("attack call") != std::string::npos))
      all.push_back(line);
  return all;
}

}  // namespace

TEST_CASE(
    "of 200 attacks of a hostile component none reaches another process, a file of others or the kernel",
    "[system][confined]") {
  const Precious precious;
  Subprocess system(attack(precious));
  REQUIRE(system.wait_for_output("attacks are over", Seconds(60)));
  const std::string log = system.err();
  CHECK(successes(log).empty());
  std::size_t attacks = 0;
  for (const std::string& line : split_lines(log))
    attacks += line.find(": attack ") != std::string::npos ? 1 : 0;
  CHECK(attacks >= 200);
  CHECK(precious.is_untouched());
  // All that it has attacked is there, and obeys.
  const Run processes = run_orcactl({"ps"});
  CHECK_THAT(processes.out, Contains("source") && Contains("sink") && Contains("attacker"));
  CHECK(log.find("is started again") == std::string::npos);
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  const Run run = finish(system, Seconds(20));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
}

TEST_CASE("a folder that --writable names is written to, and by it nothing else is allowed",
          "[system][confined]") {
  const Precious precious;
  Subprocess system(attack(precious) + Words{"--writable", precious.path()});
  REQUIRE(system.wait_for_output("attacks are over", Seconds(60)));
  const std::string log = system.err();
  CHECK_THAT(log, Contains("attack file write: NOT refused, done") &&
                      Contains("attack file remove: NOT refused, done"));
  for (const std::string& line : successes(log))
    CHECK_THAT(line, Contains("attack file") || Contains(precious.path()));
  CHECK_FALSE(precious.is_untouched());
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(system, Seconds(20)).exit_code() == 0);
}

TEST_CASE("--writable is for host processes only", "[system][confined]") {
  const Run run =
      run_deployer(Words{source_file("graphs/scout_goto.xml"), "--writable", "/var"} + virtual_clock());
  CHECK(run.exit_code() == 2);
  CHECK(run.says("--writable: only host processes"));
}

TEST_CASE("what a host process writes for the run reaches the deployer's own output", "[system][confined]") {
  const Run run = run_deployer(Words{system_graph("hooligan.xml"), "--set", "where=work", "--set",
                                     "deed=none", "--trace", "/dev/stdout", "--until", "1 s"} +
                               with_test_plugins());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.lines().size() > 5);
}

TEST_CASE("lines of emulated devices and meeting places need no temporary folder", "[system][confined]") {
  const Precious precious;
  fs::permissions(precious.path(), fs::perms::owner_all);
  Subprocess system(
      Words{"/usr/bin/env", "XDG_RUNTIME_DIR=" + precious.path()} +
      deployer({source_file("graphs/nomad_scout.xml"), "--profile", "emulate", "--until", "2 s"}));
  const Run run = finish(system, Seconds(30));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(fs::exists(precious.path() + "/orca/emulated"));
}

TEST_CASE("what a component keeps from one run to the next can be written", "[system][confined]") {
  const Precious precious;
  fs::permissions(precious.path(), fs::perms::owner_all);
  Subprocess system(Words{"/usr/bin/env", "XDG_STATE_HOME=" + precious.path()} +
                    deployer({source_file("graphs/pioneer_localize.xml"), "--set",
                              "localizer.keeps_pose=here", "--until", "6 s"}));
  const Run run = finish(system, Seconds(40));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(fs::exists(precious.path() + "/orca/kept/here.pose"));
}
