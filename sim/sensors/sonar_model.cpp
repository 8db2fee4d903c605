// SPDX-License-Identifier: LGPL-3.0-or-later
#include "sonar_model.hpp"

#include <algorithm>
#include <utility>

#include "orca/base/portable_math.hpp"

namespace orca::sim::detail {

SonarModel::SonarModel(SonarRing ring, const ErrorLevels& errors, RandomStream random, TimePoint start)
    : ring_(std::move(ring)),
      lobe_(ring_.half_lobe, errors),
      errors_(errors),
      critical_tangent_(portable::tan(errors.critical_angle)),
      random_(random),
      round_start_(start) {
  for (std::size_t k = 0; k < ring_.count; ++k) transducers_.push_back(ring_.transducer(k));
  // Nothing is drawn where none can be dead, so that the noise stays as it is.
  for (std::size_t k = 0; k < ring_.count; ++k)
    dead_.push_back(errors.sonar_dead > 0.0 && random_.chance(errors.sonar_dead));
  scan_.readings.resize(ring_.count);
}

// Returns the time at which the next transducers fire. The last of a round fire exactly at its end.
TimePoint SonarModel::next_due() const {
  const auto slots = static_cast<std::int64_t>((ring_.count + ring_.parallel - 1) / ring_.parallel);
  const auto slot = static_cast<std::int64_t>(fired_ / ring_.parallel) + 1;
  return round_start_ + Duration{ring_.period.count() * slot / slots};
}

void SonarModel::fire(const Caster& caster, std::size_t own_body, const TickSpan& span) {
  shot_count_ = 0;
  for (TimePoint due = next_due(); due <= span.to; due = next_due()) {
    const std::size_t k = ring_.order[fired_++];
    Shot& shot = next_shot();
    shot.transducer = k;
    shot.is_dead = dead_[k];
    shot.time = due;
    shot.beam.emplace(span.at(due) * transducers_[k], lobe_, ring_.min_range, ring_.max_range,
                      ring_.height_of(k), own_body);
    shot.X_RB = span.in_robot(due);
    shot.X_RS = shot.X_RB * transducers_[k];
    if (!shot.is_dead) listen_for(caster, *shot.beam, critical_tangent_, shot.echo);
    if (fired_ < ring_.count) continue;
    fired_ = 0;
    round_start_ += ring_.period;
  }
}

SonarModel::Shot& SonarModel::next_shot() {
  if (shot_count_ == shots_.size()) shots_.emplace_back();
  return shots_[shot_count_++];
}

void SonarModel::send(SonarAir& air) {
  if (!errors_.sonar_crosstalk) return;  // Then nobody in the world listens to others.
  for (Shot& shot : shots())
    if (!shot.is_dead) shot.chirp = air.send(shot.time, *shot.beam, shot.echo);
}

void SonarModel::listen(const Caster& caster, const SonarAir& air) {
  completed_.reset();
  for (const Shot& shot : shots()) {
    SonarReading reading = measured(heard(shot, caster, air));
    if (shot.is_dead) {
      reading.echo = false;
      reading.range = ring_.max_range;
    }
    reading.transducer = shot.transducer;
    reading.stamp = shot.time;
    reading.sensor = shot.X_RS;
    scan_.readings[shot.transducer] = reading;
    if (listened_ == 0) {
      scan_.stamp = shot.time;
      scan_.X_RB = shot.X_RB;
    }
    if (++listened_ < ring_.count) continue;
    completed_ = scan_;
    listened_ = 0;
  }
}

std::optional<double> SonarModel::heard(const Shot& shot, const Caster& caster, const SonarAir& air) {
  if (shot.is_dead) return std::nullopt;
  const bool deaf_to_others = !errors_.sonar_crosstalk;
  return deaf_to_others ? shot.echo.range : air.first_heard(caster, shot.chirp, shot.echo, search_);
}

SonarReading SonarModel::measured(std::optional<double> echo) {
  // The numbers are drawn for every reading, needed or not, so that one more echo does not shift all later
  // noise.
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
