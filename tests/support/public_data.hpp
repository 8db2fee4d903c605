// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

namespace orca::test {

/// Returns the path of a file of public data, which is not part of this repository. It is looked up in the folder
/// that the environment variable ORCA_DATA names, else in shared/data beside the source tree. If it is not there,
/// returns an empty path and prints a line that makes ctest show the test as skipped.
inline std::string public_data(const std::string& file) {
  const char* const named = std::getenv("ORCA_DATA");
  const std::filesystem::path folder = named != nullptr ? named : ORCA_SOURCE_DIR "/../shared/data";
  const std::filesystem::path path = (folder / file).lexically_normal();
  if (std::filesystem::exists(path)) return path.string();
  std::cout << "SKIPPED: there is no " << path.string() << "; set ORCA_DATA to the folder that holds " << file
            << "\n";
  return {};
}

}  // namespace orca::test
