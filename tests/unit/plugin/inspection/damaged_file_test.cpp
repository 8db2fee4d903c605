// SPDX-License-Identifier: GPL-3.0-or-later
// A plugin's file is not trusted: cut short or damaged anywhere, it gives an error or a description, never a
// crash.
#include <cstring>

#include "../places.hpp"
#include "elf_image.hpp"
#include "inspection/plugin_file.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;

namespace {

using Bytes = std::vector<std::byte>;

Bytes small_plugin() {
  const std::string text = read_text(test_plugin("test_small"));
  Bytes bytes(text.size());
  std::memcpy(bytes.data(), text.data(), text.size());
  return bytes;
}

// Reads everything in the file, and returns whether it is a good plugin.
bool judge(Bytes bytes) {
  const Result<PluginFile> file = PluginFile::parse(std::move(bytes));
  if (!file) {
    CHECK(file.error().code == Code::invalid_argument);
    return false;
  }
  (void)file->virtual_time_faults();
  (void)file->may_start_threads();
  return file->faults(known_type).empty();
}

}  // namespace

TEST_CASE("the plugin to be damaged is good", "[plugin][damage]") { CHECK(judge(small_plugin())); }

TEST_CASE("a plugin cut short before its last segment ends is refused, at every length", "[plugin][damage]") {
  const Bytes whole = small_plugin();
  // After the last segment there are only symbol names for people.
  std::size_t refused = 0;
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const bool good = judge(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    if (!good && refused == size) ++refused;
  }
  CHECK(refused > whole.size() / 2);
}

TEST_CASE("a plugin that is cut short says so", "[plugin][damage]") {
  Bytes bytes = small_plugin();
  bytes.resize(bytes.size() / 2);
  const auto file = PluginFile::parse(std::move(bytes));
  REQUIRE_FALSE(file);
  CHECK_THAT(file.error().text(), Contains("cut short") && Contains("bytes"));
}

TEST_CASE(
    "a damaged number that would make the dynamic linker map, protect or write the memory of others is "
    "refused",
    "[plugin][damage]") {
  const ElfImage good(test_plugin("test_small"));
  (void)good.parsed();
  const auto damaged = [&good](const auto& damage) {
    ElfImage image = good;
    damage(image);
    return image.refusal();
  };
  const std::uint64_t page = 4096;
  for (const std::uint64_t more : {64 * page, std::uint64_t{1} << 30, std::uint64_t{1} << 62})
    CHECK_THAT(damaged([&](ElfImage& image) { image.segment(PT_GNU_RELRO).p_memsz += more; }),
               Contains("is damaged: what becomes read-only once it is loaded does not lie in"));
  CHECK_THAT(damaged([](ElfImage& image) { image.segment(PT_GNU_RELRO).p_vaddr = 0; }),
             Contains("read-only"));
  CHECK_THAT(damaged([](ElfImage& image) { image.segment(PT_DYNAMIC).p_vaddr += 16; }),
             Contains("its dynamic section"));
  CHECK_THAT(damaged([](ElfImage& image) { image.segment(PT_GNU_EH_FRAME).p_vaddr += 64; }),
             Contains("its table of exceptions"));
  CHECK_THAT(damaged([&](ElfImage& image) { image.segment(PT_LOAD).p_memsz += 64 * page; }),
             Contains("lies before the end of another one"));
  CHECK_THAT(damaged([&](ElfImage& image) { image.last_loaded().p_memsz = std::uint64_t{1} << 40; }),
             Contains("larger than any library"));
  CHECK_THAT(damaged([&](ElfImage& image) { image.last_loaded().p_vaddr += 8; }),
             Contains("elsewhere in a page"));
  CHECK_THAT(damaged([&](ElfImage& image) {
               image.at<Elf64_Rela>(image.dynamic(DT_RELA).d_un.d_val).r_offset += std::uint64_t{1} << 24;
             }),
             Contains("a relocation at address"));
}

TEST_CASE("any bit flipped gives an error or a description, never a crash", "[plugin][damage]") {
  const Bytes whole = small_plugin();
  std::size_t refused = 0;
  const std::size_t step =
      orca::test::is_slow_run() ? 1 : 17;  // which has no factor in common with the 8 bits of a byte
  for (std::size_t bit = 0; bit < 8 * whole.size(); bit += step) {
    Bytes damaged = whole;
    damaged[bit / 8] ^= std::byte{1} << (bit % 8);
    refused += judge(std::move(damaged)) ? 0 : 1;
  }
  CHECK(refused > 100 / step);                   // the tables
  CHECK(refused < 8 * whole.size() / step / 2);  // not the code
}
