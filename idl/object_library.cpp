// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/idl/object_library.hpp"

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

#include "orca/base/mutex.hpp"
#include "own_types.hpp"

namespace orca {
namespace detail {
namespace {

// All types that are known, sorted by name. A table is never changed, and never freed: somebody may still look at it.
struct Table {
  std::vector<const ObjectType*> types;
  const Table* before;  // keeps it reachable for leak checkers
};

constinit Mutex g_adding;
constinit std::atomic<const Table*> g_table{nullptr};  // null: Orca's own alone

const ObjectType* find_in(std::span<const ObjectType* const> types, std::string_view name) {
  const auto found = std::ranges::lower_bound(types, name, {}, &ObjectType::name);
  return found != types.end() && (*found)->name == name ? *found : nullptr;
}

}  // namespace

std::string_view part_layout(std::string_view name) {
  for (const std::string_view layout : own_part_layouts())
    if (layout.substr(0, layout.find_first_of("{(")) == name) return layout;
  return {};
}

std::string clash_of(std::span<const ObjectType* const> types) {
  for (const ObjectType* const type : types)
    if (find_in(object_types(), type->name) != nullptr)
      return "another library has the object type " + std::string(type->name) + " already";
  return {};
}

bool add_object_types(std::span<const ObjectType* const> types) {
  const MutexLock lock(g_adding);
  if (const std::string clash = clash_of(types); !clash.empty()) throw std::logic_error(clash);
  const auto known = object_types();
  auto* const table = new Table{{known.begin(), known.end()}, g_table.load(std::memory_order_relaxed)};
  table->types.insert(table->types.end(), types.begin(), types.end());
  std::ranges::sort(table->types, {}, &ObjectType::name);
  g_table.store(table, std::memory_order_release);
  return true;
}

void lock_object_types() ORCA_THREAD_WORD(no_thread_safety_analysis) { g_adding.lock(); }
void unlock_object_types() ORCA_THREAD_WORD(no_thread_safety_analysis) { g_adding.unlock(); }

}  // namespace detail

std::span<const ObjectType* const> object_types() {
  const auto* const table = detail::g_table.load(std::memory_order_acquire);
  return table != nullptr ? std::span(table->types) : detail::own_object_types();
}

const ObjectType* find_object_type(std::string_view name) { return detail::find_in(object_types(), name); }

const ObjectType* find_subtype(const ObjectType& wanted, std::uint64_t layout_hash) {
  if (wanted.layout_hash == layout_hash) return &wanted;
  const auto types = object_types();
  const auto found = std::ranges::find(types, layout_hash, &ObjectType::layout_hash);
  return found != types.end() && is_a(**found, wanted) ? *found : nullptr;
}

}  // namespace orca
