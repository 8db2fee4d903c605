// SPDX-License-Identifier: LGPL-3.0-or-later
#include "parameters.hpp"

namespace orca::host {

void Parameters::declare(std::vector<ParamContract> contracts) {
  const MutexLock lock(mutex_);
  contracts_ = std::move(contracts);
}

std::vector<ParamContract> Parameters::contracts() const {
  const MutexLock lock(mutex_);
  return contracts_;
}

ParamValues Parameters::values() const {
  const MutexLock lock(mutex_);
  return values_;
}

void Parameters::keep(ParamValues values) {
  const MutexLock lock(mutex_);
  values_ = std::move(values);
}

void Parameters::trade_places(Parameters& other) {
  const std::scoped_lock both(mutex_, other.mutex_);
  contracts_.swap(other.contracts_);
  values_.swap(other.values_);
}

std::vector<ParamContract> param_contracts(const std::vector<ParamDeclaration>& declared) {
  std::vector<ParamContract> contracts;
  for (const ParamDeclaration& param : declared) contracts.push_back(param.contract);
  return contracts;
}

void set_params(const std::vector<ParamDeclaration>& declared, const ParamValues& values) {
  for (const ParamDeclaration& param : declared)
    if (const auto value = values.find(param.contract.name); value != values.end()) param.set(value->second);
}

}  // namespace orca::host
