// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

#include "deployer.hpp"

namespace orca::test {

/// Returns the floor plan of a real hospital, which is not part of this repository. It is looked up in the
/// folder that the environment variable ORCA_DATA names, else in shared/data beside the source tree. If it is
/// not there, returns an empty path and prints a line that makes ctest show the test as skipped.
inline std::string hospital_map() {
  const char* const named = std::getenv("ORCA_DATA");
  const std::filesystem::path folder = named != nullptr ? named : source_file("../shared/data");
  const std::filesystem::path map = (folder / "stage_maps/hospital.png").lexically_normal();
  if (std::filesystem::exists(map)) return map.string();
  std::cout << "SKIPPED: there is no " << map.string()
            << "; set ORCA_DATA to the folder that holds stage_maps/hospital.png\n";
  return {};
}

}  // namespace orca::test
