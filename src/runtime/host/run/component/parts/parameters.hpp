// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/mutex.hpp"
#include "orca/component/host.hpp"

namespace orca::host {

using ParamValues = std::map<std::string, ParamValue>;

/// The parameters of one component: their contracts and their values. They outlive its code.
///
/// Thread contract: declare() before the component's strand starts; values() and contracts() from anywhere;
/// the rest on the strand.
class Parameters {
 public:
  /// @param values  the values that the graph gives.
  explicit Parameters(ParamValues values) : values_(std::move(values)) {}

  void declare(std::vector<ParamContract> contracts);
  [[nodiscard]] std::vector<ParamContract> contracts() const;

  [[nodiscard]] ParamValues values() const;
  /// Sets the values for this object of the component and for those after it.
  void keep(ParamValues values);
  /// Exchanges contracts and values with those of another component, whose strand does nothing.
  void trade_places(Parameters& other) ORCA_THREAD_WORD(no_thread_safety_analysis);

 private:
  mutable Mutex mutex_;
  std::vector<ParamContract> contracts_ ORCA_GUARDED_BY(mutex_);
  ParamValues values_ ORCA_GUARDED_BY(mutex_);
};

/// Returns the contracts of declared parameters.
[[nodiscard]] std::vector<ParamContract> param_contracts(const std::vector<ParamDeclaration>& declared);

/// Sets the values of the parameters that a component's object has declared.
void set_params(const std::vector<ParamDeclaration>& declared, const ParamValues& values);

}  // namespace orca::host
