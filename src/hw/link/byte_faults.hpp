// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/hw/link/faulty_link.hpp"

namespace orca::hw::link {

/// The faults of one direction of a line, byte after byte.
///
/// Thread contract: not synchronised.
class ByteFaults {
 public:
  ByteFaults(Direction direction, const FaultRates& rates, const FaultPlan& plan);

  /// Lets bytes go over the line.
  /// @param modes   what the script changes in them.
  /// @param counts  by Fault; those of single bytes are added.
  /// @return what arrives. What follows a scripted end or silence does not.
  [[nodiscard]] std::vector<std::uint8_t> pass(std::span<const std::uint8_t> bytes, FaultModes& modes,
                                               std::array<std::uint64_t, kFaults>& counts);

 private:
  struct Fate {
    bool drop, flip, insert, duplicate;
    std::uint8_t mask, inserted;
  };

  [[nodiscard]] Fate draw();
  void apply_script(Fate& fate, FaultModes& modes);

  const FaultRates rates_;
  std::vector<ScriptedFault> script_;  // of this direction, in the order of the bytes
  std::size_t next_ = 0;               // in the script
  std::uint64_t passed_ = 0;           // bytes
  RandomStream random_;
};

}  // namespace orca::hw::link
