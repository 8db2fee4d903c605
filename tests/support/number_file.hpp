// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Files of numbers that plugins of the tests write (tests/data/plugins/tally_file.hpp).
#pragma once

#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <vector>

namespace orca::test {

using Numbers = std::vector<std::int64_t>;

inline Numbers read_numbers(const std::filesystem::path& path) {
  Numbers numbers(std::filesystem::file_size(path) / sizeof(std::int64_t));
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(numbers.data()),
            static_cast<std::streamsize>(numbers.size() * sizeof(std::int64_t)));
  REQUIRE(file);
  return numbers;
}

}  // namespace orca::test
