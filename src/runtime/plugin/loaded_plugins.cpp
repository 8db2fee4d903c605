// SPDX-License-Identifier: LGPL-3.0-or-later
#include "loaded_plugins.hpp"

#include <link.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>

namespace orca::plugin {
namespace {

// A place in fixed memory, because a signal handler reads it. `end` is written last and read first; 0: the
// place is free.
struct Place {
  std::atomic<std::uintptr_t> end{0};
  std::uintptr_t start = 0;
  std::array<char, 512> path{};
};

std::array<Place, 256> g_places;

struct Range {
  std::uintptr_t wanted;
  std::uintptr_t start = 0;
  std::uintptr_t end = 0;
};

// Stores the extent of the library that contains `wanted`.
int take_range(dl_phdr_info* library, std::size_t /*size*/, void* data) {
  Range& range = *static_cast<Range*>(data);
  std::uintptr_t start = UINTPTR_MAX;
  std::uintptr_t end = 0;
  for (int i = 0; i < library->dlpi_phnum; ++i) {
    const auto& segment = library->dlpi_phdr[i];
    if (segment.p_type != PT_LOAD) continue;
    start = std::min<std::uintptr_t>(start, library->dlpi_addr + segment.p_vaddr);
    end = std::max<std::uintptr_t>(end, library->dlpi_addr + segment.p_vaddr + segment.p_memsz);
  }
  if (range.wanted < start || range.wanted >= end) return 0;
  range.start = start;
  range.end = end;
  return 1;
}

}  // namespace

const char* plugin_at(const void* address) noexcept {
  const auto wanted = reinterpret_cast<std::uintptr_t>(address);
  for (const Place& place : g_places) {
    const std::uintptr_t end = place.end.load(std::memory_order_acquire);
    if (end != 0 && wanted >= place.start && wanted < end) return place.path.data();
  }
  return nullptr;
}

LoadedPlugin::LoadedPlugin(const std::string& path, const void* address) {
  Range range{reinterpret_cast<std::uintptr_t>(address)};
  if (dl_iterate_phdr(take_range, &range) == 0) return;
  start_ = range.start;
  end_ = range.end;
  for (std::size_t i = 0; i < g_places.size() && place_ < 0; ++i) {
    Place& place = g_places[i];
    if (place.end.load(std::memory_order_relaxed) != 0) continue;
    place.start = range.start;
    const std::size_t kept = std::min(path.size(), place.path.size() - 1);
    *std::copy_n(path.begin(), kept, place.path.begin()) = '\0';
    place.end.store(range.end, std::memory_order_release);
    place_ = static_cast<int>(i);
  }
}

LoadedPlugin::~LoadedPlugin() {
  if (place_ >= 0) g_places[static_cast<std::size_t>(place_)].end.store(0, std::memory_order_release);
}

}  // namespace orca::plugin
