// SPDX-License-Identifier: LGPL-3.0-or-later
#include "solver.hpp"

#include <stdexcept>

#include "orca/base/files/own_library.hpp"

namespace orca::collision {
namespace {

const Solver& loaded() {
  const auto get = late_function<decltype(orca_fcl_solver)>("liborca_fcl.so", "orca_fcl_solver");
  if (!get) throw std::runtime_error(get.error().text());
  return (*get)();
}

}  // namespace

const Solver& solver() {
  static const Solver& all = loaded();
  return all;
}

}  // namespace orca::collision
