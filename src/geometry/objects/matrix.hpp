// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

namespace orca::geometry {

// IDL objects keep matrices row by row.
template <int N>
using Square = Eigen::Matrix<double, N, N>;
template <int N>
using RowMajor = Eigen::Matrix<double, N, N, Eigen::RowMajor>;
template <int N>
using Entries = std::array<double, static_cast<std::size_t>(N* N)>;

template <int N>
[[nodiscard]] Square<N> matrix_of(const Entries<N>& entries) {
  return Eigen::Map<const RowMajor<N>>(entries.data());
}

template <int N>
void store(const Square<N>& matrix, Entries<N>& entries) {
  // Rounding makes a product J C J^T slightly unsymmetric.
  Eigen::Map<RowMajor<N>>(entries.data()) = 0.5 * (matrix + matrix.transpose());
}

}  // namespace orca::geometry
