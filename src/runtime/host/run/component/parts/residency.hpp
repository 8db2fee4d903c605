// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>

#include "component_parts.hpp"
#include "component_site.hpp"
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
  /// Destroys the component, after a stop() that it still waits for; its code is released with this object.
  /// @errors  internal: the destructor threw. That is logged, and the component is gone all the same.
  Status destroy();

  /// Exchanges the objects of two components, with their code. Each is connected with the other's ports; ports that only one
  /// of them has are made, unconnected. Parameters go along.
  /// @pre  both are loaded, and the other one's strand does nothing.
  void trade_places(Residency& other);

  /// Returns the component; null while none is loaded.
  [[nodiscard]] Component* component() const { return resident_.object; }
  /// Returns the name of its type. @pre  it is loaded.
  [[nodiscard]] const char* type_name() const { return resident_.type.entry->type; }
  /// Returns what its object has declared. @pre  it is loaded.
  [[nodiscard]] const Declarations& declared() const { return resident_.site->declared(); }
  /// Returns whether the component is to work without clients: the graph's word counts before its own.
  [[nodiscard]] bool stays_active() const;

  /// Exchanges what brings the code of two components into memory, with their parameters. Ports that only the other one has are
  /// made.
  /// @pre  this one is not loaded.
  void trade_loaders(Residency& other);

  /// Notes whether its start() has been called and its stop() has not.
  void note_started(bool started) { resident_.started = started; }
  [[nodiscard]] bool is_started() const { return resident_.started; }
  /// Notes whether its suspend() has been called and its resume() has not.
  void note_paused(bool paused) { resident_.paused = paused; }
  [[nodiscard]] bool is_paused() const { return resident_.paused; }

 private:
  // One object. Its members outlive each other in this order.
  struct Resident {
    LoadedType type;
    std::unique_ptr<ComponentSite> site;
    Component* object = nullptr;
    bool started = false;
    bool paused = false;
  };

  // Notes whose code runs, for alarms and last words.
  void set_code(const void* code);
  Status construct();
  void declare_what_is_there();
  void stop_left_over();
  void add_ports_of(const Residency& other);
  void settle();

  ComponentParts& parts_;
  Loader loader_;
  Unloader unloader_;
  Resident resident_;
};

}  // namespace orca::host
