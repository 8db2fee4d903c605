// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "orca/idl/object_type.hpp"

/// @file
/// What liborca_idl.so offers to libraries of object types that are made elsewhere, by orca_generate_idl(). Their generated
/// code uses it; authors of components do not.
namespace orca::detail {

/// Returns the layout of a struct or enum of Orca's own IDL files, by its C++ type and the hash of that layout. liborca_idl.so
/// defines it only for the layouts that it was built with. A library whose types hold or extend a struct of another layout refers to
/// a missing symbol and does not load.
template <class T, std::uint64_t layout_hash>
[[nodiscard]] std::string_view part_layout();

/// Returns the layout of a struct or enum of Orca's own IDL files; empty if there is none of that name.
/// @thread  any.
[[nodiscard]] std::string_view part_layout(std::string_view name);

/// Returns why the types cannot be known beside all others, which names the first one whose name is taken; empty if they can.
/// @thread  any.
[[nodiscard]] std::string clash_of(std::span<const ObjectType* const> types);

/// Lets object_types() and all searches know the types from now on. Spans that object_types() returned before stay valid.
///
/// @param types  constants of a library that is never unloaded, in any order.
/// @return true.
/// @thread  any; a library does it in its static initialisation.
/// @throws std::logic_error if the name of one is taken: to go on would let two C++ types pass for each other.
bool add_object_types(std::span<const ObjectType* const> types);

/// Keep other threads from adding types while the process is copied (fork).
void lock_object_types();
void unlock_object_types();

}  // namespace orca::detail
