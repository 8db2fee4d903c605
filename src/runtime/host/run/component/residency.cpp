// SPDX-License-Identifier: LGPL-3.0-or-later
#include "residency.hpp"

#include <utility>

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
  type_ = std::move(type).value();
  set_code(type_.entry);
  if (Status constructed = construct(); !constructed.ok()) return constructed;
  if (!parts_.settings.on_demand) declare_what_is_there();
  set_params(parts_.site.declared().params, parts_.params.values());
  return parts_.ports.bind(parts_.site.declared().ports);
}

void Residency::set_code(const void* code) {
  parts_.hooks.set_code(code);
  parts_.home.code.store(code, std::memory_order_release);
}

Status Residency::construct() {
  const auto fault = guarded_call({parts_.settings.name.c_str(), Hook::constructor, type_.entry}, [this] {
    component_ = static_cast<Component*>(type_.entry->create(parts_.site));
  });
  if (fault) return fail(Code::internal, "its constructor " + fault->text, parts_.settings.name);
  return ok();
}

void Residency::declare_what_is_there() {
  for (const PortDeclaration& port : parts_.site.declared().ports) parts_.ports.add(port.contract);
  std::vector<ParamContract> params;
  for (const ParamDeclaration& param : parts_.site.declared().params) params.push_back(param.contract);
  parts_.params.declare(std::move(params));
}

void Residency::unload() {
  destroy();
  parts_.site.reset();
  if (const Status gone = unloader_(std::exchange(type_, {})); !gone.ok())
    parts_.site.write_log(log::Level::error, gone.error().text());
}

void Residency::destroy() {
  parts_.ports.unbind();  // handlers are the component's code
  if (type_.entry == nullptr) return;
  Component* const gone = std::exchange(component_, nullptr);
  const auto fault = guarded_call({parts_.settings.name.c_str(), Hook::destructor, type_.entry}, [&] {
    if (gone != nullptr) type_.entry->destroy(gone);
  });
  parts_.site.forget_code();
  set_code(nullptr);
  if (fault) parts_.report_failure(Hook::destructor, "its destructor " + fault->text);
}

}  // namespace orca::host
