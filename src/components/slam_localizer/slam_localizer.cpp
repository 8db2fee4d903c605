// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "map_entry.hpp"
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
#include "orca/navigation/pose_history.hpp"
#include "orca/navigation/slam.hpp"
#include "session.hpp"
#include "shown_map.hpp"

namespace {

using orca::Pose2;
using orca::idl::LaserRangeReadings;
using orca::idl::OccupancyGrid;
using orca::idl::RobotPose;

/// A localizer without a map: it makes one while the robot drives, and says where the robot is in it (thesis 11.1, SlamLocalizer). The pose
/// that drifts, such as that of an OdometryLocalizer, goes in, and comes out corrected, at the same rate. See README.md.
class SlamLocalizer final : public orca::Component {
 public:
  explicit SlamLocalizer(orca::ComponentHost& host) : Component(host) {}

 private:
  static constexpr double kFastest = 10.0;  // [m/s]
  static constexpr double kRoom = 0.5;      // [m]

  orca::Status configure() override {
    lap_on("drifting");
    if (file_->empty()) return orca::ok();
    const orca::Status opened = session_.open(*file_);
    return opened.ok() ? orca::ok() : orca::Status(file_.refuse(opened.error()));
  }

  // It may begin again on the way, with another client.
  orca::Status start() override {
    history_.clear();
    scans_.clear();
    if (!slam_) begin();
    return orca::ok();
  }

  void stop() override {
    if (slam_) warn_unless(session_.close(*slam_));
  }

  void warn_unless(const orca::Status& kept) {
    if (!kept.ok()) log_warning("the map is not kept for another run: " + kept.error().text());
  }

  // Goes on with the map of the runs before, if there is one.
  void begin() {
    begin_anew();
    auto before = session_.take();
    if (!before) return;
    slam_.emplace(std::move(*before));
    earlier_ = slam_->nodes().size();
    entry_.emplace(*slam_, random("places"), true);
    log_info("it goes on with a map of " + std::to_string(earlier_) +
             " scans as soon as it has found where the robot is in it");
  }

  // The pose must not jump, so the correction stays.
  void begin_anew() {
    slam_.emplace();
    earlier_ = 0;
    map_.begin_anew(now());
    seen_.clear();
    history_.clear();
    scans_.clear();
    X_MI_ = X_MD_;
  }

  orca::Outcome work() override {
    while (laser_.new_data_arrived()) take_scan(laser_.get_update());
    const auto drifting = drifting_.get_update();
    if (!senders_.accepts(*drifting)) return orca::again();
    const Pose2 X_DR = orca::plane_pose(*drifting);
    auto pose = poses_.loan();
    *pose = *drifting;
    if (orca::is_anywhere(drifting->covariance()) ||
        has_jumped(X_DR, orca::to_time_point(drifting->stamp()))) {
      if (slam_) lose();
      pose->covariance(orca::anywhere());
    } else {
      if (!slam_) begin_anew();
      history_.add(orca::to_time_point(drifting->stamp()), X_DR);
      if (const auto scan = scans_.take_until(history_.newest())) lay(*scan, *drifting);
      fill(*drifting, *pose);
      map_.show(slam_->nodes(), now());
      warn_unless(session_.keep(*slam_, now()));
    }
    poses_.push(std::move(pose));
    return orca::again();
  }

  // Whether the drifting pose is elsewhere than a robot can have driven: somebody has said where the robot is.
  [[nodiscard]] bool has_jumped(const Pose2& X_DR, orca::TimePoint stamp) const {
    if (history_.empty()) return false;
    const auto before = history_.at(history_.newest());
    return before && norm(X_DR.position() - before->position()) >
                         kRoom + kFastest * std::max(0.0, orca::to_seconds(stamp - history_.newest()));
  }

  // The sender of the drifting pose has lost the robot: it may go on anywhere else, and in another map.
  void lose() {
    const bool is_new = !history_.empty();
    history_.clear();
    if (session_.is_open() && !slam_->nodes().empty()) {
      if (!is_new) return;
      entry_.emplace(*slam_, random("places"), false);
      log_warning(
          "the pose that the map was made by is not known any more, or was set to another place; the map "
          "goes "
          "on as soon as it is found where the robot is in it");
      return;
    }
    slam_.reset();
    seen_.clear();
    X_MD_ = {};
    log_warning(
        "the map is given up: the pose that it was made by is not known any more, or was set to another "
        "place");
  }

  void take_scan(orca::ObjectPtr<LaserRangeReadings> scan) {
    if (senders_.accepts(*scan)) scans_.add(std::move(scan));
  }

  // Lays a scan on the map. The robot's frame at its first beam is that in which its points are given.
  void lay(const LaserRangeReadings& scan, const RobotPose& drifting) {
    const auto first = history_.at(orca::to_time_point(scan.stamp()));
    const auto last = history_.at(orca::last_beam_of(scan));
    if (!first || !last) return;
    const Pose2 X_RS = orca::plane_pose(scan.pose());
    orca::nav::beams_of({scan.ranges(), scan.min_range(), scan.max_range(), scan.angle_start(),
                         scan.angle_increment(), *first * X_RS, *last * X_RS},
                        *range_, beams_);
    points_.clear();
    for (const orca::nav::Beam& beam : beams_)
      if (beam.echo) points_.push_back(seen_from(*first, beam.to));
    const auto surface = orca::nav::surface_of(points_, X_RS.position());
    if (entry_) {
      const double time = orca::to_seconds(orca::to_time_point(scan.stamp()).time_since_epoch());
      look_about({1, X_RS.position(), surface, scan.ranges().size()}, {time, *first, drifting.covariance()});
    } else {
      X_MD_ = slam_->see(surface, X_MI_ * *first, X_RS.position()) * inverse(*first);
    }
    seen_.resize(slam_->nodes().size() - earlier_, orca::to_time_point(scan.stamp()));
  }

  // Looks where the robot is in the map of the runs before, and goes on with that map when it is sure.
  void look_about(const orca::nav::RobotScan& scan, const orca::nav::Reckoned& taken) {
    entry_->move(taken);
    entry_->see(scan);
    const auto where = entry_->where(taken);
    if (!where || !entry_->is_sure()) return;
    X_MD_ = X_MI_ = where->mean * inverse(taken.X_OR);
    slam_->enter(scan.echoes, where->mean, where->mean, scan.from);
    entry_.reset();
    log_info("it has found where the robot is, and the map goes on");
  }

  orca::Result<orca::Loan<orca::idl::Path>> on_way(const orca::ObjectPtr<orca::idl::Ask>& /*ask*/) {
    auto path = orca::make_object<orca::idl::Path>();
    path->name("way so far");
    for (std::size_t i = 0; i < seen_.size(); ++i)
      path->poses().push_back(orca::level_pose(slam_->nodes()[earlier_ + i].X_MR, 0.0, seen_[i]));
    return path;
  }

  void fill(const RobotPose& drifting, RobotPose& pose) {
    const Pose2 X_DR = orca::plane_pose(drifting);
    orca::nav::PoseSpread where{X_MD_ * X_DR, orca::anywhere()};
    if (entry_) {
      const double time = orca::to_seconds(orca::to_time_point(drifting.stamp()).time_since_epoch());
      where = entry_->where({time, X_DR, drifting.covariance()}).value_or(where);
    } else {
      where.covariance = orca::nav::covariance_of(slam_->known_at(X_MI_ * X_DR), where.mean.yaw);
    }
    pose.x(where.mean.x);
    pose.y(where.mean.y);
    pose.orientation(orca::wrapped(where.mean.yaw));
    pose.covariance(where.covariance);
  }

  orca::Result<orca::Loan<OccupancyGrid>> on_map(const orca::ObjectPtr<orca::idl::Ask>& /*ask*/) {
    if (!slam_)
      return orca::fail(orca::Code::failed_precondition,
                        "there is no map: the drifting pose is not known, so the map that was made by it is "
                        "given up; the next known pose begins another");
    if (slam_->nodes().empty())
      return orca::fail(orca::Code::failed_precondition,
                        "there is no map yet: no scan has come at laser that a pose at drifting belongs to");
    return map_.whole();
  }

  void save_state(orca::StateWriter& state) const override { state.write(X_MD_); }
  orca::Status load_state(orca::StateReader& state) override {
    orca::Status read = state.read(X_MD_);
    if (!entry_) begin_anew();
    return read;
  }

  orca::SenderWatch senders_{host()};
  std::optional<orca::nav::Slam> slam_;
  orca::slam::Session session_;
  std::optional<orca::slam::MapEntry> entry_;  // while it looks where the robot is in that map
  std::size_t earlier_ = 0;                    // nodes of the runs before
  std::vector<orca::TimePoint> seen_;          // stamps of the nodes since
  orca::nav::PoseHistory history_;
  orca::WaitingScans scans_;
  Pose2 X_MD_;  // the frame in which the pose drifts, in the map's
  Pose2 X_MI_;  // the same when the map was begun
  std::vector<orca::nav::Beam> beams_;
  std::vector<orca::Vec2> points_;
  orca::PushProxy<RobotPose> drifting_{
      *this, "drifting", {.text = "Pose of the robot that drifts, such as that of an OdometryLocalizer."}};
  orca::PushProxy<LaserRangeReadings> laser_{*this, "laser", {.text = "Scans of the laser."}};
  orca::PushServer<RobotPose> poses_{
      *this,
      "RobotPosePush",
      {.text = "Pose of the robot in the map, once per lap; the map begins where the drifting pose did."}};
  orca::slam::ShownMap map_{*this};
  orca::QueryServer<orca::idl::Ask, OccupancyGrid> map_question_{
      *this,
      "OccupancyGridQuery",
      &SlamLocalizer::on_map,
      {.text = "The whole map as it is now: about is not read."}};
  orca::QueryServer<orca::idl::Ask, orca::idl::Path> way_{
      *this,
      "PathQuery",
      &SlamLocalizer::on_way,
      {.text = "Where the robot was at the scans that the map is made of, with their stamps, as it is known "
               "now."}};
  orca::Param<std::string> file_{
      *this,
      "session",
      "",
      {.file = true,
       .fixed = true,
       .text = "File that keeps the map from one run to the next, which goes on with it; empty: none."}};
  orca::Param<double> range_{
      *this,
      "map_range",
      20.0,
      {.unit = "m", .min = 1.0, .max = 100.0, .text = "Echoes that are farther away do not count."}};
};

}  // namespace

ORCA_COMPONENT(SlamLocalizer, "orca.SlamLocalizer")
