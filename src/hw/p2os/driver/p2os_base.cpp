// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/base/text.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/base_driver.hpp"
#include "orca/hw/p2os/config.hpp"
#include "orca/hw/p2os/gripper.hpp"
#include "orca/hw/p2os/model.hpp"
#include "remarks.hpp"
#include "senses.hpp"
#include "session.hpp"

namespace {

using namespace orca;
using namespace orca::hw;
using namespace orca::hw::p2os;

constexpr Duration kSayAgain = 250ms;  // what it is to do, and that we live; its watchdog usually waits 2 s
constexpr Duration kSayAgainSoonest = 50ms;
constexpr int kChances = 4;                 // to be heard before its watchdog bites
constexpr Duration kPowerTime = 500ms;      // from the command for power until a packet must tell of it
constexpr std::ptrdiff_t kMostBumpers = 7;  // on a side: a packet has bits for so many
const std::vector<std::uint32_t> kRates{9600, 38400, 19200, 115200, 57600};

bool fits_packet(const std::vector<double>& bumpers) {
  const std::ptrdiff_t front = std::ranges::count_if(
      bumpers, [](double direction) { return std::abs(direction) < 0.5 * std::numbers::pi; });
  return front <= kMostBumpers && std::ssize(bumpers) - front <= kMostBumpers;
}

double within(double wish, double limit) { return limit > 0.0 ? std::min(wish, limit) : wish; }

// Around the axle.
double length_of(const Model& model) { return model.length + 2.0 * model.behind; }

// The radius of the maker's files does not hold the corners.
double radius_of(const Model& model) {
  return std::max(model.radius, 0.5 * portable::hypot(length_of(model), model.width));
}

std::string all_models() {
  std::string names;
  for (const Model& model : models()) names += (names.empty() ? "" : ", ") + std::string(model.subclass);
  return names;
}

/// The base of a Pioneer 2, PeopleBot or later robot that speaks P2OS or ARCOS.
///
/// Its motors get power with the first command to move, not before, and lose it when nobody uses the base. After a fault they stay
/// off until an operator lets the base move again.
class P2osBase final : public BaseDriver {
 public:
  explicit P2osBase(HardwareHost& host)
      : BaseDriver(host, "/dev/ttyUSB0", {.baud = kRates.front()},
                   {.name = "Pioneer",
                    .usual = {.max_speed = 0.5,
                              .max_turn_rate = 1.5,
                              .big_turn_angle = std::numbers::pi / 3.0,
                              .big_turn_speed = 0.3},
                    .in_file = BaseFigures::Expected{}}) {}

  [[nodiscard]] std::vector<std::pair<std::string, std::string>> learned() const override {
    if (!session_) return {};
    const ModelChoice choice = choose_model(session_->identity().subclass);
    if (!choice.is_known || &choice.model == model_) return {};
    return {{"model", std::string(choice.model.subclass)}};
  }

 protected:
  [[nodiscard]] BaseFigures::Expected expected() const override {
    const Model& model = choose_model(*model_name_).model;
    return {std::string(model.name), idl::DIFFERENTIAL, 2.0 * model.half_track};
  }

  void check(std::vector<HardwareFault>& faults) override {
    const ModelChoice choice = choose_model(*model_name_);
    model_ = &choice.model;
    if (!choice.is_known)
      faults.push_back({"model", in_quotes(*model_name_) + " is none of " + all_models()});
    if (has_gripper() && model_->name.find("PeopleBot") != std::string_view::npos)
      faults.push_back(
          {"robot",
           "its gripper is that of a PeopleBot, which is at ports that this driver does not know; only "
           "grippers of Pioneers are known"});
    if (!fits_packet(bumpers()))
      faults.push_back({"robot", "a Pioneer tells of at most 7 bumpers in front and 7 in the rear"});
  }

  // Of some models the limits are not known.
  [[nodiscard]] DriveLimits limits() const override {
    DriveLimits limits = BaseDriver::limits();
    limits.max_speed = within(limits.max_speed, model_->max_speed);
    limits.max_turn_rate = within(limits.max_turn_rate, model_->max_turn_rate);
    return limits;
  }

  std::vector<SensorEndpoint*> make_senses() override {
    senses_.emplace(*model_, Senses::Extras{bumpers(), bumper_radius(), has_gripper()}, figures().traits());
    remarks_.emplace(!model_->sonar_poses.empty());
    if (has_gripper()) {
      gripper_.emplace(
          Gripper::Driver{.act = [this](const idl::GripperCommand& command) { return move_gripper(command); },
                          .halt = [this] { return send({encode_gripper(GripperAction::halt)}); }});
      add_actuator(*gripper_);
    }
    return senses_->endpoints();
  }

  void describe(idl::Robot& robot) const override {
    robot.vendor("ActivMedia");
    robot.model(std::string(model_->name));
    robot.radius(radius_of(*model_));
    robot.bumper_radius(radius_of(*model_));
    robot.length(length_of(*model_));
    robot.width(model_->width);
    figures().describe(robot);
    if (const auto sonars = senses_->describe_sonars()) robot.sonar_rings().push_back(*sonars);
    if (gripper_) robot.actuators().push_back(describe_gripper());
  }

  LineSession& session() override {
    if (!session_) session_.emplace(line(), rates_of(line(), kRates), *speed_up_);
    return *session_;
  }

  Status meet() override {
    const Identity& robot = session_->identity();
    const ModelChoice choice = choose_model(robot.subclass);
    is_known_ = choice.is_known;
    if (!choice.is_known) {
      warn(stranger());
    } else if (&choice.model != model_) {
      warn("the robot calls itself " + in_quotes(robot.subclass) + "; write model=\"" +
           std::string(choice.model.subclass) + "\", or its sonars and size are those of another robot");
    }
    log_connected(in_quotes(robot.name) + " (" + robot.robot_class + " " + robot.subclass + ")",
                  session_->rate());
    if (const std::string& trouble = session_->rate_trouble(); !trouble.empty())
      host().write_log(log::Level::info,
                       "it stays at " + std::to_string(session_->rate()) + " baud: " + trouble);
    senses_->connect(choice.is_known ? choice.model : *model_);
    say_again_every_ = kSayAgain;
    if (session_->config()) take(*session_->config());
    return ok();
  }

  [[nodiscard]] TimePoint next_turn() const override { return say_again_; }
  Status start() override {
    remarks_->start(host().now());
    return send({encode(Command::sonar, 1)});
  }

  void stop() override {
    (void)send({encode(Command::stop), encode(Command::sonar, 0), encode(Command::enable, 0)});
    powered_ = false;
  }

  void take_leave() override {
    (void)send({encode(Command::stop), encode(Command::close)});
    powered_ = false;
    applied_ = {};
  }

  Status poll() override {
    const TimePoint now = host().now();
    if (Status read = session_->receive(now, [this](const Received& packet) { take(packet); }); !read.ok())
      return read;
    if (now < say_again_) return line().flush();
    return applied_.stands() ? send({encode(Command::pulse)}) : say(applied_);
  }

  Status drive(const DriveSetpoint& setpoint) override {
    if (!setpoint.stands() && !may_drive()) {
      hold(stranger());
      return say({});
    }
    applied_ = setpoint;
    if (!setpoint.stands() && !powered_) {
      powered_ = true;
      powered_at_ = host().now();
      if (Status on = send({encode(Command::enable, 1)}); !on.ok()) return on;
    }
    return say(setpoint);
  }

 private:
  using Gripper = ActuatorHW<idl::GripperCommand>;

  [[nodiscard]] std::vector<double> bumpers() const {
    return figures().figures() != nullptr ? figures().figures()->bumper_directions()
                                          : Senses::usual_bumpers(*model_);
  }

  // Without a robot file the bumpers sit where the body ends.
  [[nodiscard]] double bumper_radius() const {
    return figures().figures() != nullptr ? figures().figures()->bumper_radius : radius_of(*model_);
  }

  [[nodiscard]] bool has_gripper() const {
    return figures().figures() != nullptr && figures().figures()->gripper.has_value();
  }

  [[nodiscard]] idl::Actuator describe_gripper() const {
    idl::Actuator gripper;
    gripper.name(figures().figures()->gripper->link);
    gripper.port(device());
    return gripper;
  }

  Status move_gripper(const idl::GripperCommand& command) {
    if (command.paddles() != idl::PADDLES_STAY) {
      const bool open = command.paddles() == idl::PADDLES_OPEN;
      const Status sent = send({encode_gripper(open ? GripperAction::open : GripperAction::close)});
      if (!sent.ok()) return sent;
    }
    if (command.lift() == idl::LIFT_STAY) return ok();
    const bool up = command.lift() == idl::LIFT_UP;
    return send({encode_gripper(up ? GripperAction::up : GripperAction::down)});
  }

  [[nodiscard]] bool may_drive() const { return is_known_ || *drive_unknown_; }

  // What a robot is whose model is not known.
  [[nodiscard]] std::string stranger() const {
    return "the robot calls itself " + in_quotes(session_->identity().subclass) +
           ", which is not known; its counts are read as those of a " + std::string(model_->name) +
           (*drive_unknown_ ? ", so check distances before it drives on its own"
                            : ", and it does not move: if that is right, write drive_unknown=\"true\"");
  }

  void take(const Config& config) {
    if (config.watchdog > Duration{0})
      say_again_every_ = std::clamp<Duration>(config.watchdog / kChances, kSayAgainSoonest, kSayAgain);
    tell(remarks_->take(config, motion()->limits()));
  }

  void tell(const std::vector<std::string>& remarks) {
    for (const std::string& remark : remarks) warn(remark);
  }

  void take(const Received& packet) {
    if (const auto config = parse_config(packet.body)) return take(*config);
    if (!is_sip(packet.body)) return;  // others are not asked for
    const Result<Sip> sip = parse_sip(packet.body, senses_->units());
    if (!sip) return;  // its checksum was good, but it is cut short
    heard(packet.stamp);
    senses_->take(*sip, packet.stamp);
    if (!is_active()) return;
    guard(*sip);
    tell(remarks_->take(*sip, host().now()));
    senses_->publish();
  }

  // Stops the base where it cannot go on. The motors lose their power with the red button, and get it back only for an operator.
  void guard(const Sip& sip) {
    motion()->press(senses_->pressed());
    if (sip.left_stall || sip.right_stall) motion()->obstruct("its motors are stalled", Hindrance::stall);
    if (sip.emergency_stop) hold("its emergency button is pressed; release it");
    const bool had_time = powered_ && host().now() - powered_at_ > kPowerTime;
    if (had_time && !sip.motors_enabled)
      hold(
          "its motors have lost their power; was its motor button pressed, or is its battery low? Press the "
          "button, or charge it");
  }

  void hold(const std::string& reason) {
    powered_ = false;
    await_person(reason);
  }

  Status say(const DriveSetpoint& setpoint) {
    if (setpoint.stands() && setpoint.at_once) return send({encode(Command::estop), encode(Command::stop)});
    const Twist2 velocity = figures().calibration().to_controller(setpoint.velocity);
    return send({encode_speed(velocity.forward), encode_turn_rate(velocity.turn_rate)});
  }

  Status send(std::initializer_list<Packet> commands) {
    say_again_ = host().now() + say_again_every_;
    for (const Packet& command : commands)
      if (Status sent = session_->send(command); !sent.ok()) return sent;
    return ok();
  }

  Param<std::string> model_name_{
      *this, "model", "p2dx", {.text = "What the robot calls itself (subclass): p2dx, p2pb, p3dx, ..."}};
  Param<bool> drive_unknown_{
      *this,
      "drive_unknown",
      false,
      {.text =
           "Whether a robot moves that calls itself a model that is not known: its counts are read as those "
           "of `model`."}};
  Param<bool> speed_up_{*this,
                        "speed_up",
                        true,
                        {.text = "Whether a robot at 9600 or 19200 baud is told to send at 38400; "
                                 "false where something between has "
                                 "a fixed rate, as a radio modem may."}};

  const Model* model_ = nullptr;
  std::optional<Senses> senses_;
  std::optional<Gripper> gripper_;
  std::optional<Session> session_;
  std::optional<Remarks> remarks_;
  bool is_known_ = true;  // the model that the robot calls itself
  Duration say_again_every_ = kSayAgain;
  bool powered_ = false;  // the motors
  TimePoint powered_at_{};
  DriveSetpoint applied_;  // what the wheels were told last
  TimePoint say_again_{};
};

}  // namespace

ORCA_HARDWARE(P2osBase, "orca.hw.P2os")
