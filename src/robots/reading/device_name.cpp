// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>

#include "extension_readers.hpp"

namespace orca::robots::detail {
namespace {

template <class Device>
bool holds(const std::vector<Device>& devices, const std::string& name) {
  return std::ranges::find(devices, name, &Device::name) != devices.end();
}

// Returns the kind of the device that has this name; null if none has it.
const char* owner_of(const std::string& name, const Characteristics& model) {
  if (name == "odometry") return "device";  // Its errors are drawn by that name.
  if (holds(model.sonars, name)) return "sonar ring";
  if (holds(model.lasers, name)) return "laser";
  if (holds(model.infrareds, name)) return "infrared ring";
  if (holds(model.bumpers, name)) return "bumper ring";
  return nullptr;
}

}  // namespace

DeviceLabel read_label(const xml::Attributes& e) {
  return {e.text("vendor").value_or(""), e.text("model").value_or(""), e.text("port").value_or("")};
}

bool name_is_free(const xml::Attributes& e, const std::string& name, const Characteristics& model) {
  if (name.empty()) return true;  // Reported already.
  const char* const owner = owner_of(name, model);
  if (owner == nullptr) return true;
  e.error_at("name", codes::kDuplicate,
             std::string("there is a ") + owner + " \"" + name + "\" already; choose another name");
  return false;
}

}  // namespace orca::robots::detail
