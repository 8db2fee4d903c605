// SPDX-License-Identifier: GPL-3.0-or-later
// The list of plugins in memory, which a signal handler reads to name the plugin that crashed.
#include "loaded_plugins.hpp"

#include <dlfcn.h>
#include <link.h>

#include <deque>

#include "places.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;

namespace {

// Stays in memory during the tests; any library with some segments will do.
const void* somewhere() { return dlsym(RTLD_DEFAULT, "memcpy"); }

std::string plugin_name_at(std::uintptr_t address) {
  const char* const path = plugin_at(reinterpret_cast<const void*>(address));
  return path == nullptr ? "none" : path;
}

// Returns the smallest start and the largest end of a loaded segment of the library that contains an address.
std::pair<std::uintptr_t, std::uintptr_t> extent_of(const void* address) {
  Dl_info info{};
  link_map* map = nullptr;
  REQUIRE(dladdr1(address, &info, reinterpret_cast<void**>(&map), RTLD_DL_LINKMAP) != 0);
  struct Search {
    std::uintptr_t base, start, end;
  } search{map->l_addr, UINTPTR_MAX, 0};
  dl_iterate_phdr(
      [](dl_phdr_info* library, std::size_t, void* data) {
        auto& found = *static_cast<Search*>(data);
        if (library->dlpi_addr != found.base) return 0;
        for (int i = 0; i < library->dlpi_phnum; ++i) {
          const auto& segment = library->dlpi_phdr[i];
          if (segment.p_type != PT_LOAD) continue;
          found.start = std::min<std::uintptr_t>(found.start, found.base + segment.p_vaddr);
          found.end = std::max<std::uintptr_t>(found.end, found.base + segment.p_vaddr + segment.p_memsz);
        }
        return 1;
      },
      &search);
  return {search.start, search.end};
}

}  // namespace

TEST_CASE("a plugin is known from the first byte of its first segment to the last byte of its last one",
          "[plugin][loaded]") {
  const auto [start, end] = extent_of(somewhere());
  const LoadedPlugin plugin("the plugin", somewhere());
  CHECK(plugin.start() == start);
  CHECK(plugin.end() == end);
  CHECK(plugin_name_at(start - 1) == "none");
  CHECK(plugin_name_at(start) == "the plugin");
  CHECK(plugin_name_at(end - 1) == "the plugin");
  CHECK(plugin_name_at(end) == "none");
}

TEST_CASE("the first and the last address of a plugin lead to its whole extent", "[plugin][loaded]") {
  const auto [start, end] = extent_of(somewhere());
  for (const std::uintptr_t address : {start, end - 1}) {
    const LoadedPlugin plugin("the plugin", reinterpret_cast<const void*>(address));
    CHECK(plugin.start() == start);
    CHECK(plugin.end() == end);
  }
}

TEST_CASE("an address in no library has no extent, and no plugin", "[plugin][loaded]") {
  const auto on_heap = std::make_unique<int>(1);
  const LoadedPlugin plugin("the plugin", on_heap.get());
  CHECK(plugin.start() == 0);
  CHECK(plugin.end() == 0);
  CHECK(plugin_at(on_heap.get()) == nullptr);
  CHECK(plugin_at(nullptr) == nullptr);
}

TEST_CASE("a path of up to 511 characters is kept whole, and a longer one cut", "[plugin][loaded]") {
  const std::string longest(511, 'p');
  const auto start = extent_of(somewhere()).first;
  {
    const LoadedPlugin plugin(longest, somewhere());
    CHECK(plugin_name_at(start) == longest);
  }
  const LoadedPlugin plugin(longest + "q", somewhere());
  CHECK(plugin_name_at(start) == longest);
}

TEST_CASE("the place of an unloaded plugin is free for another one, and the 257th stays unknown",
          "[plugin][loaded]") {
  const auto start = extent_of(somewhere()).first;
  for (int round = 0; round < 2; ++round) {
    std::deque<LoadedPlugin> plugins;
    for (int i = 0; i < 256; ++i) plugins.emplace_back(std::to_string(i), somewhere());
    const LoadedPlugin one_more("one more", somewhere());
    for (int i = 0; i < 256; ++i) {  // the oldest one is found first
      CHECK(plugin_name_at(start) == std::to_string(i));
      plugins.pop_front();
    }
    CHECK(plugin_name_at(start) == "none");
    CHECK(one_more.start() == start);
  }
}
