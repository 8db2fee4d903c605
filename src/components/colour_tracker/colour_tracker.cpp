// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <deque>
#include <string>

#include "colour_finder.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/navigation/pose_history.hpp"
#include "track.hpp"

namespace {

using orca::colour::Picture;
using orca::colour::Sighting;

constexpr double kLeastError = 0.03;  // [m] of a sighting,
constexpr double kErrorShare = 0.04;  // and as a share of the distance.
constexpr double kMoverError = 0.1;   // [m] of where somebody else sees somebody.
constexpr double kFresh = 0.3;        // [s] older news of that does not count.
constexpr double kBeside = 0.5;       // [m] Somebody so near to where the thing should be is taken for it,
constexpr double kAside = 0.35;       // [m] and who is so little beside the line of sight to it,
constexpr double kAhead = 1.0;        // [m] and before or behind where it is seen.

// Checks whether the colour can be looked for in a picture.
orca::Status check_picture(const orca::idl::Image& image) {
  const auto fail = [](const char* why) { return orca::fail(orca::Code::invalid_argument, why); };
  if (image.encoding() != orca::idl::RGB8)
    return fail("colours are looked for in RGB8 only; set the encoding of the camera");
  if (!(image.focal_length() > 0.0))
    return fail(
        "it does not say its focal length, so directions are not known; set the camera's field_of_view");
  if (image.width() == 0 || image.step() / 3 < image.width() ||
      image.data().size() / std::max(1U, image.step()) < image.height())
    return fail("it has less data than its size asks for");
  return orca::ok();
}

/// Reports where something of one colour is, from the pictures of a camera. See README.md.
class ColourTracker final : public orca::Component {
 public:
  explicit ColourTracker(orca::ComponentHost& host) : Component(host) {}

 private:
  /// A picture, of which only what it shows is kept until the robot's pose is known.
  struct Look {
    orca::idl::TimeValue stamp{};
    orca::Pose2 camera{};  ///< In the robot's frame.
    std::optional<Sighting> sighting{};
  };
  static constexpr std::size_t kMostWaiting = 32;

  orca::Status configure() override {
    const orca::Result<orca::Colour> colour = orca::parse_colour(*colour_);
    if (!colour) return colour_.refuse(colour.error());
    wanted_ = *colour;
    lap_on(image_);
    return orca::ok();
  }

  orca::Status start() override {
    forget();
    return orca::ok();
  }

  orca::Outcome work() override {
    while (odometry_.new_data_arrived()) follow(*odometry_.get_update());
    while (image_.new_data_arrived()) look(*image_.get_update());
    while (!looks_.empty() && !history_.empty() &&
           orca::to_time_point(looks_.front().stamp) <= history_.newest()) {
      report(looks_.front());
      looks_.pop_front();
    }
    return orca::again();
  }

  void forget() {
    history_.clear();
    looks_.clear();
    track_.clear();
  }

  void follow(const orca::idl::Odometry& odometry) {
    if (!senders_.accepts(odometry)) return;
    if (odometer_.begins_anew(odometry)) forget();  // all lies elsewhere now
    history_.add(orca::to_time_point(odometry.stamp()), orca::plane_pose(odometry));
  }

  void look(const orca::idl::Image& image) {
    if (!senders_.accepts(check_picture(image), "Image", image.origin())) return;
    const Picture picture{{image.data().data(), image.data().size()},
                          image.width(),
                          image.height(),
                          image.step(),
                          image.focal_length()};
    if (looks_.size() == kMostWaiting) looks_.pop_front();  // the odometry is silent
    looks_.push_back({image.pose().stamp(), orca::plane_pose(image.pose()),
                      find_colour(picture, {wanted_, *radius_, *height_, image.pose().position().z()})});
  }

  // The colour says who it is; where he is, a laser knows better, if it sees him.
  void report(const Look& look) {
    const auto stamp = orca::to_time_point(look.stamp);
    const double time = orca::to_seconds(stamp.time_since_epoch());
    const auto robot = history_.at(stamp);
    track_.miss(time);
    if (look.sighting && robot && look.sighting->distance < *range_) {
      see(*look.sighting, *robot * look.camera, time);
    } else if (track_.is_there()) {
      const auto off = [&](orca::Vec2 place) { return norm(place - track_.place()); };
      if (const auto mover = mover_at(time, off, kBeside + 2.0 * track_.place_error()))
        track_.see(*mover, kMoverError, time);
    }
    push(look.stamp);
  }

  void see(const Sighting& sighting, const orca::Pose2& camera, double time) {
    const orca::Vec2 way = orca::direction(camera.yaw + sighting.bearing);
    const auto off = [&](orca::Vec2 place) {
      const orca::Vec2 from_camera = place - camera.position();
      return orca::portable::hypot(cross(way, from_camera) / kAside,
                                   (dot(way, from_camera) - sighting.distance) / kAhead);
    };
    if (const auto mover = mover_at(time, off, 1.0)) {
      track_.see(*mover, kMoverError, time);
    } else {
      const double error = std::max(kLeastError, kErrorShare * sighting.distance);
      const orca::Vec2 place = camera.position() + sighting.distance * way;
      if (!track_.admits(place, error)) return;
      if (track_.unseen() > orca::colour::Track::kDoubt) track_.clear();
      track_.see(place, error, time);
    }
  }

  // Returns where somebody is, as somebody else sees it, for whom `off` is least and at most `limit`.
  template <class Off>
  std::optional<orca::Vec2> mover_at(double time, const Off& off, double limit) {
    const auto moving = others_.latest();
    if (!moving) return std::nullopt;
    const double later = time - orca::to_seconds(orca::to_time_point(moving->stamp()).time_since_epoch());
    if (std::fabs(later) > kFresh ||
        !senders_.accepts(orca::check_reading(*moving), "MovingThings", moving->origin()))
      return std::nullopt;
    std::optional<orca::Vec2> best;
    for (const orca::idl::MovingThing& thing : moving->things()) {
      const orca::Vec2 place{thing.x() + later * thing.velocity_x(), thing.y() + later * thing.velocity_y()};
      if (thing.unseen() > kFresh || off(place) > limit) continue;
      limit = off(place);
      best = place;
    }
    return best;
  }

  void push(const orca::idl::TimeValue& stamp) {
    auto moving = moving_.loan();
    moving->things().clear();
    if (track_.is_there()) moving->things().push_back(thing());
    moving->stamp(stamp);
    moving_.push(std::move(moving));
  }

  [[nodiscard]] orca::idl::MovingThing thing() const {
    orca::idl::MovingThing thing;
    thing.number(1);
    thing.x(track_.place().x);
    thing.y(track_.place().y);
    thing.velocity_x(track_.velocity().x);
    thing.velocity_y(track_.velocity().y);
    thing.radius(*radius_);
    thing.place_error(track_.place_error());
    thing.velocity_error(track_.velocity_error());
    thing.unseen(track_.unseen());
    return thing;
  }

  orca::PushProxy<orca::idl::Odometry> odometry_{
      *this, "odometry", {.text = "Motion of the robot.", .depth = 16}};
  orca::PushProxy<orca::idl::Image> image_{
      *this, "image", {.text = "Pictures of a level camera: RGB8, with their focal length."}};
  orca::PushProxy<orca::idl::MovingThings> others_{
      *this,
      "moving",
      {.text = "Who moves near the robot, as a laser sees it (PersonTracker): one of these is the thing, or "
               "may be while the camera does not see it.",
       .optional = true}};
  orca::PushServer<orca::idl::MovingThings> moving_{
      *this,
      "MovingThingsPush",
      {.text = "The thing, if it is in sight, as of each picture, in the frame of the odometry."}};
  orca::Param<std::string> colour_{
      *this,
      "colour",
      "#ff7a00",
      {.fixed = true,
       .text = "Colour of the thing: # and two hexadecimal digits each of red, green and blue."}};
  orca::Param<double> radius_{*this,
                              "radius",
                              0.25,
                              {.unit = "m",
                               .min = 0.01,
                               .max = 2.0,
                               .text = "Half the width of the thing, which tells how far it is."}};
  orca::Param<double> height_{
      *this,
      "height",
      1.7,
      {.unit = "m", .min = 0.01, .max = 5.0, .text = "Height of the thing, which stands on the floor."}};
  orca::Param<double> range_{
      *this,
      "range",
      8.0,
      {.unit = "m", .min = 0.5, .text = "Distance beyond which it counts as out of sight."}};

  orca::Colour wanted_;
  orca::SenderWatch senders_{host()};
  orca::SenderLife odometer_;
  orca::nav::PoseHistory history_;  // in the frame of the odometry
  std::deque<Look> looks_;          // the oldest first
  orca::colour::Track track_;
};

}  // namespace

ORCA_COMPONENT(ColourTracker, "orca.ColourTracker")
