// SPDX-License-Identifier: GPL-3.0-or-later
// What a user reads if the loader rejects a plugin: everything that is missing at once, by name.
#include "inspection/load_error.hpp"

#include "elf_image.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;

namespace {

constexpr const char* kWords = "the loader's own words";

std::string explained(const ElfImage& image, const std::string& path) {
  return explain_load_error(image.parsed(), path, kWords);
}

// Replaces a name of a library's table of names.
void rename(ElfImage& image, const std::string& from, const std::string& to) {
  const std::uint64_t start = image.dynamic(DT_STRTAB).d_un.d_val;
  const std::uint64_t end = start + image.dynamic(DT_STRSZ).d_un.d_val - from.size();
  for (std::uint64_t at = start; at < end; ++at)
    if (std::memcmp(&image.at<char>(at), from.c_str(), from.size() + 1) == 0)
      return (void)std::memcpy(&image.at<char>(at), to.c_str(), to.size() + 1);
  FAIL("no such name: " << from);
}

const std::string kUser = sample("sample_provider_user");

// A library that uses another one, in provider/ next to it.
ElfImage user(const std::string& search_path = "/none:${ORIGIN}/provider") {
  ElfImage image(kUser);
  rename(image, "/room/for/the/search/path/that/a/test/asks/for", search_path);
  return image;
}

}  // namespace

TEST_CASE("a library that has everything it needs is explained by the loader's words",
          "[plugin][load_error]") {
  for (const std::string& path : {sample("sample_gnu"), sample("sample_sysv"), sample("sample_bare")}) {
    CAPTURE(path);
    CHECK(explained(ElfImage(path), path) == kWords);
  }
}

TEST_CASE("the loader's messages about memory are known, and no others", "[plugin][load_error]") {
  for (const char* const words : {"libx.so: failed to map segment from shared object",
                                  "x.so: cannot allocate memory in static TLS block",
                                  "x.so: cannot create shared object descriptor: Cannot allocate memory"})
    CHECK(says_no_memory(words));
  for (const char* const words : {"libx.so: cannot open shared object file: No such file or directory",
                                  "x.so: undefined symbol: sample_nowhere", ""})
    CHECK_FALSE(says_no_memory(words));
}

TEST_CASE("symbols that no library provides are listed, but not weak ones and not its own",
          "[plugin][load_error]") {
  const std::string path = sample("sample_needy");
  CHECK(
      explained(ElfImage(path), path) ==
      "it uses orca::test::nowhere(int), sample_nowhere, which no library provides; link what it needs with "
      "orca_add_component(... LINK ...), or build it again with this Orca");
}

TEST_CASE("a symbol with a version must be there in that version", "[plugin][load_error]") {
  ElfImage image = user();
  CHECK(explained(image, kUser) == kWords);
  rename(image, "SAMPLE_1", "SAMPLE_9");
  CHECK_THAT(
      explained(image, kUser),
      Contains(
          "it uses sample_provided (expected in libsample_provider.so, version SAMPLE_9), which no library"));
}

TEST_CASE("a symbol whose value is null is provided", "[plugin][load_error]") {
  ElfImage image = user();
  rename(image, "sample_provided", "sample_null");
  CHECK(explained(image, kUser) == kWords);
}

TEST_CASE("libraries that are not found are listed, before any symbol", "[plugin][load_error]") {
  ElfImage image = user();
  rename(image, "libsample_provider.so", "libsample_gone.so");
  CHECK(explained(image, kUser) ==
        "it needs libraries that are not found: libsample_gone.so; install them, or build the plugin again "
        "where "
        "they are");
}

TEST_CASE("a library is searched in the folders of the search path, $ORIGIN being its user's",
          "[plugin][load_error]") {
  for (const std::string path :
       {"$ORIGIN/provider", "/none:$ORIGIN/provider", "$ORIGIN/provider:/none",
        "::$ORIGIN/provider:", "${ORIGIN}/provider", "${ORIGIN}/../samples/provider"}) {
    CAPTURE(path);
    CHECK(explained(user(path), kUser) == kWords);
  }
  for (const std::string nowhere : {"$ORIGIN", "$ORIGIN/none", "/none:/no", "$HOME/provider", ""}) {
    CAPTURE(nowhere);
    CHECK_THAT(explained(user(nowhere), kUser), Contains("not found: libsample_provider.so"));
  }
  CHECK_THAT(explained(user(), "/elsewhere/user.so"), Contains("not found: libsample_provider.so"));
}

TEST_CASE("the first folder of the search path that has the library counts", "[plugin][load_error]") {
  // A library of the same name without the symbol.
  const std::string other = kSamples + "/other";
  std::filesystem::create_directories(other);
  std::filesystem::copy_file(sample("sample_bare"), other + "/libsample_provider.so",
                             std::filesystem::copy_options::overwrite_existing);
  CHECK(explained(user("$ORIGIN/provider:$ORIGIN/other"), kUser) == kWords);
  CHECK_THAT(explained(user("$ORIGIN/other:$ORIGIN/provider"), kUser), Contains("it uses sample_provided"));
  std::filesystem::remove_all(other);
}
