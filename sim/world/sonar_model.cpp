// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sonar_model.hpp"

#include <algorithm>
#include <utility>

namespace orca::sim::detail {
namespace {

Pose2 between(const Pose2& a, const Pose2& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrapped(a.yaw + share * wrapped(b.yaw - a.yaw))};
}

double share_of(const SonarModel::Span& span, TimePoint t) {
  return to_seconds(t - span.from) / to_seconds(span.to - span.from);
}

}  // namespace

SonarModel::SonarModel(SonarRing ring, const ErrorLevels& errors, RandomStream random, TimePoint start)
    : ring_(std::move(ring)), errors_(errors), random_(random), round_start_(start) {
  scan_.readings.resize(ring_.count);
}

// The last transducer of a round fires exactly at its end.
TimePoint SonarModel::next_due() const {
  const auto number = static_cast<std::int64_t>(fired_) + 1;
  return round_start_ + Duration{ring_.period.count() * number / static_cast<std::int64_t>(ring_.count)};
}

void SonarModel::run(const Caster& caster, std::size_t own_body, const Span& span) {
  completed_.reset();
  for (TimePoint due = next_due(); due <= span.to; due = next_due()) {
    fire(caster, own_body, between(span.X_from, span.X_to, share_of(span, due)), due);
    if (fired_ < ring_.count) continue;
    completed_ = scan_;
    fired_ = 0;
    round_start_ += ring_.period;
  }
}

void SonarModel::fire(const Caster& caster, std::size_t own_body, const Pose2& X_WB, TimePoint stamp) {
  const std::size_t k = ring_.order[fired_++];
  const Pose2 sensor = ring_.transducer(k);
  const Beam beam{X_WB * sensor, ring_.half_lobe, ring_.max_range, ring_.height, own_body};
  SonarReading reading = measured(first_echo(caster, beam, errors_.critical_angle));
  reading.transducer = k;
  reading.stamp = stamp;
  reading.sensor = sensor;
  scan_.readings[k] = reading;
}

SonarReading SonarModel::measured(std::optional<double> echo) {
  // Drawn for every reading, needed or not, so that one echo more does not shift all later noise.
  const bool outlier = random_.chance(errors_.sonar_outliers);
  const double anywhere = random_.uniform(ring_.min_range, ring_.max_range);
  const double noise = random_.normal(0.0, errors_.sonar_noise);
  SonarReading reading;
  reading.echo = echo.has_value() || outlier;
  if (!reading.echo) {
    reading.range = ring_.max_range;
    return reading;
  }
  double range = outlier ? anywhere : *echo * (1.0 + noise);
  if (errors_.quantised && ring_.quantum > 0.0) range = std::round(range / ring_.quantum) * ring_.quantum;
  reading.range = std::clamp(range, ring_.min_range, ring_.max_range);
  return reading;
}

}  // namespace orca::sim::detail
