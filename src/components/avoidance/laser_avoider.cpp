// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/laser_avoider.hpp"

#include <algorithm>
#include <numbers>

#include "orca/avoidance/scan.hpp"
#include "orca/geometry/objects/own_beams.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::avoid {
namespace {

// While the robot stands, what it has seen beside its back stays true but for what moves: turning must not begin to look free.
constexpr double kStandingPace = 0.1;
// With a thousandth of another's wish to drive on, a robot that has centimetres to its sides creeps into them within half a minute.
constexpr double kHardlyYields = 1e-5;
// [m] Echoes as near to each other as that are one, if those beside what is seen must not be drawn into it.
constexpr double kErrorOfReading = 0.01;
constexpr double kSector = std::numbers::pi / 36;
// So much beside the circle a body may come to within a few readings, and its corners must know the shape of what is there: to a
// centimetre, as well as a reading shows it.
constexpr double kBesideBody = 0.25;  // [m]
constexpr double kFineSector = std::numbers::pi / 120;

}  // namespace

LaserAvoider::LaserAvoider(ComponentHost& host, Memory memory)
    : Avoider(host, {.echo_time = memory.time,
                     .memory_time = memory.time,
                     .standing_pace = memory.shapes ? kStandingPace : Manner().standing_pace,
                     .yields = memory.shapes ? kHardlyYields : Manner().yields}),
      remembers_(memory),
      squeeze_(
          *this, "squeeze", true,
          {.text =
               "Whether the robot passes where half its width finds room if its circle finds no way nearby; "
               "otherwise only where its circle does."}),
      robot_length_(
          *this, "robot_length", 0.0,
          {.unit = "m",
           .min = 0.0,
           .text =
               "Length of a robot that is longer than wide, unless the base says it; 0: the circle is all."}),
      robot_width_(*this, "robot_width", 0.0, {.unit = "m", .min = 0.0, .text = "Its width."}) {}

std::optional<Rectangle> LaserAvoider::body() const {
  if (!*squeeze_) return std::nullopt;
  const std::optional<Rectangle> described = described_body();
  return described ? described : rectangle(*robot_length_, *robot_width_);
}

Limits LaserAvoider::with_body(std::span<const Vec2> echoes, const Situation& situation,
                               Limits limits) const {
  limits.body = body();
  limits.squeezes = limits.body && should_squeeze(echoes, situation, limits);
  return limits;
}

const ObjectType& LaserAvoider::sensed() const { return object_type<idl::LaserRangeReadings>(); }

Status LaserAvoider::configure() {
  if (!remembers() && !more_lasers_.sources().empty())
    return fail(Code::failed_precondition,
                "with further lasers, connect its port odometry too: their scans come at other times");
  return Avoider::configure();
}

Status LaserAvoider::start() {
  further_.clear();
  for (const MoreLasers::Source& source : more_lasers_.sources()) (void)further(source);
  return Avoider::start();
}

void LaserAvoider::stop() {
  more_lasers_.unsubscribe_all();
  Avoider::stop();
}

bool LaserAvoider::listen(EchoMemory& memory) {
  const auto scan = laser_.get_update();
  const bool counts = put_into(memory, *scan, 0);
  if (counts) ahead_ = check_looks_ahead(*scan).ok();
  return counts;
}

// Sources of other processes come, and all of them may go, while the robot drives.
void LaserAvoider::listen_aside(EchoMemory& memory) {
  for (const MoreLasers::Source& source : more_lasers_.sources()) {
    Further& laser = further(source);
    if (!source.new_data_arrived()) continue;
    const auto scan = source.take_latest();
    const bool counts = put_into(memory, *scan, laser.number);
    laser.ahead = counts && check_looks_ahead(*scan).ok();
    laser.heard = counts ? std::optional(now()) : std::nullopt;
  }
}

bool LaserAvoider::is_heard(const MoreLasers::Source& source, double longest) const {
  const auto laser = std::ranges::find(further_, source, &Further::source);
  return laser != further_.end() && laser->heard && to_seconds(now() - *laser->heard) <= longest;
}

// One that has been disconnected looks nowhere any more.
bool LaserAvoider::looks_ahead() const {
  const std::vector<MoreLasers::Source> sources = more_lasers_.sources();
  return ahead_ || std::ranges::any_of(further_, [&](const Further& laser) {
           return laser.ahead && std::ranges::find(sources, laser.source) != sources.end();
         });
}

bool LaserAvoider::hears_aside(double longest) const {
  return looks_ahead() && std::ranges::all_of(more_lasers_.sources(), [&](const MoreLasers::Source& source) {
           return is_heard(source, longest);
         });
}

std::string LaserAvoider::silent_aside(double longest) const {
  for (const MoreLasers::Source& source : more_lasers_.sources())
    if (!is_heard(source, longest)) return "nothing valid comes from " + source.path();
  if (!looks_ahead())
    return "none of its lasers looks ahead; is the rpy of the laser's joint in the robot's file right?";
  return {};
}

bool LaserAvoider::is_covered() {
  const auto covered = [](const auto& scan) { return scan && orca::is_covered(*scan); };
  return covered(laser_.latest()) ||
         std::ranges::any_of(more_lasers_.sources(),
                             [&](const MoreLasers::Source& source) { return covered(source.latest()); });
}

std::string LaserAvoider::what_holds() {
  const auto rectangle = described_body();
  const RobotOutline robot{radius(), rectangle ? 2.0 * rectangle->half_length : 0.0,
                           rectangle ? 2.0 * rectangle->half_width : 0.0};
  std::vector<ObjectPtr<idl::LaserRangeReadings>> scans{laser_.latest()};
  for (const MoreLasers::Source& source : more_lasers_.sources()) scans.push_back(source.latest());
  for (const auto& scan : scans) {
    const std::string beams = scan ? beams_at_robot(*scan, robot) : "";
    if (!beams.empty()) return "of the laser \"" + scan->origin() + "\" " + beams;
  }
  return {};
}

LaserAvoider::Further& LaserAvoider::further(const MoreLasers::Source& source) {
  const auto known = std::ranges::find(further_, source, &Further::source);
  if (known != further_.end()) return *known;
  source.subscribe();
  return further_.emplace_back(Further{source, static_cast<std::uint32_t>(further_.size()) + 1});
}

// The scan was taken a moment ago, from the robot's pose at that time.
bool LaserAvoider::put_into(EchoMemory& memory, const idl::LaserRangeReadings& readings,
                            std::uint32_t number) {
  const TimePoint seen = to_time_point(readings.stamp());
  if (!is_valid(readings) || !is_valid(readings, check_view_ahead(readings)) ||
      !is_valid(readings, check_age(age_of(seen), deaf_after())))
    return false;
  const Pose2 mount = plane_pose(readings.pose());
  const double age = age_of(seen);
  const Vec2 place = moved_since(mount.position(), age);
  const double yaw = mount.yaw - turned_since(age);
  const Scan scan{readings.ranges(),      readings.min_range(),       readings.max_range(),
                  readings.angle_start(), readings.angle_increment(), {place.x, place.y, yaw}};
  note_floor(scan);
  EchoMemory::Limits kept = keep();
  kept.sensor = number;
  kept.hidden = remembers_.hidden;
  if (remembers_.hidden || remembers_.shapes) kept.no_news = kErrorOfReading;
  const auto corners = remembers_.shapes ? body() : std::nullopt;
  const double near = corners ? norm({corners->half_length, corners->half_width}) + kBesideBody : 0.0;
  const double range = std::max(farthest(), remembers_.range);
  see(scan, {.sector = kSector, .range = range, .near = near, .fine = kFineSector}, kept, memory);
  return true;
}

}  // namespace orca::avoid
