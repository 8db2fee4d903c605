// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/component/manifest.hpp"
#include "orca/hw/container.hpp"
#include "orca/hw/seat.hpp"

namespace orca::plugin {

/// A hardware container that was constructed and prepared, but opens nothing. The contracts of components can
/// depend on it.
///
/// Thread contract: one thread at a time, as for the functions below.
class DescribedHardware {
 public:
  virtual ~DescribedHardware() = default;
  [[nodiscard]] virtual const Contract& contract() const = 0;
  /// Sets the parameters and declares the endpoints.
  /// @return the errors in the files that the parameters name, ready to print.
  virtual std::vector<HardwareFault> prepare(const std::map<std::string, ParamValue>& params) = 0;
  /// Compares it with another container of the same type. @pre  both are prepared.
  /// @return the errors that only the two together have.
  virtual std::vector<HardwareFault> conflicts_with(DescribedHardware& earlier) = 0;
  [[nodiscard]] virtual hw::HardwareContainer& container() = 0;
  /// Returns the container as servers see it.
  [[nodiscard]] virtual hw::HardwareSeat& seat() = 0;
};

/// Constructs a container only to describe it.
/// @param name  name of the hardware in the graph.
/// @errors  internal if its constructor throws or does more than declare.
Result<std::unique_ptr<DescribedHardware>> describe_hardware(const TypeEntry& type,
                                                             const std::string& library,
                                                             const std::string& name);

/// Constructs a component only to describe it, and destroys it again.
/// @param hardware  the prepared hardware that the graph binds to it; null: none.
/// @errors  internal if its constructor throws or does more than declare.
Result<Contract> describe_component(const TypeEntry& type, const std::string& library,
                                    hw::HardwareSeat* hardware);

}  // namespace orca::plugin
