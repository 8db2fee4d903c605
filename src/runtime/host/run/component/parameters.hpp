// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "orca/component/host.hpp"

namespace orca::host {

using ParamValues = std::map<std::string, ParamValue>;

/// The parameters of one component: their contracts and their values. They outlive its code.
///
/// Thread contract: declare() before the component's strand starts; values() and contracts() from anywhere;
/// keep() on the strand.
class Parameters {
 public:
  /// @param values  the values that the graph gives.
  explicit Parameters(ParamValues values) : values_(std::move(values)) {}

  void declare(std::vector<ParamContract> contracts) { contracts_ = std::move(contracts); }
  [[nodiscard]] const std::vector<ParamContract>& contracts() const { return contracts_; }

  [[nodiscard]] ParamValues values() const;
  /// Sets the values for this object of the component and for those after it.
  void keep(ParamValues values);

 private:
  std::vector<ParamContract> contracts_;
  mutable std::mutex mutex_;
  ParamValues values_;
};

/// Sets the values of the parameters that a component's object has declared.
void set_params(const std::vector<ParamDeclaration>& declared, const ParamValues& values);

}  // namespace orca::host
