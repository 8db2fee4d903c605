// SPDX-License-Identifier: GPL-3.0-or-later
// What a plugin's own sections say, and how its faults are listed.
#include "inspection/plugin_file.hpp"

#include "elf_image.hpp"
#include "inspection/elf_file.hpp"
#include "orca/base/text.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;
using namespace std::string_literals;

namespace {

// Returns the fault that begins so.
std::string file_fault(const PluginFile& file, const std::string& start) {
  for (const std::string& fault : file.faults(known_type))
    if (fault.starts_with(start)) return fault;
  return "none";
}

std::string faults_with_notes(const std::string& notes) {
  ElfImage image(test_plugin("test_allowed"));
  const ElfFile file = image.parsed();
  const auto section = file.section("orca_clock_notes");
  REQUIRE(section.has_value());
  const std::string before(reinterpret_cast<const char*>(section->data()), section->size());
  REQUIRE(notes.size() <= before.size());
  image.replace(before, notes + std::string(before.size() - notes.size(), '\0'));
  return joined(image.plugin().virtual_time_faults(), "\n");
}

}  // namespace

TEST_CASE("notes may follow each other directly, or with zeros between them", "[plugin][file]") {
  CHECK_THAT(faults_with_notes(""), Contains("uses poll,") && Contains("uses rand,"));
  CHECK_THAT(faults_with_notes("allows rand: x\0"s), Contains("uses poll,") && !Contains("uses rand,"));
  CHECK(faults_with_notes("allows rand: x\0allows poll: y\0"s).empty());
  CHECK(faults_with_notes("\0allows rand: x\0\0allows poll: y\0"s).empty());
  CHECK_THAT(faults_with_notes("allows random: x\0allows ran: y\0"s), Contains("uses rand,"));
}

TEST_CASE("a plugin with several reasons for the steady clock gives them all, and nothing else",
          "[plugin][file]") {
  CHECK(faults_with_notes("steady only: a\0steady only: b\0"s) ==
        "runs with the steady clock only (--clock steady): a\n"
        "runs with the steady clock only (--clock steady): b");
}

TEST_CASE("a plugin that uses what starts threads may start them, another one may not", "[plugin][file]") {
  CHECK(ElfImage(test_plugin("test_thread_left")).plugin().may_start_threads());
  CHECK_FALSE(ElfImage(test_plugin("test_statics")).plugin().may_start_threads());
}

TEST_CASE("of many exported symbols four are named, each with at most 80 characters", "[plugin][file]") {
  const auto file = PluginFile::read(test_plugin("bad/bad_pinned"));
  REQUIRE(file.has_value());
  std::vector<std::string> names;
  for (const ElfSymbol& symbol : file->elf().symbols())
    if (symbol.defined && !symbol.unique && symbol.name != "orca_plugin_manifest")
      names.push_back(demangled(symbol.name));
  REQUIRE(names.size() > 5);
  std::string expected;
  for (std::size_t i = 0; i < 4; ++i)
    expected += (i == 0 ? "" : ", ") + (names[i].size() > 80 ? names[i].substr(0, 80) + "..." : names[i]);
  const std::string start = "exports more than its manifest, so others could bind to it: ";
  CHECK_THAT(file_fault(*file, start), Catch::StartsWith(start + expected + " and"));
}

TEST_CASE("the layout of a type is found behind that of another one, without a gap between them",
          "[plugin][file]") {
  ElfImage image(test_plugin("bad/bad_layout"));
  const ElfFile file = image.parsed();
  const auto section = file.section("orca_layouts");
  REQUIRE(section.has_value());
  const std::string before(reinterpret_cast<const char*>(section->data()), section->size());
  const auto start = before.find("GoalPoint{");
  REQUIRE(start != std::string::npos);
  std::string after = "A{}\0"s + before.substr(start, before.find('\0', start) - start);
  after.resize(before.size());
  image.replace(before, after);
  CHECK_THAT(file_fault(image.plugin(), "was built for another layout of the object type GoalPoint"),
             Contains("the field \"creation_time.ns\""));
}

TEST_CASE("an empty file and a file that does not exist are no plugins", "[plugin][file]") {
  const std::string path = kForTests + "/empty.so";
  std::ofstream{path};
  const auto empty = PluginFile::read(path);
  std::filesystem::remove(path);
  REQUIRE_FALSE(empty);
  CHECK(empty.error().code == Code::invalid_argument);
  CHECK(empty.error().where == path);
  const auto gone = PluginFile::read(path);
  REQUIRE_FALSE(gone);
  CHECK(gone.error().code == Code::not_found);
  CHECK(gone.error().where == path);
}
