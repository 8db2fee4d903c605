// SPDX-License-Identifier: GPL-3.0-or-later
// ElfFile reads a library as readelf of binutils does: the test plugins, those of the robot, libraries that were made for
// this test, and every library of this process, glibc included.
#include "inspection/elf_file.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "../places.hpp"
#include "elf_image.hpp"
#include "inspection/code_identity.hpp"
#include "readelf.hpp"
#include "slow_run.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;

namespace {

std::vector<std::string> libraries_of_this_process() {
  std::vector<std::string> paths;
  dl_iterate_phdr(
      [](dl_phdr_info* library, std::size_t, void* data) {
        if (std::filesystem::exists(library->dlpi_name))
          static_cast<std::vector<std::string>*>(data)->emplace_back(library->dlpi_name);
        return 0;
      },
      &paths);
  return paths;
}

std::vector<std::string> all_libraries() {
  std::vector<std::string> paths = libraries_of_this_process();
  for (const std::string& folder : {kShipped, kForTests, kForTests + "/bad", kSamples})
    for (const std::string& path : plugins_in(folder)) paths.push_back(path);
  return paths;
}

// All in the slow tests, else each fifth.
std::vector<std::string> tried_libraries() {
  std::vector<std::string> paths = all_libraries();
  if (is_slow_run()) return paths;
  std::vector<std::string> some;
  for (std::size_t i = 0; i < paths.size(); i += 5) some.push_back(std::move(paths[i]));
  return some;
}

const Readelf& readelf(const std::string& path) {
  static std::map<std::string, Readelf> known;
  return known.try_emplace(path, path).first->second;
}

// Returns the symbols in the words that Readelf uses.
std::multiset<std::string> symbols_of(const ElfFile& file) {
  std::multiset<std::string> lines;
  for (const ElfSymbol& symbol : file.symbols()) {
    const std::string binding = symbol.unique ? "UNIQUE" : symbol.weak ? "WEAK" : "GLOBAL";
    lines.insert(
        line_of({std::string(symbol.name), binding, symbol.defined, symbol.defined ? symbol.address : 0,
                 std::string(symbol.version), std::string(symbol.version_of)}));
  }
  return lines;
}

std::multiset<std::string> symbols_of(const Readelf& file) {
  std::multiset<std::string> lines;
  for (const Readelf::Symbol& symbol : file.symbols) lines.insert(line_of(symbol));
  return lines;
}

}  // namespace

TEST_CASE("a library's symbols are those that readelf lists, with binding, address and version",
          "[plugin][elf]") {
  CHECK(all_libraries().size() > 40);
  for (const std::string& path : tried_libraries()) {
    CAPTURE(path);
    CHECK(symbols_of(ElfImage(path).parsed()) == symbols_of(readelf(path)));
  }
}

TEST_CASE("a library's needs and search path are those that readelf lists", "[plugin][elf]") {
  for (const std::string& path : tried_libraries()) {
    CAPTURE(path);
    const ElfImage image(path);
    const ElfFile file = image.parsed();
    const Readelf& expected = readelf(path);
    CHECK(std::vector<std::string>(file.needed().begin(), file.needed().end()) == expected.needed);
    CHECK(file.search_path() == expected.search_path);
  }
}

TEST_CASE("a library's build id is the one that readelf shows, in its file as in memory", "[plugin][elf]") {
  std::size_t with_one = 0;
  for (const std::string& path : tried_libraries()) {
    CAPTURE(path);
    const ElfFile file = ElfImage(path).parsed();
    CHECK(file.build_id() == readelf(path).build_id);
    with_one += file.build_id().empty() ? 0 : 1;
  }
  CHECK(with_one > (is_slow_run() ? 40 : 8));
  for (const std::string& path : libraries_of_this_process()) {
    CAPTURE(path);
    void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_NOLOAD);
    REQUIRE(handle != nullptr);
    CHECK(identity_in_memory(handle) == identity_of(ElfImage(path).parsed()));
    dlclose(handle);
  }
}

TEST_CASE("a library without a build id is known by its machine code", "[plugin][elf]") {
  const CodeIdentity gnu = identity_of(ElfImage(sample("sample_gnu")).parsed());
  const CodeIdentity bare = identity_of(ElfImage(sample("sample_bare")).parsed());
  CHECK(gnu.build_id.empty());
  CHECK(bare.build_id.empty());
  CHECK(gnu != bare);
  const std::string path = sample("sample_gnu");
  void* const handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  REQUIRE(handle != nullptr);
  CHECK(identity_in_memory(handle) == gnu);
  dlclose(handle);
}

TEST_CASE("every shipped plugin has a build id, and no two have the same", "[plugin][elf]") {
  std::set<std::string> ids;
  for (const std::string& path : plugins_in(kShipped)) ids.insert(ElfImage(path).parsed().build_id());
  CHECK(ids.size() == plugins_in(kShipped).size());
  CHECK_FALSE(ids.contains(""));
}

TEST_CASE("a library's sections are those that readelf lists, except those without bytes", "[plugin][elf]") {
  for (const std::string& path : tried_libraries()) {
    CAPTURE(path);
    const ElfImage image(path);
    const ElfFile file = image.parsed();
    for (const auto& [name, section] : readelf(path).sections) {
      CAPTURE(name);
      const auto found = file.section(name);
      REQUIRE(found.has_value() == section.has_bytes);
      if (found) CHECK(std::ranges::equal(*found, image.bytes(section.offset, section.size)));
    }
    CHECK_FALSE(file.section("no such section"));
    CHECK_FALSE(file.section(""));  // the name of the entry that stands for "no section"
  }
}

TEST_CASE("an address belongs to the loaded segment around it, up to the last byte in the file",
          "[plugin][elf]") {
  for (const std::string& path : tried_libraries()) {
    CAPTURE(path);
    const ElfImage image(path);
    const ElfFile file = image.parsed();
    const Readelf& expected = readelf(path);
    REQUIRE_FALSE(expected.segments.empty());
    for (const auto& [offset, address, size] : expected.segments) {
      CAPTURE(address);
      if (size == 0) continue;
      const auto all = file.at_address(address, size);
      REQUIRE(all.has_value());
      CHECK(all->size() == size);
      CHECK(std::memcmp(all->data(), image.bytes(offset, size).data(), size) == 0);
      const auto last = file.at_address(address + size - 1, 1);
      REQUIRE(last.has_value());
      CHECK(last->front() == image.bytes(offset, size).back());
      CHECK_FALSE(file.at_address(address, size + 1));
      CHECK_FALSE(file.at_address(address + size - 1, 2));
    }
    CHECK_FALSE(file.at_address(UINT64_MAX, 1));
  }
}

TEST_CASE("the samples hold what they were made for", "[plugin][elf]") {
  const auto bindings = [](const std::string& name) {
    std::set<std::string> found;
    for (const Readelf::Symbol& symbol : readelf(sample(name)).symbols)
      if (symbol.name.starts_with("sample_"))
        found.insert(symbol.binding + (symbol.defined ? "" : " needed"));
    return found;
  };
  const std::set<std::string> all{"GLOBAL", "UNIQUE", "WEAK", "WEAK needed"};
  CHECK(bindings("sample_gnu") == all);
  CHECK(bindings("sample_sysv") == all);
  CHECK(readelf(sample("sample_gnu")).search_path == "$ORIGIN/run:/opt/run");
  CHECK(readelf(sample("sample_sysv")).search_path == "$ORIGIN/old:/opt/old");
  CHECK(readelf(sample("sample_gnu")).sections.count(".hash") == 0);
  CHECK(readelf(sample("sample_sysv")).sections.count(".gnu.hash") == 0);
  CHECK(readelf(sample("sample_bare")).sections.count(".gnu.version") == 0);
  CHECK(readelf(sample("sample_bare")).needed.empty());
}
