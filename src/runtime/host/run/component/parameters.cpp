// SPDX-License-Identifier: LGPL-3.0-or-later
#include "parameters.hpp"

namespace orca::host {

ParamValues Parameters::values() const {
  const std::lock_guard lock(mutex_);
  return values_;
}

void Parameters::keep(ParamValues values) {
  const std::lock_guard lock(mutex_);
  values_ = std::move(values);
}

void set_params(const std::vector<ParamDeclaration>& declared, const ParamValues& values) {
  for (const ParamDeclaration& param : declared)
    if (const auto value = values.find(param.contract.name); value != values.end()) param.set(value->second);
}

}  // namespace orca::host
