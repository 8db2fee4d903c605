// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <string>

#include "joystick.hpp"
#include "keys.hpp"
#include "orca/component.hpp"
#include "orca/geometry/objects/description.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "raw_terminal.hpp"
#include "where.hpp"

namespace {

using orca::Status;
using orca::teleop::Stick;

constexpr orca::Duration kBaseLimit = std::chrono::seconds(5);  // for the base to say what it can do

// A device that is read without blocking.
class Input {
 public:
  ~Input() { close(); }

  Status open(const std::string& device) {
    fd_ = device == "stdin" ? dup(STDIN_FILENO) : ::open(device.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
    if (fd_ >= 0) return orca::ok();
    const orca::Code code = errno == ENOENT ? orca::Code::not_found : orca::Code::unavailable;
    return orca::fail(code, std::string("cannot be opened: ") + std::strerror(errno), device);
  }

  void close() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }

  [[nodiscard]] int fd() const { return fd_; }
  [[nodiscard]] bool is_open() const { return fd_ >= 0; }

  // Reads the bytes that have come; false if the device has gone.
  bool read(std::string& bytes) {
    bytes.clear();
    pollfd waiting{fd_, POLLIN, 0};
    if (poll(&waiting, 1, 0) <= 0) return true;
    char buffer[256];
    const ssize_t got = ::read(fd_, buffer, sizeof buffer);
    if (got < 0) return errno == EAGAIN || errno == EINTR;
    bytes.assign(buffer, static_cast<std::size_t>(got));
    return got > 0;
  }

 private:
  int fd_ = -1;
};

/// A behaviour by which a person drives: with the keys of a terminal, with a joystick, or from afar with commands that a
/// page sends. The joystick has priority while it is not at rest, then the keys. To let go is to stop: the robot stops as
/// soon as no key and no command has come for the dead-man time, the joystick's dead-man button is not held, or the device
/// has gone.
///
/// It needs the steady clock, because a person cannot drive in virtual time.
class Teleop final : public orca::Component {
 public:
  explicit Teleop(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(25)); }

 private:
  // The motion that a person wants.
  struct Motion {
    double speed = 0.0;      // [m/s] forward positive
    double turn_rate = 0.0;  // [rad/s] positive to the left
  };
  // A command that was sent.
  struct FarCommand {
    Motion motion;
    orca::TimePoint came;
  };
  // The limits of the base.
  struct Limits {
    double speed = std::numeric_limits<double>::infinity();      // [m/s]
    double turn_rate = std::numeric_limits<double>::infinity();  // [rad/s]
  };

  Status start() override {
    motion_.start(lap_period());
    keys_ = {};
    stick_.release();
    far_.reset();
    if (!keyboard_->empty())
      if (Status opened = keyboard_input_.open(*keyboard_); !opened.ok()) return opened;
    if (!joystick_->empty())
      if (Status opened = joystick_input_.open(*joystick_); !opened.ok()) return opened;
    if (keyboard_input_.is_open()) terminal_.emplace(keyboard_input_.fd());
    where_.forget();
    return ask_limits();
  }

  // Asks the base how fast it can be. The person's controls then cover what it can do.
  Status ask_limits() {
    limits_ = {};
    if (!robot_.connected()) return orca::ok();
    auto ask = robot_.loan();
    ask->about() = "limits";
    const auto robot = robot_.query(std::move(ask), kBaseLimit);
    if (!robot)
      return orca::fail(robot.error().code,
                        "cannot ask the base how fast it can be: " + robot.error().message);
    if (orca::Status sound = orca::check_description(**robot); !sound.ok()) return sound;
    if ((*robot)->drives().empty()) return orca::ok();
    const orca::idl::Drive& drive = (*robot)->drives().front();
    limits_ = {drive.max_speed(), drive.max_steer_speed()};
    if (*speed_ > limits_.speed || *turn_rate_ > limits_.turn_rate)
      log_info("the base can do less than speed and turn_rate ask for: it drives at most " +
               shown(limits_.speed) + " m/s and turns at most " + shown(limits_.turn_rate) + " rad/s");
    return orca::ok();
  }

  orca::Outcome work() override {
    const double time = orca::to_seconds(now());
    if (take(keyboard_input_, "keyboard")) keys_.take(bytes_, time);
    if (take(joystick_input_, "joystick")) stick_.take(bytes_);
    if (!joystick_input_.is_open()) stick_.release();
    if (keys_.quit()) {
      motion_.push(orca::full_stop());
      return orca::done();
    }
    if (keys_.take_question()) where_.ask(now());
    if (const auto answer = where_.look(now())) log_info(*answer);
    push(wanted_by_hand(time));
    return orca::again();
  }

  // Returns the motion that a person wants.
  Motion wanted_by_hand(double time) {
    const Stick hand = stick_.stick(map());
    const Stick wanted = hand == Stick{} ? keys_.stick(time, *dead_man_) : hand;
    if (wanted == Stick{} && far_ && now() - far_->came <= orca::from_seconds(*dead_man_))
      return far_->motion;
    return {wanted.forward * *speed_, wanted.left * *turn_rate_};
  }

  void push(const Motion& wanted) {
    if (wanted.speed == 0.0 && wanted.turn_rate == 0.0) {
      motion_.push(orca::full_stop());  // overrules the other behaviours
    } else {
      motion_.push(orca::turn(std::clamp(wanted.turn_rate, -limits_.turn_rate, limits_.turn_rate),
                              std::clamp(wanted.speed, -limits_.speed, limits_.speed), *weight_));
    }
  }

  // A command from afar counts until the next one, for the dead-man time at most.
  Status on_motion(const orca::ObjectPtr<orca::idl::MotionCommand>& command) {
    if (command->kind() != orca::idl::NORMAL) {
      far_.reset();
      return orca::ok();
    }
    if (command->steering() != orca::idl::BY_TURN_RATE || !std::isfinite(command->speed()) ||
        !std::isfinite(command->turn_rate()))
      return orca::fail(orca::Code::invalid_argument,
                        "a person's command has steering BY_TURN_RATE, and numbers as speed and turn_rate");
    far_ = {{command->speed(), command->turn_rate()}, now()};
    return orca::ok();
  }

  void stop() override {
    terminal_.reset();
    keyboard_input_.close();
    joystick_input_.close();
  }

  // Reads new bytes into bytes_; false if there are none.
  bool take(Input& input, const char* what) {
    if (!input.is_open()) return false;
    if (input.read(bytes_)) return !bytes_.empty();
    log_warning(std::string("the ") + what + " has gone: it no longer drives the robot");
    if (&input == &keyboard_input_) terminal_.reset();
    input.close();
    return false;
  }

  static std::string shown(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", number);
    return text;
  }

  [[nodiscard]] orca::teleop::JoystickMap map() const {
    return {static_cast<std::uint8_t>(*forward_axis_), static_cast<std::uint8_t>(*left_axis_),
            static_cast<std::uint8_t>(*dead_man_button_)};
  }

  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "motion", {.text = "The person's command, one per lap; full stop while no control is held."}};

  orca::SendServer<orca::idl::MotionCommand> from_afar_{
      *this,
      "MotionSend",
      &Teleop::on_motion,
      {.text = "The command of a person who is elsewhere, such as at orcaview's page, again and again while "
               "the control is "
               "held."}};
  orca::QueryProxy<orca::idl::Ask, orca::idl::Robot> robot_{
      *this,
      "robot",
      {.text = "Base that is asked at the start for its limits; speed and turn_rate stay within them.",
       .optional = true}};
  orca::QueryProxy<orca::idl::AskReading, orca::idl::Odometry> odometry_{
      *this,
      "odometry",
      {.text = "Base that is asked for its odometry when P is pressed.", .optional = true}};

  orca::Param<std::string> keyboard_{
      *this,
      "keyboard",
      "stdin",
      {.fixed = true, .text = "Terminal whose keys drive the robot: stdin, a device, or empty for none."}};
  orca::Param<std::string> joystick_{
      *this,
      "joystick",
      "",
      {.fixed = true, .text = "Joystick device, e.g. /dev/input/js0; empty for none."}};
  orca::Param<double> speed_{
      *this,
      "speed",
      0.3,
      {.unit = "m/s", .min = 0.0, .text = "Speed with a key, or with the stick fully forward."}};
  orca::Param<double> turn_rate_{
      *this,
      "turn_rate",
      0.8,
      {.unit = "rad/s", .min = 0.0, .text = "Turn rate with a key, or with the stick fully aside."}};
  orca::Param<double> dead_man_{
      *this,
      "dead_man",
      0.3,
      {.unit = "s",
       .min = 0.05,
       .max = 2.0,
       .text = "The robot stops when neither a key nor a command from afar has come for this long."}};
  orca::Param<std::int64_t> forward_axis_{
      *this, "forward_axis", 1, {.min = 0, .max = 255, .text = "Joystick axis; up is negative."}};
  orca::Param<std::int64_t> left_axis_{
      *this, "left_axis", 0, {.min = 0, .max = 255, .text = "Joystick axis; left is negative."}};
  orca::Param<std::int64_t> dead_man_button_{
      *this,
      "dead_man_button",
      0,
      {.min = 0, .max = 255, .text = "Joystick button that must be held to drive."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  Input keyboard_input_;
  Input joystick_input_;
  std::optional<orca::teleop::RawTerminal> terminal_;
  Limits limits_;
  orca::teleop::Where where_{odometry_};
  orca::teleop::Keys keys_;
  orca::teleop::Joystick stick_;
  std::optional<FarCommand> far_;  // the last one
  std::string bytes_;
};

}  // namespace

ORCA_COMPONENT(Teleop, "orca.Teleop")
ORCA_STEADY_CLOCK_ONLY("a person cannot drive in virtual time")
