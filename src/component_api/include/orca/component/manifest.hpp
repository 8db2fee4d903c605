// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>

#include "orca/base/contract.hpp"

namespace orca {

class PluginHost;

/// The version of the plugin boundary. It counts up whenever the manifest, or the meaning of anything that
/// crosses the boundary, changes. The build finds changes of layout: see Manifest::layout_hash.
inline constexpr std::uint32_t kAbiVersion = 2;

/// A type that a plugin provides.
struct TypeEntry {
  PluginKind kind;
  const char* type;  ///< e.g. "orca.SonarAvoid".
  /// Constructs the object that `kind` names: a Component, whose host is a ComponentHost, or a
  /// hw::HardwareContainer, whose host is a hw::HardwareHost.
  void* (*create)(PluginHost& host);
  void (*destroy)(void* object);
};

/// The one symbol that a plugin exports, `orca_plugin_manifest`. It is plain data, so it can be checked
/// before any of the plugin's code has run. abi_version, size, layout_hash and the objects' type hashes
/// decide about compatibility; build_id is for people.
struct Manifest {
  std::uint32_t abi_version;
  std::uint32_t size;  ///< sizeof(Manifest) when the plugin was built.
  /// A hash over sizes, offsets and virtual functions of every type that a plugin compiles in. The build
  /// computes it (cmake/plugin/list_layouts.py). The plugin's section "orca_plugin_layouts" lists it type by
  /// type.
  std::uint64_t layout_hash;
  const char* build_id;
  const TypeEntry* const* first_type;
  const TypeEntry* const* end_of_types;
};

namespace detail {

template <class Class, class Base, class Host>
void* create(PluginHost& host) {
  return static_cast<Base*>(new Class(static_cast<Host&>(host)));
}

template <class Base>
void destroy(void* object) {
  delete static_cast<Base*>(object);
}

}  // namespace detail
}  // namespace orca

// Entries gather in a section of their own. plugin_entry.cpp, which orca_add_component() adds, exports its
// bounds.
#define ORCA_DETAIL_TYPE_ENTRY(...)                                                          \
  namespace {                                                                                \
  constexpr ::orca::TypeEntry orca_type_entry __VA_ARGS__;                                   \
  [[gnu::section("orca_types"), gnu::used,                                                   \
    gnu::retain]] const ::orca::TypeEntry* const orca_type_entry_pointer = &orca_type_entry; \
  }

/// Registers a class of this source file as a component type. It is used once per file, at the end.
#define ORCA_COMPONENT(Class, type_name)                                                           \
  ORCA_DETAIL_TYPE_ENTRY({::orca::PluginKind::component, type_name,                                \
                          ::orca::detail::create<Class, ::orca::Component, ::orca::ComponentHost>, \
                          ::orca::detail::destroy<::orca::Component>})

#define ORCA_DETAIL_JOIN(a, b) a##b
#define ORCA_DETAIL_CLOCK_NOTE(line, text)                                          \
  namespace {                                                                       \
  [[gnu::section("orca_clock_notes"), gnu::used,                                    \
    gnu::retain]] constexpr char ORCA_DETAIL_JOIN(orca_clock_note_, line)[] = text; \
  }

/// Declares that the types of this plugin cannot run in virtual time, and why: "reads a joystick". The reason
/// is a literal.
#define ORCA_STEADY_CLOCK_ONLY(reason) ORCA_DETAIL_CLOCK_NOTE(__LINE__, "steady only: " reason)

/// Declares that this plugin may use a symbol, an instruction or a path that is otherwise refused in virtual time, and why the symbol
/// does no harm: ORCA_ALLOW_IN_VIRTUAL_TIME("poll", "with a time-out of zero, it never waits"). The symbol is
/// spelt as in the refusal.
#define ORCA_ALLOW_IN_VIRTUAL_TIME(symbol, reason) \
  ORCA_DETAIL_CLOCK_NOTE(__LINE__, "allows " symbol ": " reason)
