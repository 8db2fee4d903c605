// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hardware_instance.hpp"

#include <utility>

#include "containment/guard.hpp"

namespace orca::host {

HardwareInstance::HardwareInstance(RunContext& run, std::string name, LoadedType type)
    : run_(run), name_(std::move(name)), type_(std::move(type)) {}

HardwareInstance::~HardwareInstance() {
  if (const auto fault = guarded_call({name_.c_str(), "its destructor", type_.entry},
                                      [this] { type_.entry->destroy(container_); }))
    write_log(log::Level::error, "its destructor " + fault->text);
}

Status HardwareInstance::construct(const std::map<std::string, ParamValue>& params) {
  std::vector<HardwareFault> errors;
  const auto fault = guarded_call({name_.c_str(), "its constructor", type_.entry}, [&] {
    container_ = static_cast<hw::HardwareContainer*>(type_.entry->create(*this));
    for (const ParamDeclaration& param : params_)
      if (const auto value = params.find(param.contract.name); value != params.end())
        param.set(value->second);
    errors = container_->prepare();
    if (hw::Drawable* const drawable = container_->drawable(); drawable != nullptr && run_.wants_scene)
      drawable->keep_moments();
  });
  if (fault) return fail(Code::internal, "its constructor " + fault->text, name_);
  if (!errors.empty()) return fail(Code::invalid_argument, errors.front().text, name_);
  return ok();
}

void HardwareInstance::state_changed(hw::HardwareState state) {
  LastWords::prepare_thread();  // the first that is heard of from its strand
  run_.trace.state_changed(name_, to_string(traced_), to_string(state));
  traced_ = state;
  run_.changed();
}

}  // namespace orca::host
