// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/component.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/geometry/objects/waiting_scans.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/beams.hpp"
#include "orca/navigation/occupancy_map.hpp"
#include "orca/navigation/pose_history.hpp"
#include "orca/planning/floor.hpp"

namespace {

using orca::ObjectPtr;
using orca::Pose2;
using orca::Vec2;
using orca::idl::LaserRangeReadings;
using orca::idl::OccupancyGrid;
using orca::idl::SonarRangeReadings;
using orca::nav::Beam;
using orca::nav::Cell;
using orca::nav::Lattice;

constexpr std::uint8_t kFree = 0;
constexpr std::uint8_t kOccupied = 100;
constexpr std::uint8_t kUnknown = 255;

/// One sensor that is heard.
template <typename Reading>
struct Heard {
  typename orca::PushProxyArray<Reading>::Source source;
  orca::WaitingScans scans;              // of a laser
  std::vector<orca::TimePoint> fired{};  // of each sonar
};

/// A place at which something was touched.
struct Touched {
  Vec2 place;  // in the world
  orca::TimePoint at{};
};

/// A model of the floor around the robot (thesis 11.1): what lasers and sonars have seen of late, over the map of a building. See README.md.
class WorldModel final : public orca::Component {
 public:
  explicit WorldModel(orca::ComponentHost& host) : Component(host) {}

 private:
  static constexpr double kCell = 0.05;  // [m] without a map
  static constexpr int kFadings = 16;    // until nothing is known any more
  static constexpr orca::Duration kWholeEvery = std::chrono::seconds(2);

  orca::Status configure() override {
    lap_on("localizer");
    if (laser_.sources().empty() && sonar_.sources().empty())
      return orca::fail(orca::Code::failed_precondition,
                        "it senses nothing: connect its port \"laser\" or \"sonar\"");
    return orca::ok();
  }

  // An object that takes the place of another one finds the map as it came to that: MapServer does not push it again.
  orca::Status start() override {
    begin(kCell);
    if (map_.connected())
      if (const auto map = map_.latest()) take_map(*map);
    lasers_.clear();
    rings_.clear();
    for (const auto& source : laser_.sources()) source.subscribe(), lasers_.push_back({source, {}});
    for (const auto& source : sonar_.sources()) source.subscribe(), rings_.push_back({source, {}});
    return orca::ok();
  }

  void stop() override {
    laser_.unsubscribe_all();
    sonar_.unsubscribe_all();
  }

  // A successor sees again what this object has seen, but not what bumpers have felt.
  void save_state(orca::StateWriter& state) const override { state.write(touched_); }
  orca::Status load_state(orca::StateReader& state) override { return state.read(touched_); }

  orca::Outcome work() override {
    const auto pose = localizer_.get_update();
    while (map_.new_data_arrived()) take_map(*map_.get_update());
    if (!senders_.accepts(*pose)) return orca::again();
    if (orca::is_anywhere(pose->covariance())) {  // it is not known where what it senses is
      begin(seen_->lattice().side);
      return orca::again();
    }
    history_.add(orca::to_time_point(pose->stamp()), seen_from(X_WG_, orca::plane_pose(*pose)));
    robot_ = history_.at(history_.newest())->position();
    const bool heard = hear_lasers() | hear_sonars() | feel_bumpers();
    fade();
    push(heard);
    return orca::again();
  }

  // Nothing goes out by itself while no sensor is heard: who drives by it stops then.
  void push(bool heard) {
    const bool is_new = maps_.take_new_subscribers();
    if (!is_new && !heard) return;
    const bool has_moved = seen_->lattice().corner != pushed_corner_;
    if (!is_new && !has_moved && whole_at_ && now() - *whole_at_ < kWholeEvery) {
      maps_.push(part());
      return;
    }
    maps_.push(whole());
    whole_at_ = now();
    pushed_corner_ = seen_->lattice().corner;
  }

  // Forgets all, and begins a grid of cells of that side.
  void begin(double cell) {
    seen_.emplace(cell, *map_size_);
    history_.clear();
    touched_.clear();
    begun_ = false;
    whole_at_.reset();
    faded_at_ = now();
  }

  // The grid is laid so that its cells are those of the map.
  void take_map(const OccupancyGrid& map) {
    if (const orca::Status taken = floor_.take(map); !taken.ok()) return log_warning(taken.error().message);
    const Lattice& lattice = floor_.grid().lattice;
    X_WG_ = floor_.X_WM() * Pose2{lattice.corner.x, lattice.corner.y, 0.0};
    begin(lattice.side);
  }

  bool hear_lasers() {
    bool heard = false;
    for (auto& laser : lasers_) {
      if (laser.source.new_data_arrived())
        if (auto scan = laser.source.take_latest(); senders_.accepts(*scan)) laser.scans.add(scan);
      const orca::ScanPtr scan = laser.scans.take_until(history_.newest());
      if (!scan) continue;
      const auto first = history_.at(orca::to_time_point(scan->stamp()));
      const auto last = history_.at(orca::last_beam_of(*scan));
      if (!first || !last) continue;
      const Pose2 mount = orca::plane_pose(scan->pose());
      orca::nav::beams_of({scan->ranges(), scan->min_range(), scan->max_range(), scan->angle_start(),
                           scan->angle_increment(), *first * mount, *last * mount},
                          *laser_range_, beams_);
      see();
      heard = true;
    }
    return heard;
  }

  bool hear_sonars() {
    bool heard = false;
    for (auto& ring : rings_) {
      if (!ring.source.new_data_arrived()) continue;
      const auto round = ring.source.take_latest();
      if (!senders_.accepts(*round)) continue;
      beams_.clear();
      const std::size_t count =
          std::min({round->ranges().size(), round->poses().size(), round->stamps().size()});
      ring.fired.resize(count, orca::TimePoint::min());
      for (std::size_t i = 0; i < count; ++i) {
        const orca::TimePoint stamp = orca::to_time_point(round->stamps()[i]);
        const auto then = history_.at(stamp);
        if (!then || stamp == std::exchange(ring.fired[i], stamp)) continue;
        if (round->ranges()[i] >= round->min_range())
          add_echo(*then * orca::plane_pose(round->poses()[i]), round->ranges()[i], round->half_lobe());
      }
      if (beams_.empty()) continue;
      see();
      heard = true;
    }
    return heard;
  }

  // Notes what bumpers touch, which lasers and sonars may overlook: a place as wide as a robot, for a step or a kerb is seldom narrower
  // than the switch that feels it, and a little nearer than that.
  bool feel_bumpers() {
    constexpr double kNearer = 0.05;  // [m]
    if (!bumper_.new_data_arrived()) return false;
    const auto touch = bumper_.get_update();
    const auto then =
        history_.at(orca::to_time_point(touch->stamp())).value_or(*history_.at(history_.newest()));
    bool feels = false;
    for (std::size_t i = 0; i < std::min(touch->pressed().size(), touch->poses().size()); ++i) {
      if (touch->pressed()[i] == 0) continue;
      feels = true;
      for (const double aside : {-0.25, -0.2, -0.15, -0.1, -0.05, 0.0, 0.05, 0.1, 0.15, 0.2, 0.25})
        note_touch(X_WG_ * then * orca::plane_pose(touch->poses()[i]) * Vec2{-kNearer, aside});
    }
    if (feels) hold_touched();
    return feels;
  }

  void note_touch(Vec2 place) {
    const double same = 0.5 * seen_->lattice().side;
    std::erase_if(touched_, [&](const Touched& before) { return norm(before.place - place) < same; });
    touched_.push_back({place, now()});
  }

  // Keeps touched places occupied for a time, although beams pass above them.
  void hold_touched() {
    if (*forget_after_ > 0.0)
      std::erase_if(touched_,
                    [&](const Touched& t) { return orca::to_seconds(now() - t.at) > *forget_after_; });
    for (const Touched& touched : touched_) seen_->hold(seen_from(X_WG_, touched.place));
  }

  // An echo is taken to come from the middle of its cone; the cone is free on both sides up to nine tenths of the way.
  void add_echo(const Pose2& sonar, double range, double half_lobe) {
    const bool echo = range < *sonar_range_;
    const double length = std::min(range, *sonar_range_);
    beams_.push_back({sonar.position(), sonar.position() + length * orca::direction(sonar.yaw), echo});
    for (const double side : {-0.7, -0.35, 0.35, 0.7})
      beams_.push_back({sonar.position(),
                        sonar.position() + 0.9 * length * orca::direction(sonar.yaw + side * half_lobe),
                        false});
  }

  // A smooth wall gives no echo at a grazing angle, so what shows no echo does not clear the walls of the map.
  void end_at_walls() {
    const orca::nav::FloorGrid& map = floor_.grid();
    Lattice walls = map.lattice;
    walls.corner = {};
    for (Beam& beam : beams_) {
      if (beam.echo || map.cells.empty()) continue;
      const Vec2 way = beam.to - beam.from;
      orca::nav::walk_line(walls, beam.from, beam.to, [&](Cell cell) {
        const bool is_wall = walls.holds(cell) && map.occupied(cell);
        const double before = norm(walls.middle_of(cell) - beam.from) - 1.5 * walls.side;
        if (is_wall) beam.to = beam.from + shortened(way, std::max(0.0, before));
        return !is_wall;
      });
    }
  }

  void see() {
    const Lattice& window = seen_->lattice();
    if (!std::exchange(begun_, true) || !window.holds(window.cell_at(robot_))) seen_->reset(robot_);
    seen_->follow(robot_);
    end_at_walls();
    seen_->see(beams_);
    if (std::exchange(doubts_, false)) seen_->clear_along(beams_);
    hold_touched();
  }

  void fade() {
    const orca::Duration every = orca::from_seconds(*forget_after_ / kFadings);
    if (*forget_after_ <= 0.0 || now() - faded_at_ < every) return;
    faded_at_ = now();
    seen_->fade();
  }

  // Returns what is known of a cell of the window: what was seen of late, else what the map says.
  [[nodiscard]] std::uint8_t cell_of(Cell cell, Cell in_map) const {
    const std::size_t index = seen_->lattice().index(cell);
    if (seen_->known(index)) return seen_->occupied(index) ? kOccupied : kFree;
    const auto& map = floor_.grid();
    return map.lattice.holds(in_map) ? map.cells[map.lattice.index(in_map)] : kUnknown;
  }

  // Returns where the window's first cell lies in the map.
  [[nodiscard]] Cell offset() const {
    const Lattice& window = seen_->lattice();
    return {static_cast<int>(std::lround(window.corner.x / window.side)),
            static_cast<int>(std::lround(window.corner.y / window.side))};
  }

  // Returns the cells from `low` to before `high`, counted in the window.
  [[nodiscard]] orca::Loan<OccupancyGrid> cells_of(Cell low, Cell high) {
    const Lattice& window = seen_->lattice();
    const Cell off = offset();
    auto grid = maps_.loan();
    fill_head(*grid, window.corner + window.side * Vec2{double(low.column), double(low.row)},
              {high.column - low.column, high.row - low.row});
    auto cell = grid->cells().begin();
    for (int row = low.row; row < high.row; ++row)
      for (int column = low.column; column < high.column; ++column)
        *cell++ = cell_of({column, row}, {column + off.column, row + off.row});
    return grid;
  }

  void fill_head(OccupancyGrid& grid, Vec2 corner, Cell size) const {
    const Pose2 X_WC = X_WG_ * Pose2{corner.x, corner.y, 0.0};
    grid.name(floor_.grid().cells.empty() ? std::string("seen") : floor_.name());
    grid.corner().x(X_WC.x);
    grid.corner().y(X_WC.y);
    grid.corner().orientation(X_WC.yaw);
    grid.resolution(seen_->lattice().side);
    grid.columns(static_cast<std::uint32_t>(size.column));
    grid.rows(static_cast<std::uint32_t>(size.row));
    grid.cells().resize(static_cast<std::size_t>(size.column) * static_cast<std::size_t>(size.row));
  }

  // Returns the window as far as it lies in the map; all of it without a map.
  [[nodiscard]] orca::Loan<OccupancyGrid> part() {
    const Lattice& window = seen_->lattice();
    const Lattice& map = floor_.grid().lattice;
    Cell low{0, 0};
    Cell high{window.columns, window.rows};
    if (floor_.grid().cells.empty()) return cells_of(low, high);
    const Cell off = offset();
    low = {std::clamp(-off.column, 0, window.columns), std::clamp(-off.row, 0, window.rows)};
    high = {std::clamp(map.columns - off.column, low.column, window.columns),
            std::clamp(map.rows - off.row, low.row, window.rows)};
    return cells_of(low, high);
  }

  // Returns the whole map with what was seen of late.
  [[nodiscard]] orca::Loan<OccupancyGrid> whole() {
    const auto& map = floor_.grid();
    if (map.cells.empty()) return part();
    auto grid = maps_.loan();
    fill_head(*grid, {}, {map.lattice.columns, map.lattice.rows});
    std::ranges::copy(map.cells, grid->cells().begin());
    const Cell off = offset();
    const Lattice& window = seen_->lattice();
    for (std::size_t i = 0; i < window.size(); ++i) {
      const Cell cell = window.cell_of(i);
      const Cell in_map{cell.column + off.column, cell.row + off.row};
      if (map.lattice.holds(in_map)) grid->cells()[map.lattice.index(in_map)] = cell_of(cell, in_map);
    }
    return grid;
  }

  orca::Status on_doubt(const ObjectPtr<orca::idl::Ask>& /*ask*/) {
    doubts_ = true;
    return orca::ok();
  }

  orca::Result<orca::Loan<OccupancyGrid>> on_ask(const ObjectPtr<orca::idl::Ask>& /*ask*/) { return whole(); }

  orca::PushProxy<orca::idl::RobotPose> localizer_{
      *this, "localizer", {.text = "Pose of the robot in the world."}};
  orca::PushProxyArray<LaserRangeReadings> laser_{
      *this, "laser", {.text = "Scans of lasers on the robot.", .optional = true}};
  orca::PushProxyArray<SonarRangeReadings> sonar_{
      *this, "sonar", {.text = "Rounds of sonar rings.", .optional = true}};
  orca::PushProxy<orca::idl::BumperReadings> bumper_{
      *this,
      "bumper",
      {.text = "Bumper switches: what they touch counts for forget_after, whatever looks over it.",
       .optional = true}};
  orca::PushProxy<OccupancyGrid> map_{
      *this, "map", {.text = "The map of the building, as MapServer has it.", .optional = true}};
  orca::QueryServer<orca::idl::Ask, OccupancyGrid> question_{
      *this,
      "OccupancyGridQuery",
      &WorldModel::on_ask,
      {.text = "The whole map, with what was seen of late."}};
  orca::SendServer<orca::idl::Ask> doubt_{
      *this,
      "DoubtSend",
      &WorldModel::on_doubt,
      {.text = "The wish of a robot that finds no way: what the next scan looks through is free, also where "
               "no echo says so."}};
  orca::PushServer<OccupancyGrid> maps_{
      *this,
      "OccupancyGridPush",
      {.text = "After each scan or round the part around the robot; the whole map "
               "for a new subscriber, when that part has moved, and every 2 s."}};
  orca::Param<double> map_size_{*this,
                                "map_size",
                                16.0,
                                {.unit = "m",
                                 .min = 4.0,
                                 .max = 60.0,
                                 .fixed = true,
                                 .text = "Side of the square around the robot that is kept."}};
  orca::Param<double> laser_range_{
      *this,
      "laser_range",
      6.0,
      {.unit = "m", .min = 0.5, .text = "Echoes of lasers that are farther away do not count."}};
  orca::Param<double> sonar_range_{
      *this,
      "sonar_range",
      1.5,
      {.unit = "m", .min = 0.2, .text = "Echoes of sonars that are farther away do not count."}};
  orca::Param<double> forget_after_{
      *this,
      "forget_after",
      60.0,
      {.unit = "s",
       .min = 0.0,
       .text = "Time after which nothing is left of what was seen, and only the map counts; 0: it is kept."}};

  orca::planning::Floor floor_{orca::planning::Floor::kMostToPlan};
  Pose2 X_WG_;                                   // the grid's frame in the world
  std::optional<orca::nav::OccupancyMap> seen_;  // in the grid's frame, as all down to robot_
  orca::nav::PoseHistory history_;
  std::vector<Heard<LaserRangeReadings>> lasers_;
  std::vector<Heard<SonarRangeReadings>> rings_;
  std::vector<Beam> beams_;
  Vec2 robot_;
  std::vector<Touched> touched_;
  bool begun_ = false;                       // something was seen
  bool doubts_ = false;                      // what the next scan looks through is free
  std::optional<orca::TimePoint> whole_at_;  // when the whole map went out; none: not since all was forgotten
  Vec2 pushed_corner_;                       // of the window, then
  orca::TimePoint faded_at_{};
  orca::SenderWatch senders_{host()};
};

}  // namespace

ORCA_COMPONENT(WorldModel, "orca.WorldModel")
