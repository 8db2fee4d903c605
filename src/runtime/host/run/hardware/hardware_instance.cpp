// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hardware_instance.hpp"

#include <filesystem>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/hw/description.hpp"
#include "orca/plugin/code_limit.hpp"

namespace orca::host {

HardwareInstance::HardwareInstance(RunContext& run, std::string name, LoadedType type)
    : run_(run), name_(std::move(name)), type_(std::move(type)) {}

HardwareInstance::~HardwareInstance() {
  const plugin::CodeLimit limit;
  if (const auto fault = guarded_call({name_.c_str(), Hook::destructor, type_.entry},
                                      [this] { type_.entry->destroy(container_); })) {
    const std::string text = to_string(Hook::destructor) + (" " + fault->text);
    write_log(log::Level::error, text);
    run_.reporter.note(make_alarm(idl::FAILED, name_, to_string(Hook::destructor), text));
  }
}

Status HardwareInstance::construct(const std::map<std::string, ParamValue>& params) {
  const plugin::CodeLimit limit;
  values_ = params;
  std::vector<HardwareFault> errors;
  const auto fault = guarded_call({name_.c_str(), Hook::constructor, type_.entry}, [&] {
    container_ = static_cast<hw::HardwareContainer*>(type_.entry->create(*this));
    for (const ParamDeclaration& param : params_)
      if (const auto value = params.find(param.contract.name); value != params.end())
        param.set(value->second);
    errors = container_->prepare();
    std::erase_if(errors, [](const HardwareFault& found) { return found.only_warns; });
    if (hw::Drawable* const drawable = container_->drawable(); drawable != nullptr) {
      if (run_.scene.moments) drawable->keep_moments();
      if (run_.scene.motion) drawable->keep_motion();
    }
    if (!errors.empty()) return;
    description_ = container_->description();
    hw::complete(description_, {std::filesystem::path(type_.file()).filename(), type_.entry->type,
                                container_->line_name()});
    robot_ = find_robot();
  });
  if (fault) return fail(Code::internal, "its constructor " + fault->text, name_);
  if (!errors.empty()) return fail(Code::invalid_argument, errors.front().text, name_);
  return ok();
}

// Returns the name that the driver gives the robot, or the one in the graph if that is not one word.
std::string HardwareInstance::find_robot() const {
  if (container_->motion() == nullptr) return {};
  const std::string& name = description_.name();
  const bool is_word = !name.empty() && name.find(' ') == std::string::npos && printable(name) == name;
  return is_word ? name : name_;
}

std::uint64_t HardwareInstance::mission() const {
  const bool moves = container_ != nullptr && container_->motion() != nullptr;
  return moves ? container_->motion()->mission() : 0;
}

void HardwareInstance::report(const idl::Contact& contact) {
  idl::Contact of_mission = contact;
  of_mission.mission(mission());
  run_.reporter.report(name_, of_mission);
}

void HardwareInstance::state_changed(hw::HardwareState state) {
  LastWords::prepare_thread();  // the first call from its strand
  run_.trace.state_changed(name_, to_string(traced_), to_string(state));
  traced_ = state;
  if (state == hw::HardwareState::fault && !on_trial_.load()) raise_fault();
  run_.changed();
}

// A stop that was ordered is an alarm of whoever has ordered it.
void HardwareInstance::held(const std::optional<std::string>& reason) {
  if (on_trial_.load()) return;
  const char* const hook = to_string(Hook::strand);
  if (reason) return run_.reporter.raise(make_alarm(idl::ESTOP, name_, hook, "the base is held: " + *reason));
  idl::Alarm over = make_alarm(idl::ESTOP, name_, hook, "the base obeys commands again");
  over.active(false);
  run_.reporter.note(std::move(over));
}

void HardwareInstance::accept() {
  const bool was_on_trial = on_trial_.exchange(false);
  if (!was_on_trial) return;
  if (container_->state() == hw::HardwareState::fault) raise_fault();
  if (container_->motion() == nullptr) return;
  if (const std::optional<std::string> reason = container_->motion()->own_hold()) held(reason);
}

// The container has written the reason to the log.
void HardwareInstance::raise_fault() {
  idl::Alarm alarm = make_alarm(idl::HARDWARE_FAULT, name_, to_string(Hook::strand), container_->fault());
  alarm.mission(mission());
  run_.reporter.note(std::move(alarm));
}

}  // namespace orca::host
