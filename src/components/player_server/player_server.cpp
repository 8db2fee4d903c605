// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "connection.hpp"
#include "orca/component.hpp"
#include "orca/geometry/objects/description.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "robot_face.hpp"

namespace {

using orca::Status;
using namespace orca::player_server;

constexpr orca::Duration kLap = std::chrono::milliseconds(20);
constexpr orca::Duration kBaseLimit = std::chrono::seconds(5);  // for the base to say what it is
constexpr orca::Duration kPredecessorGoes = std::chrono::seconds(5);
constexpr orca::Duration kFirstReadings = std::chrono::milliseconds(1500);
constexpr std::size_t kMostClients = 16;

template <class Object>
const orca::idl::TimeValue& stamp_of(const Object& object) {
  return object.stamp();
}
const orca::idl::TimeValue& stamp_of(const orca::idl::SonarRangeReadings& readings) {
  return readings.pose().stamp();
}

/// A behaviour by which programs written for Player drive the robot, as if it were a server of Player: position2d, sonar and laser, the
/// last two as rangers, too: ranger:0 is the sonars, and ranger:1 is the laser.
/// The last of several clients that send velocities is obeyed. The robot stops when it has sent none for `max_command_age`, and
/// at once when its connection ends.
///
/// It needs the steady clock, because its clients live in real time.
class PlayerServer final : public orca::Component {
 public:
  explicit PlayerServer(orca::ComponentHost& host) : Component(host) { lap_every(kLap); }

 private:
  Status start() override {
    face_ = {};
    face_.has_sonar = sonar_.connected();
    face_.has_laser = laser_.connected();
    motion_.start(lap_period());
    if (Status asked = ask_size(); !asked.ok()) return asked;
    listens_by_ = now() + kPredecessorGoes;
    const Status listens = listen();
    return may_listen_later(listens) ? orca::ok() : listens;
  }

  Status listen() {
    if (Status listens = listener_.open(*address_, static_cast<std::uint16_t>(*port_)); !listens.ok())
      return listens;
    log_info("clients of Player find the robot at " + *address_ + ":" + std::to_string(listener_.port()));
    return orca::ok();
  }

  // Returns whether the port may become free: the code that this replaces may have it, and goes when this has proved itself.
  [[nodiscard]] bool may_listen_later(const Status& listens) const {
    return listens.ok() || (listens.error().code == orca::Code::already_exists && now() < listens_by_);
  }

  Status ask_size() {
    if (!robot_.connected()) return orca::ok();
    auto ask = robot_.loan();
    ask->about() = "limits";
    const auto robot = robot_.query(std::move(ask), kBaseLimit);
    if (!robot)
      return orca::fail(robot.error().code, "cannot ask the base how large it is: " + robot.error().message);
    if (orca::Status sound = orca::check_description(**robot); !sound.ok()) return sound;
    const double across = 2.0 * std::max((*robot)->radius(), (*robot)->bumper_radius());
    face_.size = {.width = (*robot)->width() > 0.0 ? (*robot)->width() : across,
                  .length = (*robot)->length() > 0.0 ? (*robot)->length() : across};
    return orca::ok();
  }

  orca::Outcome work() override {
    if (!listener_.is_open())
      if (const Status listens = listen(); !may_listen_later(listens))
        return orca::failed(listens.error().message);
    take_news();
    while (is_known() && clients_.size() < kMostClients) {
      auto client = listener_.accept(face_);
      if (!client) break;
      log_info("a client of Player has come: " + client->peer());
      clients_.push_back(std::move(client));
    }
    std::erase_if(clients_, [this](const auto& client) { return !exchange(*client); });
    drive();
    return orca::again();
  }

  // Clients ask once where sonars and laser sit, which the first readings show. A sensor that is silent is not waited for longer.
  [[nodiscard]] bool is_known() const {
    const bool has_all = face_.state && (!face_.has_sonar || face_.sonar) && (!face_.has_laser || face_.scan);
    return has_all || now() >= listens_by_ - kPredecessorGoes + kFirstReadings;
  }

  void stop() override {
    clients_.clear();
    listener_.close();
  }

  // Returns whether the client is still there.
  bool exchange(Connection& client) {
    const Status done = client.exchange(now());
    if (const std::string remark = client.session().take_remark(); !remark.empty())
      log_warning("the client of Player " + client.peer() + ": " + remark);
    if (done.ok()) return true;
    log_info("the client of Player " + client.peer() + " is no longer served: " + done.error().message);
    return false;
  }

  void take_news() {
    take_news_of(odometry_, {kBase});
    take_news_of(sonar_, {kSonar, kSonarRanger});
    take_news_of(laser_, {kLaser, kLaserRanger});
  }

  // Returns the newest object since the last lap, which is the one that a client wants.
  template <class Object>
  void take_news_of(orca::PushProxy<Object>& port, std::initializer_list<DeviceName> names) {
    orca::ObjectPtr<Object> newest;
    while (port.connected()) {
      orca::ObjectPtr<Object> next = port.get_update_wait_max(orca::Duration{0});
      if (!next) break;
      newest = std::move(next);
    }
    if (newest) pass_on(*newest, names);
  }

  template <class Object>
  void pass_on(const Object& object, std::initializer_list<DeviceName> names) {
    face_.take(object);
    const double stamp = orca::to_seconds(orca::to_time_point(stamp_of(object)));
    for (const auto& client : clients_)
      for (const DeviceName& name : names) client->session().offer(name, stamp);
  }

  // The last word counts, for a while.
  void drive() {
    std::optional<ClientSession::Wish> last;
    for (const auto& client : clients_)
      if (const auto& wish = client->session().wish(); wish && (!last || wish->said > last->said))
        last = wish;
    const bool is_fresh = last && orca::to_seconds(now() - last->said) < *max_command_age_;
    if (!is_fresh || last->velocity == orca::Twist2{}) {
      motion_.push(orca::full_stop());
    } else {
      motion_.push(orca::turn(last->velocity.turn_rate, last->velocity.forward, *weight_));
    }
  }

  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this,
      "motion",
      {.text = "The clients' command, one per lap; full stop while there is none that is fresh."}};
  orca::PushProxy<orca::idl::Odometry> odometry_{*this, "odometry", {.text = "Becomes position2d."}};
  orca::PushProxy<orca::idl::SonarRangeReadings> sonar_{
      *this, "sonar", {.text = "Becomes sonar and ranger:0.", .optional = true}};
  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{
      *this, "laser", {.text = "Becomes laser and ranger:1.", .optional = true}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::Robot> robot_{
      *this, "robot", {.text = "Base that is asked at the start how large it is.", .optional = true}};

  orca::Param<std::string> address_{
      *this,
      "address",
      "127.0.0.1",
      {.fixed = true,
       .text = "Where clients are heard: 127.0.0.1 those of this machine, 0.0.0.0 all. There is no password: "
               "whoever reaches the port can drive the robot."}};
  orca::Param<std::int64_t> port_{
      *this, "port", 6665, {.min = 0, .max = 65535, .fixed = true, .text = "TCP port; 0: any that is free."}};
  orca::Param<double> max_command_age_{*this,
                                       "max_command_age",
                                       0.5,
                                       {.unit = "s",
                                        .min = 0.05,
                                        .max = 5.0,
                                        .text = "The robot stops when the client's last velocity is older. "
                                                "Servers of Player often have no such limit: a "
                                                "client that sends a velocity once must send it again."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  RobotFace face_;
  Listener listener_;
  orca::TimePoint listens_by_{};
  std::vector<std::unique_ptr<Connection>> clients_;
};

}  // namespace

ORCA_COMPONENT(PlayerServer, "orca.PlayerServer")
ORCA_STEADY_CLOCK_ONLY("its clients live in real time")
