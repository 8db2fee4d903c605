// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/server.hpp"

#include <atomic>
#include <optional>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/idl/checks.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace orca::hw {
namespace {

constexpr Duration kWatchPeriod = 100ms;     // how often the hardware's state is looked at
constexpr Duration kStartLimit = 5s;         // for a device to start
constexpr Duration kFirstReadingLimit = 2s;  // for a query to an idle device
constexpr const char* kTouched = "BUMPER_TOUCHED";
constexpr const char* kStalled = "MOTOR_STALLED";
constexpr Duration kMotionHold = 500ms;  // a base stays active this long after the last motion command

// Whether the device has failed, also if it is opened again later.
bool has_failed(HardwareState state) {
  return state == HardwareState::fault || state == HardwareState::backoff;
}

// A use of the hardware: keeps it active while this object lives, even if a wait is interrupted.
class Use {
 public:
  explicit Use(HardwareSeat& seat) : seat_(seat) { seat_.acquire(); }
  ~Use() { seat_.release(); }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

 private:
  HardwareSeat& seat_;
};

}  // namespace

// The Push and the Query port of one sensor, whatever its object type.
class HardwareServer::SensorPorts {
 public:
  SensorPorts(HardwareServer& server, const HardwareSeat::Sensor& sensor)
      : server_(server),
        sensor_(sensor),
        push_(server, sensor.port_stem + "Push", sensor),
        query_(server, sensor.port_stem + "Query", type_id(object_type<idl::AskReading>()),
               type_id(*sensor.type),
               [this](const ObjectRef& ask) {
                 return answer(to_time_point(object_cast<idl::AskReading>(ask)->since()));
               },
               {.text = "The latest reading, if it was sensed at `since` or later."}) {}
  ~SensorPorts() { server_.seat_->set_sink(sensor_, this, nullptr); }
  SensorPorts(const SensorPorts&) = delete;
  SensorPorts& operator=(const SensorPorts&) = delete;

  void connect() {
    server_.seat_->set_sink(sensor_, this, [this](ObjectLoan reading) {
      server_.amend(reading);
      if (!open_.load(std::memory_order_acquire)) return std::move(reading).seal();
      ObjectRef pushed = push_.push(std::move(reading));
      server_.host().strand().wake();  // a query may wait for it
      return pushed;
    });
  }
  // Readings are pushed while the component works. Hardware that others use too goes on when it does not, or has
  // failed.
  void set_open(bool open) { open_.store(open, std::memory_order_release); }

 private:
  class Push final : public PushServerHandle {
   public:
    Push(PortOwner& owner, std::string name, const HardwareSeat::Sensor& sensor)
        : PushServerHandle(owner, std::move(name), type_id(*sensor.type),
                           {.period = sensor.period, .from_device = true}) {}
    // Called on the driver's strand, so without the provenance of the object that the component handles.
    ObjectRef push(ObjectLoan reading) { return push_reading(std::move(reading)); }
  };

  // Returns the latest reading; if the hardware is idle, the first one after starting it. It does not wait for a
  // later one, because the base carries out no command meanwhile.
  Result<ObjectLoan> answer(TimePoint since) {
    HardwareSeat& seat = *server_.seat_;
    const Use use(seat);
    const auto failed = [&] { return has_failed(seat.state()); };
    server_.host().strand().wait_for(server_.now() + kFirstReadingLimit,
                                     [&] { return failed() || seat.latest(sensor_); });
    if (const ObjectRef reading = seat.latest(sensor_)) {
      if (reading.stamp() >= since) return copy_value(reading);
      return fail(Code::unavailable, older_than(since, reading.stamp()));
    }
    if (failed()) return fail(Code::unavailable, "the hardware failed: " + seat.fault());
    return fail(Code::deadline_exceeded, "the hardware gave no reading within 2 s");
  }

  [[nodiscard]] std::string older_than(TimePoint since, TimePoint stamp) const {
    return "the latest reading was sensed " + seconds_text(since - stamp) +
           " before the time that is asked for; ask again: one comes every " + seconds_text(sensor_.period);
  }

  HardwareServer& server_;
  const HardwareSeat::Sensor sensor_;
  Push push_;
  QueryServerHandle query_;
  std::atomic<bool> open_{false};
};

HardwareServer::HardwareServer(ComponentHost& host, Source source, const ObjectType* only)
    : Component(host), seat_(static_cast<HardwareSeat*>(host.hardware())) {
  lap_every(kWatchPeriod);
  if (seat_ == nullptr) return;
  for (const HardwareSeat::Sensor& sensor : seat_->sensors()) {
    // Types are compared by name, because a plugin may have its own copy of the type's description.
    const bool wanted = only == nullptr || only->name == sensor.type->name;
    if (wanted && sensor.source == source) sensors_.push_back(std::make_unique<SensorPorts>(*this, sensor));
  }
  if (seat_->has_line())
    statistics_ = std::make_unique<QueryServer<idl::Ask, idl::DeviceStatistics>>(
        *this, "DeviceStatisticsQuery", &HardwareServer::on_statistics,
        PortOptions{.text = "What was counted on the line to the device, and why it failed last."});
}

HardwareServer::~HardwareServer() {
  if (watches_) seat_->watch(host().strand(), false);
}

void HardwareServer::offer_motion() {
  if (seat_ == nullptr) return;
  offer_base();
  for (const HardwareSeat::Actuator& actuator : seat_->actuators())
    actuators_.push_back(std::make_unique<SendServerHandle>(
        *this, actuator.port_stem + "Send", type_id(*actuator.type),
        [this, actuator](const ObjectRef& command) { return on_actuator(actuator, command); },
        PortOptions{}));
}

void HardwareServer::offer_base() {
  const std::optional<DriveLimits> base = seat_->limits();
  if (!base) return;
  motion_ = std::make_unique<SendServer<idl::MotionCommand>>(*this, "MotionCommandSend",
                                                             &HardwareServer::on_motion);
  if (base->type == idl::HOLONOMIC)
    velocity_ = std::make_unique<SendServer<idl::HolonomicVelocity>>(*this, "HolonomicVelocitySend",
                                                                     &HardwareServer::on_velocity);
}

Status HardwareServer::configure() {
  if (seat_ == nullptr) return fail(Code::failed_precondition, "the graph binds no hardware to it");
  seat_->watch(host().strand());
  watches_ = true;
  for (const auto& sensor : sensors_) sensor->connect();
  return ok();
}

Status HardwareServer::start() {
  for (const auto& sensor : sensors_) sensor->set_open(true);
  seat_->acquire();
  host().strand().wait_for(now() + kStartLimit, [this] {
    return seat_->state() == HardwareState::active || has_failed(seat_->state());
  });
  const bool comes_back = has_failed(seat_->state()) && !seat_->is_lost();
  if (seat_->state() != HardwareState::active && !comes_back)
    return fail(Code::unavailable, "the hardware does not start: " + seat_->fault());
  carry_out_waiting_command();
  last_command_ = now();
  return ok();
}

void HardwareServer::carry_out_waiting_command() {
  const std::function<Status()> command = std::exchange(waiting_command_, nullptr);
  if (!command) return;
  if (now() - last_command_ >= seat_->max_command_age()) {
    log_warning("a motion command grew too old while the hardware was started");
  } else if (const Status taken = command(); !taken.ok()) {
    log_warning("the command that started the hardware was lost: " + taken.error().text());
  }
}

Outcome HardwareServer::work() {
  if (seat_->is_lost()) return failed("the hardware failed: " + seat_->fault());
  release_idle_motion();
  report_hindrances();
  return again();
}

void HardwareServer::stop() {
  for (const auto& sensor : sensors_) sensor->set_open(false);
  clear_alarm(kTouched, "nobody drives the base");
  clear_alarm(kStalled, "nobody drives the base");
  seat_->release();
}

Result<Loan<idl::DeviceStatistics>> HardwareServer::on_statistics(const ObjectPtr<idl::Ask>& /*ask*/) {
  return make_object<idl::DeviceStatistics>(seat_->statistics());
}

// Every base stops, also for a velocity that it could not drive.
bool HardwareServer::is_stop(const idl::HolonomicVelocity& velocity) {
  const bool stands = velocity.speed() == 0.0 && velocity.left() == 0.0 && velocity.turn_rate() == 0.0;
  return stands || velocity.kind() == idl::FULLSTOP;
}

Status HardwareServer::on_motion(const ObjectPtr<idl::MotionCommand>& command) {
  const auto velocity = command.as<idl::HolonomicVelocity>();
  if (velocity && (velocity_ || !is_stop(*velocity))) return on_velocity(velocity);
  if (Status checked = MotionHW::check(*command); !checked.ok()) return checked;
  ask_about(*command);
  return carry_out(command, command->kind() == idl::FULLSTOP);
}

Status HardwareServer::on_velocity(const ObjectPtr<idl::HolonomicVelocity>& velocity) {
  if (!velocity_) return fail(Code::failed_precondition, MotionHW::kNotSideways);
  if (Status checked = MotionHW::check(*velocity); !checked.ok()) return checked;
  if (Status checked = check_command(*velocity); !checked.ok()) return checked;
  ask_about(*velocity);
  return carry_out(velocity, is_stop(*velocity));
}

// The command of an actuator has no age, so idle hardware takes it before it is started.
Status HardwareServer::on_actuator(const HardwareSeat::Actuator& actuator, const ObjectRef& command) {
  if (has_failed(seat_->state())) return fail(Code::unavailable, "it has failed: " + seat_->fault());
  if (Status taken = seat_->command(actuator, command); !taken.ok()) return taken;
  if (!waiting_command_) last_command_ = now();
  stay_active(true);
  return ok();
}

template <class Command>
Status HardwareServer::carry_out(const ObjectPtr<Command>& command, bool stands) {
  last_command_ = now();
  if (seat_->state() == HardwareState::active) {
    stay_active(!stands);
    return told_once(seat_->command(*command));
  }
  if (has_failed(seat_->state()))
    return told_once(fail(Code::unavailable, "it has failed: " + seat_->fault()));
  // Idle hardware stands already; the command for which it was to be started is discarded.
  waiting_command_ = nullptr;
  if (!stands) waiting_command_ = [this, command] { return seat_->command(*command); };
  stay_active(!stands);
  return ok();
}

// Asks the sender of a command that no robot can carry out, once. The base does what it can.
template <class Command>
void HardwareServer::ask_about(const Command& command) {
  const std::optional<std::string> doubt = doubt_about(command);
  if (doubt && doubted_.insert(command.origin()).second)
    log_warning("\"" + command.origin() + "\" commands " + *doubt);
}

// A base that stands in front of an obstacle gets command after command: only the first one for each reason is told.
Status HardwareServer::told_once(const Status& taken) {
  if (taken.ok() || taken.error().code != Code::unavailable) {
    obstruction_.clear();
    return taken;
  }
  const std::string reason = taken.error().text();
  if (std::exchange(obstruction_, reason) != reason) log_warning(reason);
  return ok();
}

void HardwareServer::report_hindrances() {
  if (!motion_) return;
  if (const auto touch = seat_->take_hindrance(Hindrance::touch))
    raise_alarm(kTouched, idl::ALARM_WARNING, *touch + "; back off, or take away what is there");
  else
    clear_alarm(kTouched, "the base touches nothing");
  if (const auto stall = seat_->take_hindrance(Hindrance::stall))
    raise_alarm(kStalled, idl::ALARM_WARNING, *stall + "; back off, or see what holds its wheels");
  else
    clear_alarm(kStalled, "its motors turn as they should");
}

void HardwareServer::release_idle_motion() {
  if (now() - last_command_ > kMotionHold) stay_active(false);
}

}  // namespace orca::hw
