// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "containment/guard.hpp"
#include "orca/component/component.hpp"
#include "orca/host/catalogue.hpp"

namespace orca::host {

/// A component's object, what it declared, and the code of both, which stays in memory meanwhile.
struct LoadedComponent {
  LoadedType type;
  std::vector<PortDeclaration> ports;
  std::vector<ParamDeclaration> params;
  Trigger trigger;
  Component* object = nullptr;

  explicit LoadedComponent(LoadedType loaded) : type(std::move(loaded)) {}
  LoadedComponent(const LoadedComponent&) = delete;
  LoadedComponent& operator=(const LoadedComponent&) = delete;
  ~LoadedComponent() { (void)destroy(type.entry == nullptr ? "" : type.entry->type); }

  /// Destroys the object and everything that may lead into its code, but for the code itself.
  /// @param who  the component's name.
  /// @return what its destructor threw.
  std::optional<PluginFault> destroy(const std::string& who) {
    Component* const gone = std::exchange(object, nullptr);
    auto fault = guarded_call({who.c_str(), "its destructor", type.entry}, [&] {
      if (gone != nullptr) type.entry->destroy(gone);
    });
    ports.clear();
    params.clear();
    return fault;
  }
};

}  // namespace orca::host
