// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/navigation/distance_transform.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "orca/base/random.hpp"

using orca::nav::DistanceTransform;

namespace {

struct Picture {
  int columns = 0;
  int rows = 0;
  std::vector<std::uint8_t> obstacles;
};

Picture random_picture(orca::RandomStream& random) {
  Picture picture{
      static_cast<int>(random.uniform(1.0, 40.0)), static_cast<int>(random.uniform(1.0, 40.0)), {}};
  const double share = random.uniform(0.0, 0.1);
  picture.obstacles.resize(static_cast<std::size_t>(picture.columns * picture.rows));
  for (std::uint8_t& cell : picture.obstacles) cell = random.chance(share) ? 1 : 0;
  return picture;
}

std::int32_t by_hand(const Picture& picture, int column, int row) {
  std::int32_t least = DistanceTransform::kFar;
  for (int r = 0; r < picture.rows; ++r)
    for (int c = 0; c < picture.columns; ++c)
      if (picture.obstacles[static_cast<std::size_t>(r * picture.columns + c)] != 0)
        least = std::min(least, (c - column) * (c - column) + (r - row) * (r - row));
  return least;
}

// Returns the number of cells whose distance is wrong. Beyond the reach any greater number is right.
int wrong_cells(const Picture& picture, std::span<const std::int32_t> squared, int reach) {
  int wrong = 0;
  for (int row = 0; row < picture.rows; ++row)
    for (int column = 0; column < picture.columns; ++column) {
      const std::int32_t right = by_hand(picture, column, row);
      const std::int32_t found = squared[static_cast<std::size_t>(row * picture.columns + column)];
      wrong += right <= reach * reach ? found != right : found <= reach * reach;
    }
  return wrong;
}

}  // namespace

TEST_CASE("the distance transform agrees with a search through all obstacles", "[navigation]") {
  orca::RandomStream random(7, "test", "pictures");
  DistanceTransform transform;  // the same for all: nothing may be left from the picture before
  for (int i = 0; i < 150; ++i) {
    const Picture picture = random_picture(random);
    CAPTURE(i, picture.columns, picture.rows);
    CHECK(wrong_cells(picture, transform(picture.obstacles, picture.columns, picture.rows, 100), 100) == 0);
  }
}

TEST_CASE("the distance transform is exact within its reach, and beyond it only says that it is farther",
          "[navigation]") {
  orca::RandomStream random(8, "test", "pictures");
  DistanceTransform transform;
  for (int i = 0; i < 150; ++i) {
    const Picture picture = random_picture(random);
    const int reach = 1 + i % 12;
    CAPTURE(i, reach);
    CHECK(wrong_cells(picture, transform(picture.obstacles, picture.columns, picture.rows, reach), reach) ==
          0);
  }
}
