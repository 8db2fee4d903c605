// SPDX-License-Identifier: LGPL-3.0-or-later
#include "odometry_model.hpp"

#include "arc.hpp"

namespace orca::sim::detail {

OdometryModel::OdometryModel(const Drive& drive, const ErrorLevels& errors, RandomStream random)
    : random_(random), slip_(errors.slip), track_(drive.track) {
  believed_track_ = track_ * (1.0 + random_.uniform(-errors.track_error, errors.track_error));
  left_error_ = random_.uniform(-errors.wheel_mismatch, errors.wheel_mismatch);
  right_error_ = random_.uniform(-errors.wheel_mismatch, errors.wheel_mismatch);
}

double OdometryModel::measured(double travel, double diameter_error) {
  return travel * (1.0 + diameter_error) + random_.normal(0.0, slip_ * std::sqrt(std::fabs(travel)));
}

void OdometryModel::add(double travel, double turn, double seconds) {
  const double left = measured(travel - 0.5 * turn * track_, left_error_);
  const double right = measured(travel + 0.5 * turn * track_, right_error_);
  const double believed_travel = 0.5 * (left + right);
  const double believed_turn = (right - left) / believed_track_;
  pose_ = along_arc(pose_, believed_travel, believed_turn);
  velocity_ = {believed_travel / seconds, believed_turn / seconds};
}

}  // namespace orca::sim::detail
