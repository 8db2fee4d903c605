// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "object_learning.hpp"

#include <cstdio>
#include <set>
#include <string>
#include <utility>
#include <variant>

#include "client.hpp"
#include "orca/plugin/index.hpp"
#include "orca/plugin/object_library.hpp"

namespace orca::orcactl {
namespace {

constexpr Duration kLimit = 2s;  // whoever looks on waits no longer for a system that does not answer

void load(const std::string& library) {
  if (const Status loaded = plugin::load_object_library(library); !loaded.ok())
    std::fprintf(stderr, "orcactl: %s\n", loaded.error().text().c_str());
}

}  // namespace

void learn_objects(Descriptor system) {
  Client client(std::move(system));
  std::set<std::string> libraries;
  const auto take = [&](supervisor::ControlAnswer& answer) {
    if (const auto* const record = std::get_if<supervisor::RecordAnswer>(&answer))
      for (const supervisor::Cell& cell : record->record)
        if (cell.name == "library") libraries.insert(cell.value);
  };
  (void)client.ask({"objects", {}, false}, take, kLimit);  // one that has ended is noticed elsewhere
  for (const std::string& library : libraries) load(library);
}

void learn_objects(const apps::Call& call) {
  std::variant<Descriptor, Failure> system = connect_to(call);
  if (auto* const found = std::get_if<Descriptor>(&system)) learn_objects(std::move(*found));
}

void learn_objects_in_folders(const apps::Call& call) {
  const plugin::PluginIndex index(call.folders("--plugins"));
  for (const std::string& library : index.object_libraries()) load(library);
}

}  // namespace orca::orcactl
