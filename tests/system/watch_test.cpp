// SPDX-License-Identifier: GPL-3.0-or-later
// deployer --watch: whoever builds a plugin anew sees the running system behave differently.
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
namespace fs = std::filesystem;

namespace {

fs::path version_file(const std::string& name) {
  return fs::path(ORCA_BINARY_DIR "/tests/next_plugins") / (name + ".so");
}

// The list of types lies beside a plugin.
void copy_with_types(const fs::path& from, const fs::path& to) {
  fs::copy_file(from, to);
  fs::copy_file(fs::path(from).replace_extension(".types"), fs::path(to).replace_extension(".types"));
}

// A system whose teller says its version a hundred times a second, from a plugin in a folder of its own.
class Watched {
 public:
  Watched() {
    fs::create_directory(plugin().parent_path());
    copy_with_types(version_file("test_teller_again"), plugin());
    copy_with_types(ORCA_BINARY_DIR "/tests/host_plugins/test_talker.so",
                    plugin().parent_path() / "talker.so");
    const std::string file = folder_.write(
        "watched.xml", "<graph name=\"watched\" version=\"1\" plugins=\"" + plugin().parent_path().string() +
                           "\"><component name=\"teller\" type=\"test.Teller\"/>"
                           "<component name=\"talker\" type=\"test.Talker\"/>"
                           "<connect from=\"talker.out\" to=\"teller.in\" queue=\"1000\"/>"
                           "<connect from=\"talker.poke\" to=\"teller.poke\" queue=\"1000\"/>"
                           "<connect from=\"teller.out\" to=\"talker.back\" queue=\"1000\"/></graph>");
    program_ = std::make_unique<Subprocess>(deployer({file, "--watch", "--log", "debug"}));
    REQUIRE(hears("heard 1:10"));
  }

  // Puts another version in the plugin's place, as a linker does.
  void build(const std::string& version) {
    const fs::path fresh = plugin().string() + ".new";
    fs::copy_file(version_file(version), fresh, fs::copy_options::overwrite_existing);
    fs::rename(fresh, plugin());
  }

  [[nodiscard]] fs::path plugin() const { return fs::path(folder_.file("plugins")) / "teller.so"; }
  [[nodiscard]] std::size_t mark() const { return program_->err().size(); }
  // Returns whether the log comes to hold a text behind a mark.
  bool hears_after(const std::string& text, std::size_t mark) {
    return comes_true([&] { return program_->err().find(text, mark) != std::string::npos; }, Seconds(20));
  }
  bool hears(const std::string& text) { return program_->wait_for_output(text, Seconds(20) * kSlowdown); }

  std::string end() { return stop_without_gaps(*program_); }

 private:
  TempFolder folder_;
  std::unique_ptr<Subprocess> program_;
};

// Returns the build id of the code that a component runs, as the system tells.
std::string build_of(const std::string& component) {
  const std::string shown = run_orcactl({"ps", "--json"}).out;
  const std::size_t begin = shown.find("\"build_id\": \"", shown.find("\"name\": \"" + component + "\""));
  return begin == std::string::npos ? "" : shown.substr(begin + 13, 40);
}

}  // namespace

TEST_CASE("a plugin that is built anew takes the old one's place, with its state", "[system][watch]") {
  Watched system;
  const auto began = Clock::now();
  system.build("test_teller_2");
  REQUIRE(system.hears("heard 2:"));
  const std::chrono::duration<double> took = Clock::now() - began;
  std::cout << "from the new file to the new behaviour: " << took.count() << " s\n";
  CHECK(took.count() < 10.0 * kSlowdown);
  REQUIRE(system.hears("runs the code that was built anew"));
  const std::size_t mark = system.mark();
  system.build("test_teller_again");
  REQUIRE(system.hears_after("heard 1:", mark));
  system.end();
}

TEST_CASE("a plugin that is built while its last version is on probation is taken after that",
          "[system][watch]") {
  Watched system;
  system.build("test_teller_2");
  REQUIRE(system.hears("heard 2:"));
  system.build("test_teller_again");
  REQUIRE(system.hears("runs the code that was built anew"));
  const std::size_t mark = system.mark();
  REQUIRE(system.hears_after("heard 1:", mark));
  REQUIRE(system.hears_after("runs the code that was built anew", mark));
  CHECK_THAT(system.end(), !Contains("does not run"));
}

TEST_CASE("a plugin that was built wrongly is not taken, the log says why, and the next one is",
          "[system][watch]") {
  if (!kTriesInShadow) return;
  Watched system;
  system.build("test_teller_lap_crashes");
  REQUIRE(system.hears("does not run, and the old one goes on"));
  {
    std::ofstream half(system.plugin(), std::ios::binary | std::ios::trunc);
    half << "half a plugin";
  }
  REQUIRE(system.hears("teller.so"));
  system.build("test_teller_2");
  REQUIRE(system.hears("heard 2:"));
  CHECK_THAT(system.end(), Contains("its laps, in the shadow of the present one,"));
}

TEST_CASE("a plugin that ends its process after the exchange is not said to have left the old one at work",
          "[system][watch]") {
  Watched system;
  system.build("test_teller_late_lap_crashes");
  REQUIRE(system.hears("the graph names the file that was built anew, so its process begins with it again"));
  system.build("test_teller_again");
  const std::size_t mark = system.mark();
  REQUIRE(system.hears_after("heard 1:", mark));
  CHECK_THAT(system.end(), !Contains("the old one goes on"));
}

TEST_CASE(
    "ps tells which build of its code a component runs, after an exchange and in a process that is started "
    "again",
    "[system][watch]") {
  Watched system;
  const std::string first = build_of("teller");
  CHECK(first.find_first_not_of("0123456789abcdef") == std::string::npos);
  system.build("test_teller_2");
  REQUIRE(system.hears("runs the code that was built anew"));
  const std::string second = build_of("teller");
  CHECK(second != first);
  REQUIRE(run_orcactl({"restart", "teller"}).exit_code() == 0);
  CHECK(build_of("teller") == second);
  system.end();
}

TEST_CASE("without host processes there is nothing to exchange, and --watch is refused", "[system][watch]") {
  const Run run = run_deployer({source_file("graphs/scout_goto.xml"), "--watch", "--clock", "virtual"});
  CHECK(run.exit_code() == 2);
  CHECK_THAT(run.err, Contains("leave out --in-process and --clock virtual"));
}
