// SPDX-License-Identifier: GPL-3.0-or-later
// Mapping on public data: pose graphs with published optima, and a log of a real robot (docs/validation.md has the figures).
#include <algorithm>
#include <catch2/catch.hpp>
#include <iostream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "measured_relations.hpp"
#include "orca/navigation/pose_graph.hpp"
#include "orca/navigation/slam.hpp"

using namespace orca;
using namespace orca::nav;
using namespace orca::test;

namespace {

// Reads a graph as g2o writes it. The weights are those of the published optima: 2 / trace of the inverse for places, and for directions the
// chord of matrices, whose square is twice that of unit vectors.
PoseGraph read(const std::string& text) {
  PoseGraph graph;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind != "EDGE_SE2") continue;
    PoseRelation r;
    PoseInformation i;
    words >> r.from >> r.to >> r.measured.x >> r.measured.y >> r.measured.yaw >> i.xx >> i.xy >> i.xt >>
        i.yy >> i.yt >> i.tt;
    const double place = 2.0 * (i.xx * i.yy - i.xy * i.xy) / (i.xx + i.yy);
    r.information = {place, 0.0, place, 0.0, 0.0, 2.0 * i.tt};
    graph.relations.push_back(r);
    graph.poses.resize(std::max(graph.poses.size(), std::max(r.from, r.to) + 1));
  }
  return graph;
}

/// One scan of the log of the Intel Research Lab.
struct LogScan {
  double stamp;  // [s]
  Pose2 X_OR;
  std::vector<SurfacePoint> scan;
};

std::vector<LogScan> read_log(const std::string& text) {
  constexpr double kNothing = 20.0;  // [m] more is the laser's word for no echo
  std::vector<LogScan> log;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("#")) continue;
    std::istringstream words(line);
    LogScan scan{};
    double reference = 0.0;  // GMapping's pose, which is not looked at
    words >> scan.stamp >> scan.X_OR.x >> scan.X_OR.y >> scan.X_OR.yaw >> reference >> reference >> reference;
    std::vector<Vec2> points;
    double range = 0.0;
    for (int i = 0; words >> range; ++i)
      if (range < kNothing) points.push_back(range * direction((i - 90) * std::numbers::pi / 180.0));
    scan.scan = surface_of(points, {});
    log.push_back(std::move(scan));
  }
  return log;
}

// Returns how wrong the nodes are.
RelationErrors errors_of_nodes(const std::string& relations, std::span<const double> stamps,
                               std::span<const SlamNode> nodes) {
  std::vector<Pose2> poses;
  for (const SlamNode& node : nodes) poses.push_back(node.X_MR);
  return test::errors_of(relations, stamps, poses);
}

void check(const char* when, const RelationErrors& errors) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  std::cout << when << ": " << errors.count << " relations, " << errors.place << " m, "
            << errors.turn / kDegree << " degrees; " << errors.loops << " of loops, " << errors.of_loops
            << " m\n";
  CHECK(errors.count == 97);
  CHECK(errors.place <= 0.026);
  CHECK(errors.turn <= 0.50 * kDegree);
  CHECK(errors.of_loops <= 0.035);
}

}  // namespace

TEST_CASE("published pose graphs come out at their published optima", "[navigation]") {
  struct Published {
    std::string file;
    std::size_t poses, relations;
    double optimum;  // Rosen and others, "SE-Sync", IJRR 2019, table 1
  };
  for (const auto& [file, poses, relations, optimum] :
       {Published{"posegraphs/intel.g2o.gz", 1728, 2512, 5.235e1},
        {"posegraphs/manhattan.g2o.gz", 3500, 5453, 6.432e3}}) {
    const std::string text = public_text(file);
    if (text.empty()) continue;
    PoseGraph graph = read(text);
    REQUIRE(graph.poses.size() == poses);
    REQUIRE(graph.relations.size() == relations);
    REQUIRE(begin_anew(graph));
    const PoseGraphFit result = fit(graph);
    CHECK(result.solved);
    CHECK(result.misfit == Approx(optimum).epsilon(0.001));
  }
}

TEST_CASE("the log of the Intel lab becomes a map as right as people have measured it", "[.][slow]") {
  const std::string text = public_text("slam/intel_scans.txt.gz");
  const std::string relations = public_text("slam/intel.relations.gz");
  if (text.empty() || relations.empty()) return;
  const std::vector<LogScan> log = read_log(text);
  REQUIRE(log.size() == 910);
  Slam slam;
  std::vector<double> stamps;
  for (const LogScan& scan : log) {
    (void)slam.see(scan.scan, scan.X_OR);
    if (slam.nodes().size() > stamps.size()) stamps.push_back(scan.stamp);
  }
  check("as it drives", errors_of_nodes(relations, stamps, slam.nodes()));
  slam.finish();
  check("at the end", errors_of_nodes(relations, stamps, slam.nodes()));
}
