// SPDX-License-Identifier: GPL-3.0-or-later
// Ways of a robot that steers through the hospital of the Stage project, in cells of 8 cm.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <ctime>
#include <iostream>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/maps/map_file.hpp"
#include "orca/navigation/hybrid_planner.hpp"
#include "orca/navigation/path_planner.hpp"
#include "public_data.hpp"
#include "slow_run.hpp"
#include "steered_ways.hpp"

using namespace orca;
using namespace orca::nav;
using namespace orca::test;

namespace {

constexpr Footprint kPioneer{0.2555, 0.2125, 0.3323};
constexpr double kRadius = 0.5;
constexpr double kMargin = 0.015;
constexpr double kCell = 0.08;
constexpr double kPixel = 140.0 / 3117.0;  // [m] the whole hospital is 140 m wide

/// A pose to start at, one to drive to, and the way that A* finds.
struct Query {
  Pose2 from, to;
  Path path;
};

// Draws the floor plan in coarser cells: one is occupied if a pixel within it is.
std::optional<FloorGrid> hospital() {
  const std::string file = public_data("stage_maps/hospital_section.png");
  if (file.empty()) return std::nullopt;
  const auto plan = maps::read_map(file, kPixel);
  REQUIRE(plan);
  const Lattice fine{{}, kPixel, static_cast<int>(plan->columns()), static_cast<int>(plan->rows())};
  const auto cells = [&](int pixels) { return static_cast<int>(std::ceil(pixels * kPixel / kCell)); };
  FloorGrid grid{{{}, kCell, cells(fine.columns), cells(fine.rows)}, {}};
  grid.cells.assign(grid.lattice.size(), 0);
  for (std::size_t i = 0; i < fine.size(); ++i)
    if (plan->cells()[i] == 100)
      grid.cells[grid.lattice.index(grid.lattice.cell_at(fine.middle_of(fine.cell_of(i))))] = 100;
  return grid;
}

/// A planner over the hospital, and random places in it.
class Trial {
 public:
  explicit Trial(FloorGrid floor) : grid_(std::move(floor)), map_(grid_) {
    paths_.look_at(map_, kPioneer, {});
    planner_.look_at(map_, kPioneer, paths_.costs(), {}, kRadius, kMargin);
  }

  // Returns a start and a goal between which A* finds a way. Their directions are random, or those of that way.
  Query query(bool along_the_way) {
    for (;;) {
      Query query{place(), place(), {}};
      paths_.look_at(map_, kPioneer, {});  // planning has closed places
      const Plan plan = paths_.plan(map_, query.from.position(), query.to.position());
      if (!plan.complete) continue;
      query.path = plan.path;
      if (along_the_way) {
        query.from.yaw = plan.path.heading(0.0);
        query.to.yaw = plan.path.heading(plan.path.length());
      }
      if (planner_.outline().touched(query.from) + planner_.outline().touched(query.to) == 0) return query;
    }
  }

  SteeredPlan plan(const Query& query) {
    return planner_.plan(query.from, {query.to.position(), query.to.yaw});
  }

  [[nodiscard]] bool is_free(const Pose2& pose) const { return !touches(grid_, kPioneer, pose); }

 private:
  Pose2 place() {
    const Lattice& lattice = grid_.lattice;
    return {random_.uniform(0.0, lattice.columns * lattice.side),
            random_.uniform(0.0, lattice.rows * lattice.side),
            random_.uniform(-std::numbers::pi, std::numbers::pi)};
  }

  FloorGrid grid_;
  OccupancyMap map_;
  PathPlanner paths_{kShortest};
  HybridPlanner planner_;
  RandomStream random_{1, "test", "hospital"};
};

double share(std::vector<double> values, double part) {
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

}  // namespace

TEST_CASE(
    "ways of a robot that steers through a hospital are found, free for the exact outline, and keep its "
    "circle",
    "[navigation][hybrid][maps]") {
  const auto grid = hospital();
  if (!grid) return;
  CHECK(grid->lattice.size() == 151'890);
  Trial trial(*grid);
  const int count = part_of(1'000);
  int found = 0;
  int free = 0;
  int kept = 0;
  std::vector<double> times;
  for (int i = 0; i < count; ++i) {
    const Query query = trial.query(false);
    const std::clock_t begin = std::clock();
    const SteeredPlan plan = trial.plan(query);
    times.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    const std::vector<Pose2> poses = poses_on(query.from, plan.pieces, 0.005);
    found += plan.complete && norm(poses.back().position() - query.to.position()) < 1e-6 &&
                     std::fabs(wrapped(poses.back().yaw - query.to.yaw)) < 1e-6
                 ? 1
                 : 0;
    free += std::ranges::all_of(poses, [&](const Pose2& pose) { return trial.is_free(pose); }) ? 1 : 0;
    kept += std::ranges::all_of(
                plan.pieces,
                [](const WayPiece& piece) { return std::fabs(piece.curvature) * kRadius < 1.0 + 1e-9; })
                ? 1
                : 0;
  }
  std::cout << count << " ways: found " << found << ", free " << free << "; processor time: mean "
            << std::accumulate(times.begin(), times.end(), 0.0) / count << " ms, 95 % within "
            << share(times, 0.95) << " ms, all within " << share(times, 1.0) << " ms\n";
  CHECK(found >= count * 99 / 100);
  CHECK(free == count);
  CHECK(kept == count);
}

TEST_CASE("a robot that begins and ends in the directions of A*'s way drives at most 1.15 times as far",
          "[navigation][hybrid][maps]") {
  const auto grid = hospital();
  if (!grid) return;
  Trial trial(*grid);
  std::vector<double> ratios;
  for (int i = 0; i < part_of(1'000); ++i) {
    const Query query = trial.query(true);
    if (query.path.length() < 1.0) continue;
    const SteeredPlan plan = trial.plan(query);
    CHECK(plan.complete);
    ratios.push_back(length_of(plan.pieces) / query.path.length());
  }
  std::cout << ratios.size() << " ways beside those of A*: " << share(ratios, 0.5)
            << " times as long in the median, at most " << share(ratios, 1.0) << " times\n";
  CHECK(share(ratios, 1.0) <= 1.15);
}
