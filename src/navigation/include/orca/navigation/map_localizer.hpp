// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/navigation/known_map.hpp"
#include "orca/navigation/particles.hpp"
#include "orca/navigation/sonar_model.hpp"
#include "orca/navigation/surface_offset.hpp"

namespace orca::nav {

/// A laser's scan, robot frame at its first beam.
struct RobotScan {
  std::size_t sensor = 1;  ///< A number of the laser from 1 on.
  Vec2 from;               ///< Where it was taken from.
  std::vector<SurfacePoint> echoes;
  std::size_t beams = 0;  ///< that could have had an echo.
};

/// Whether it is known where the robot is.
enum class Known : std::uint8_t {
  unknown,    ///< Nobody has said it, and nothing was found yet.
  ambiguous,  ///< One of several places.
  localized,
  lost,  ///< It was known, but what is sensed does not fit there any more, or nothing has been sensed for too long.
};

/// When a place is believed. The defaults are those with which all was measured.
struct LocalizerOptions {
  double believed_from =
      0.72;  ///< [1] how well scans fit at a place (Explanation::fit) for it to be believed.
  double believed_at_once =
      0.9;  ///< [1] the same for a place that was suggested, before the map was searched.
  /// logarithm of the odds of such a place against others that fit as well, and of the one where the robot is by its wheels since it was last known.
  double suggested = 10.0;
  /// [1] share of the echoes behind the map's walls, of those on walls or behind, up to which a place is believed that was not.
  double most_behind = 0.07;
  double doubted_below =
      0.45;              ///< [1] the same, on the average of the last scans, below which a place is doubted.
  double fallen = 0.75;  ///< [1] the same as a part of what it was before, on a long average.
  double update_way = 0.1;   ///< [m] after which a scan counts.
  double update_turn = 0.1;  ///< [rad] after which it does.
  double check_time = 0.5;   ///< [s] after which it is looked at even if the robot has not moved.
  double blind_way = 2.0;    ///< [m] after which a robot that senses nothing that says where it is, is lost.
  double blind_time = 3.0;   ///< [s] after which it is, if no scan comes at all.
  FitMargin margin;
  bool searches = true;         ///< Whether it searches the whole map for other places when it doubts.
  std::size_t looks = 4000000;  ///< values of the map that are looked up for a search, with each scan.
  MatchOptions match{.error = 0.03, .together = 10.0};
  ParticleOptions particles;
};

/// The belief in a place.
struct PlaceBelief {
  PoseSpread where;
  double odds = 0.0;  ///< Natural logarithm, relative to the best place.
  double quick =
      -1.0;  ///< [1] How well is sensed what the map shows there, on a short average; below 0: nothing was sensed yet.
  double slow = -1.0;  ///< [1] The same on a long one.
  bool believed = false;
};

/// Finds where a robot is in a map: particles in each place where it may be, which move by odometry; scans that are laid on the map draw them
/// together, echoes of sonars weigh them; and where nothing fits, a search in the whole map for other places.
///
/// Thread contract: one thread at a time.
/// @source  README.md
class MapLocalizer {
 public:
  MapLocalizer(std::shared_ptr<const KnownMap> map, const RandomStream& random,
               const LocalizerOptions& options = {});
  ~MapLocalizer();

  /// Goes on in another map. The place is kept, but doubted.
  void change_map(std::shared_ptr<const KnownMap> map);
  /// Believes at once that the robot is where somebody says.
  void place(const PoseSpread& where, const Reckoned& now);
  /// Goes on with what another one has believed.
  /// @param was_known  whether the robot has been localized before.
  /// @param offsets    what that one had learnt of each sensor's walls; empty: what this one has learnt stays.
  void resume(std::span<const PlaceBelief> places, bool was_known, const Reckoned& now,
              const std::vector<SurfaceOffset>& offsets = {});
  /// Begins with a place that may be wrong, such as where the robot was before it was switched off. It is believed at once only if scans
  /// fit very well there; in any case the map is searched once for places that fit better, as along a corridor many fit well.
  /// If nothing is searched, only scans that fit very well let it be believed.
  void suggest(const PoseSpread& where, const Reckoned& now);

  /// Goes on to where odometry is now.
  void move(const Reckoned& now);
  /// Goes on with odometry that counts from another place than before. The place is kept, but doubted.
  void reckon_anew(const Reckoned& now);
  /// Returns whether it is time for what a sensor says: the robot has moved, or some time has passed.
  /// @param sensor  as in RobotScan; kSonars: all sonars.
  [[nodiscard]] bool is_time_for(std::size_t sensor, const Reckoned& now) const;
  static constexpr std::size_t kSonars = 0;
  /// Takes a scan, if it is time for it. @pre  move() was called for when it was taken.
  void see(const RobotScan& scan);
  /// Takes the echoes of sonars since the last time. @pre  as see().
  void hear(std::span<const SonarEcho> echoes);

  /// Returns when move() was called for [s].
  [[nodiscard]] double time() const { return now_.time; }
  /// Returns how well it is known where the robot is.
  [[nodiscard]] Known known(const Reckoned& now) const;
  /// Returns where the robot is if it is anywhere: at the best of the places.
  [[nodiscard]] std::optional<PoseSpread> where(const Reckoned& now) const;
  /// Returns all places where it may be, the best first.
  [[nodiscard]] std::vector<PlaceBelief> places(const Reckoned& now) const;
  [[nodiscard]] bool was_known() const { return was_known_; }
  /// Returns what was learnt of each sensor's walls, by its number.
  [[nodiscard]] const std::vector<SurfaceOffset>& offsets() const { return offsets_; }
  [[nodiscard]] bool searches() const { return search_ != nullptr; }

 private:
  struct Candidate;
  struct GlobalSearch;
  /// A place that was believed, until other places were.
  struct Left {
    PoseSpread where;
    Reckoned at;
  };

  void doubt_all();
  bool begin_update(std::size_t sensor);
  void settle();
  void lay(Candidate& place, const RobotScan& scan);
  void compare(std::span<const double> fits);
  void begin_search(const RobotScan& scan);
  void go_on_searching();
  void take_found();
  void count_stayed();
  void drop_unlikely();
  void believe(double least);
  void add_place(const PlaceBelief& belief, std::size_t count);

  std::shared_ptr<const KnownMap> map_;
  RandomStream random_;
  LocalizerOptions options_;
  std::vector<Candidate> places_;  // the best first
  Reckoned now_;
  Reckoned settled_;        // where the particles are
  double unsettled_ = 0.0;  // [m], [rad] moved since
  bool moved_ = false;      // move() was called
  bool was_known_ = false;
  bool suggested_ = false;      // The first place was suggested, and the map was not searched since.
  bool left_some_out_ = false;  // The last search found more places than it keeps.
  double way_ = 0.0;            // [m] driven
  double alone_since_ = 0.0;    // [m] driven when there was more than one place, or none
  double changed_ = 0.0;        // [m] by which the view has changed since places were compared
  double seen_way_ = 0.0;       // [m] when something was sensed last that says where it is
  double seen_time_ = 0.0;      // [s] when anything was
  double searched_way_ = -1e9;
  double searched_time_ = -1e9;
  double gone_ = 0.0;                   // [m], [rad] moved since a scan of this sensor counted
  std::vector<Reckoned> counted_;       // of each sensor: when its last scan counted
  std::vector<SurfaceOffset> offsets_;  // of each sensor
  std::unique_ptr<GlobalSearch> search_;
  std::optional<Left> left_;
};

}  // namespace orca::nav
