// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>

#include "component_parts.hpp"
#include "orca/component/component.hpp"
#include "orca/host/catalogue.hpp"

namespace orca::host {

/// The code of one component in this process. It is loaded into memory, the object is constructed and
/// connected with the parts that exist already, and both are released again. Ports, parameters and orders
/// stay meanwhile.
///
/// Thread contract: the component's strand, or before that starts and after it has ended.
class Residency {
 public:
  using Loader = std::function<Result<LoadedType>()>;
  using Unloader = std::function<Status(LoadedType)>;

  /// @param loader, unloader  bring the type's code into memory and release it.
  Residency(ComponentParts& parts, Loader loader, Unloader unloader);
  Residency(const Residency&) = delete;
  Residency& operator=(const Residency&) = delete;

  /// Makes the ports and parameters of a component that is loaded later.
  void declare(const Contract& contract);

  /// Loads the code, constructs the component and sets its parameters.
  /// @errors  those of the loader; internal with what the constructor threw; failed_precondition if the code
  ///          is not the one that the graph was checked with.
  Status load();
  /// Destroys the component and unloads its code. Errors are only logged, because the component is gone in
  /// any case.
  void unload();
  /// Destroys the component; its code is released with this object.
  void destroy();

  /// Returns the component; null while none is loaded.
  [[nodiscard]] Component* component() const { return component_; }

 private:
  // Notes whose code runs, for alarms and last words.
  void set_code(const void* code);
  Status construct();
  void declare_what_is_there();

  ComponentParts& parts_;
  const Loader loader_;
  const Unloader unloader_;
  LoadedType type_;  // outlives the component
  Component* component_ = nullptr;
};

}  // namespace orca::host
