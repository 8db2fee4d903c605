// SPDX-License-Identifier: LGPL-3.0-or-later
#include "last_place.hpp"

#include <bit>
#include <chrono>
#include <cmath>
#include <span>
#include <utility>

#include "orca/base/files/own_folder.hpp"
#include "orca/base/hash.hpp"
#include "orca/component/state.hpp"

namespace orca::localizer {
namespace {

const StateTag kTag{"orca.Localizer place", 1};

// Maps are the same if all their cells are, whatever they are called.
std::uint64_t hash_of(const planning::Floor& floor) {
  const nav::Lattice& lattice = floor.grid().lattice;
  Fnv1a hash;
  for (const double value : {lattice.corner.x, lattice.corner.y, lattice.side, floor.X_WM().yaw})
    hash.add_u64(std::bit_cast<std::uint64_t>(value));
  hash.add_u64(static_cast<std::uint64_t>(lattice.columns));
  hash.add(std::as_bytes(std::span(floor.grid().cells)));
  return hash.value();
}

bool is_about(const Pose2& a, const Pose2& b) {
  constexpr double kWay = 0.1;   // [m]
  constexpr double kTurn = 0.1;  // [rad]
  return norm(a.position() - b.position()) < kWay && std::fabs(wrapped(a.yaw - b.yaw)) < kTurn;
}

bool is_sound(const nav::PoseSpread& where) {
  const auto& variances = where.covariance;
  const double sum =
      where.mean.x + where.mean.y + where.mean.yaw + variances[0] + variances[4] + variances[8];
  return std::isfinite(sum) && variances[0] > 0.0 && variances[4] > 0.0 && variances[8] > 0.0;
}

}  // namespace

Status LastPlace::open(const std::string& name) {
  const std::string folder = OwnFolder::path_for_state();
  if (folder.empty())
    return fail(Code::unavailable,
                "there is no folder in which it could be kept: neither XDG_STATE_HOME nor HOME is set");
  file_.emplace(folder + "/kept/" + name + ".pose", "localizer_pose");
  const auto bytes = file_->read();
  if (!bytes) return bytes.error();
  if (!*bytes) return ok();
  Kept kept;
  StateReader reader(kTag, **bytes);
  (void)reader.read(kept);
  if (Status read = reader.finish(); !read.ok()) return read;
  if (!is_sound(kept.where)) return fail(Code::data_loss, "the pose in it says nothing valid", file_->path());
  before_ = kept;
  return ok();
}

Result<nav::PoseSpread> LastPlace::take(const planning::Floor& floor) {
  Kept kept = *std::exchange(before_, std::nullopt);
  if (kept.map != map_of(floor))
    return fail(Code::failed_precondition, "it is a place in another map, called \"" + kept.map_name +
                                               "\"; the one that is there now is \"" + floor.name() + "\"");
  for (const std::size_t i : {0U, 4U, 8U}) kept.where.covariance[i] += 0.04;
  return kept.where;
}

std::uint64_t LastPlace::map_of(const planning::Floor& floor) {
  if (!map_) map_ = hash_of(floor);
  return *map_;
}

Status LastPlace::keep(const planning::Floor& floor, const nav::PoseSpread& where, TimePoint now) {
  constexpr Duration kPeriod = std::chrono::seconds(1);
  if (!file_) return ok();
  latest_ = where;
  if (written_ && (is_about(written_->mean, where.mean) || now - written_at_ < kPeriod)) return ok();
  written_at_ = now;
  return write(floor);
}

Status LastPlace::close(const planning::Floor& floor) { return latest_ ? write(floor) : ok(); }

Status LastPlace::write(const planning::Floor& floor) {
  written_ = latest_;
  StateWriter writer;
  writer.write(Kept{floor.name(), map_of(floor), *latest_});
  const Result<OwnFolder> folder = OwnFolder::make_for_components();
  const Status done = folder ? file_->write(writer.bytes()) : Status(folder.error());
  return std::exchange(fails_, !done.ok()) ? ok() : done;
}

}  // namespace orca::localizer
