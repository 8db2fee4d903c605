// SPDX-License-Identifier: LGPL-3.0-or-later
#include "residency.hpp"

#include <utility>

#include "orca/plugin/code_limit.hpp"

namespace orca::host {

Residency::Residency(ComponentParts& parts, Loader loader, Unloader unloader)
    : parts_(parts), loader_(std::move(loader)), unloader_(std::move(unloader)) {}

void Residency::declare(const Contract& contract) {
  for (PortContract port : contract.ports) {
    port.name = parts_.settings.name_in_graph(port.name);
    parts_.ports.add(port);
  }
  parts_.params.declare(contract.params);
}

Status Residency::load() {
  Result<LoadedType> type = loader_();
  if (!type) return type.error();
  resident_.type = std::move(type).value();
  resident_.site = std::make_unique<ComponentSite>(parts_);
  set_code(resident_.type.entry);
  if (Status constructed = construct(); !constructed.ok()) return constructed;
  if (!parts_.settings.on_demand) declare_what_is_there();
  set_params(declared().params, parts_.params.values());
  return parts_.ports.bind(declared().ports);
}

void Residency::set_code(const void* code) {
  parts_.hooks.set_code(code);
  parts_.home.code.store(code, std::memory_order_release);
}

Status Residency::construct() {
  const plugin::CodeLimit limit;
  const TypeEntry& entry = *resident_.type.entry;
  const auto fault = guarded_call({parts_.settings.name.c_str(), Hook::constructor, &entry}, [&] {
    resident_.object = static_cast<Component*>(entry.create(*resident_.site));
  });
  if (fault) return fail(Code::internal, "its constructor " + fault->text, parts_.settings.name);
  resident_.site->close_declarations();
  return ok();
}

void Residency::declare_what_is_there() {
  for (const PortDeclaration& port : declared().ports) parts_.ports.add(port.contract);
  parts_.params.declare(param_contracts(declared().params));
}

bool Residency::stays_active() const {
  const bool wishes = resident_.site != nullptr && resident_.site->stays_active();
  return parts_.settings.autonomous.value_or(wishes);
}

void Residency::unload() {
  (void)destroy();
  if (const Status gone = unloader_(std::exchange(resident_, {}).type); !gone.ok())
    parts_.write_log(log::Level::error, gone.error().text());
}

Status Residency::destroy() {
  const plugin::CodeLimit limit;
  stop_left_over();
  parts_.ports.unbind();  // handlers are the component's code
  const TypeEntry* const entry = resident_.type.entry;
  if (entry == nullptr) return ok();
  Component* const gone = std::exchange(resident_.object, nullptr);
  const auto fault = guarded_call({parts_.settings.name.c_str(), Hook::destructor, entry}, [&] {
    if (gone != nullptr) entry->destroy(gone);
  });
  resident_.site->forget_code();
  set_code(nullptr);
  if (!fault) return ok();
  const std::string text = "its destructor " + fault->text;
  parts_.report_failure(Hook::destructor, text);
  return fail(Code::internal, text);
}

// An object that lost its place while it worked was not stopped then.
void Residency::stop_left_over() {
  if (!std::exchange(resident_.started, false) || resident_.object == nullptr) return;
  const auto fault = parts_.hooks.call(Hook::stop, [this] { resident_.object->stop(); });
  if (fault && !fault->interrupted) parts_.report_failure(Hook::stop, "stop() " + fault->text);
}

// --- Exchange ---------------------------------------------------------------------------------------------

void Residency::trade_places(Residency& other) {
  add_ports_of(other);
  other.add_ports_of(*this);
  parts_.ports.unbind();
  other.parts_.ports.unbind();
  std::swap(resident_, other.resident_);
  std::swap(loader_, other.loader_);
  std::swap(unloader_, other.unloader_);
  parts_.params.trade_places(other.parts_.params);
  settle();
  other.settle();
}

void Residency::trade_loaders(Residency& other) {
  add_ports_of(other);
  std::swap(loader_, other.loader_);
  std::swap(unloader_, other.unloader_);
  parts_.params.trade_places(other.parts_.params);
}

void Residency::add_ports_of(const Residency& other) {
  for (const PortDeclaration& port : other.declared().ports)
    if (parts_.ports.find(port.contract.name) == nullptr) parts_.ports.add(port.contract);
}

// All ports of the object exist here, and their contracts were compared before.
void Residency::settle() {
  resident_.site->move_to(parts_);
  set_code(resident_.type.entry);
  (void)parts_.ports.bind(declared().ports);
}

}  // namespace orca::host
