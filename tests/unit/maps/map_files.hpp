// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// Map files for tests.
#pragma once

#include <catch2/catch.hpp>
#include <functional>
#include <string>
#include <vector>

#include "orca/maps/map_file.hpp"
#include "temp_folder.hpp"

namespace orca::maps::test {

inline const std::string kHeader =
    "image: map.pgm\nresolution: 0.05\norigin: [-1.0, 2.0, 0.0]\nnegate: 0\noccupied_thresh: "
    "0.65\nfree_thresh: 0.196\n";

/// Returns `text` with `from` replaced by `to`.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// Returns a PGM file of text, whose greys are given row by row from the top.
inline std::string pgm(std::size_t width, std::size_t height, const std::vector<int>& greys,
                       int largest = 255) {
  std::string text =
      "P2\n" + std::to_string(width) + " " + std::to_string(height) + "\n" + std::to_string(largest) + "\n";
  for (const int grey : greys) text += std::to_string(grey) + "\n";
  return text;
}

/// Returns the greys of a picture as a function of column and row, from the top.
inline std::vector<int> drawn(int width, int height, const std::function<int(int, int)>& grey_at) {
  std::vector<int> greys;
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column) greys.push_back(grey_at(column, row));
  return greys;
}

/// Returns the map of a YAML file beside a picture map.pgm.
inline Result<idl::OccupancyGrid> read_files(const std::string& header, const std::string& picture) {
  const orca::test::TempFolder folder;
  folder.write("map.pgm", picture);
  return read_map(folder.write("office.yaml", header));
}

/// Returns the cells of a map as numbers, row 0 first.
inline std::vector<int> cells_of(const idl::OccupancyGrid& map) {
  return {map.cells().begin(), map.cells().end()};
}

/// Returns the text of the error; empty if there is none.
inline std::string fault_of(const Result<idl::OccupancyGrid>& map) { return map ? "" : map.error().text(); }

}  // namespace orca::maps::test
