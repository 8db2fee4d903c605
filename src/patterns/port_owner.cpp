// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/port_owner.hpp"

#include <utility>

namespace orca {
namespace {

std::uint32_t default_depth(Pattern pattern) { return pattern == Pattern::push ? 1 : 16; }

}  // namespace

PortDeclaration make_declaration(std::string name, Pattern pattern, Role role, TypeId type,
                                 const PortOptions& options) {
  PortDeclaration declaration;
  declaration.contract.name = std::move(name);
  declaration.contract.pattern = pattern;
  declaration.contract.role = role;
  declaration.contract.type = std::move(type);
  declaration.contract.required = role == Role::proxy && !options.optional;
  declaration.contract.queue.depth = options.depth > 0 ? options.depth : default_depth(pattern);
  if (pattern != Pattern::push) declaration.contract.queue.overflow = QueuePolicy::Overflow::refuse;
  declaration.contract.queue.confirm = options.confirm;
  declaration.contract.period = options.period;
  declaration.contract.from_device = options.from_device;
  declaration.contract.text = options.text;
  declaration.manual = options.manual;
  return declaration;
}

}  // namespace orca
