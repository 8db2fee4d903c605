// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/realism.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::sim {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();
constexpr double kRightAngle = 0.5 * std::numbers::pi;
constexpr double kMostFactor = 100.0;

struct Named {
  std::string_view name;
  double ErrorLevels::*value;
  double most = kUnlimited;
};

constexpr std::array kErrors{Named{"wheel_mismatch", &ErrorLevels::wheel_mismatch},
                             Named{"wheel_size", &ErrorLevels::wheel_size},
                             Named{"track_error", &ErrorLevels::track_error},
                             Named{"slip", &ErrorLevels::slip},
                             Named{"turn_slip", &ErrorLevels::turn_slip},
                             Named{"common_slip", &ErrorLevels::common_slip},
                             Named{"delay_scale", &ErrorLevels::delay_scale},
                             Named{"sonar_noise", &ErrorLevels::sonar_noise},
                             Named{"sonar_outliers", &ErrorLevels::sonar_outliers, 1.0},
                             Named{"critical_angle", &ErrorLevels::critical_angle, kRightAngle},
                             Named{"laser_bias", &ErrorLevels::laser_bias},
                             Named{"laser_sigma", &ErrorLevels::laser_sigma},
                             Named{"laser_drop_angle", &ErrorLevels::laser_drop_angle, kRightAngle},
                             Named{"laser_threshold", &ErrorLevels::laser_threshold},
                             Named{"infrared_noise", &ErrorLevels::infrared_noise},
                             Named{"slip_length", &ErrorLevels::slip_length},
                             Named{"common_length", &ErrorLevels::common_length},
                             Named{"slip_angle", &ErrorLevels::slip_angle},
                             Named{"sonar_edges", &ErrorLevels::sonar_edges, 1.0},
                             Named{"sonar_threshold", &ErrorLevels::sonar_threshold, 1.0},
                             Named{"sonar_in_line", &ErrorLevels::sonar_in_line, kRightAngle},
                             Named{"laser_spot", &ErrorLevels::laser_spot},
                             Named{"contact_friction", &ErrorLevels::contact_friction},
                             Named{"wheel_grip", &ErrorLevels::wheel_grip},
                             Named{"motor_force", &ErrorLevels::motor_force}};

Error unknown(std::string_view name) {
  std::vector<std::string> names;
  for (const Named& error : kErrors) names.emplace_back(error.name);
  return fail(Code::invalid_argument,
              in_quotes(name) + " is no error of a level and no estimate; there are: " +
                  listed(names, names.size()) + xml::did_you_mean(xml::nearest_name(name, names)));
}

Status scale(ErrorLevels& levels, std::string_view word) {
  const std::size_t sign = word.find('=');
  const std::string_view name = xml::trimmed(word.substr(0, sign));
  const auto error = std::ranges::find(kErrors, name, &Named::name);
  if (error == kErrors.end()) return unknown(name);
  const Result<double> factor =
      xml::parse_number(sign == std::string_view::npos ? "" : xml::trimmed(word.substr(sign + 1)));
  if (!factor || *factor < 0.0 || *factor > kMostFactor)
    return fail(Code::invalid_argument, std::string(name) + " expects a factor from 0 to 100, as in " +
                                            std::string(name) + "=2, found " + in_quotes(word));
  double& value = levels.*(error->value);
  value = std::min(value * *factor, error->most);
  return ok();
}

}  // namespace

ErrorLevels error_levels(Realism realism) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  switch (realism) {
    case Realism::ideal: return {};
    case Realism::nominal:
      return {.wheel_mismatch = 0.005,
              .wheel_size = 0.0025,
              .track_error = 0.01,
              .slip = 0.003,
              .turn_slip = 0.003,
              .delay_scale = 1.0,
              .sonar_noise = 0.01,
              .sonar_outliers = 0.01,
              .critical_angle = 25.0 * kDegree,
              .sonar_crosstalk = true,
              .laser_bias = 0.01,
              .laser_sigma = 0.005,
              .laser_drop_angle = 80.0 * kDegree,
              .laser_threshold = 0.64,
              .mixed_pixels = true,
              .infrared_noise = 0.05,
              .quantised = true};
    case Realism::harsh:
      return {.wheel_mismatch = 0.01,
              .wheel_size = 0.005,
              .track_error = 0.02,
              .slip = 0.01,
              .turn_slip = 0.01,
              .delay_scale = 1.5,
              .sonar_noise = 0.02,
              .sonar_outliers = 0.05,
              .critical_angle = 20.0 * kDegree,
              .sonar_crosstalk = true,
              .laser_bias = 0.02,
              .laser_sigma = 0.01,
              .laser_drop_angle = 75.0 * kDegree,
              .laser_threshold = 1.28,
              .mixed_pixels = true,
              .infrared_noise = 0.1,
              .quantised = true};
    case Realism::recorded: {
      ErrorLevels levels = error_levels(Realism::nominal);
      levels.wheel_mismatch = 0.03;
      levels.wheel_size = 0.05;
      levels.slip = 0.0075;
      levels.turn_slip = 0.022;
      levels.common_slip = 0.09;
      return levels;
    }
  }
  return {};
}

Result<ErrorLevels> scaled(ErrorLevels levels, std::string_view factors) {
  for (const std::string_view word : xml::split(factors, ";")) {
    if (word.empty()) continue;
    if (const Status done = scale(levels, word); !done.ok()) return done.error();
  }
  return levels;
}

}  // namespace orca::sim
