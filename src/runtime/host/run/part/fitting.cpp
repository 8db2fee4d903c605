// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/fitting.hpp"

#include <fcntl.h>

#include <span>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/host/catalogue.hpp"
#include "orca/host/last_words.hpp"
#include "orca/host/shadow.hpp"
#include "orca/plugin/trial.hpp"
#include "run/swap/fit.hpp"
#include "run/system/component_making.hpp"

namespace orca::host {
namespace {

using plugin::TrialResult;

constexpr Duration kLookLimit = 5s;  // for what one copy of the process looks at

// What the copy says of each type, in their order: a mark, then a text.
constexpr char kSound = 'l';
constexpr char kBroken = 'b';

// The place that the types are compared with.
struct FitPlace {
  const graph::Graph& graph;
  const ComponentSettings settings;
  const std::vector<PortContract>& ports;
};

// Returns what is to be said of a type. The plugin stays loaded, because the linker knows it by the number of its descriptor.
std::string look_at(const OfferedCode& code, const FitPlace& place) {
  const auto broken = [](const Error& error) { return kBroken + error.text(); };
  Descriptor file(open(code.file.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) return broken(fail(Code::not_found, "its file cannot be read"));
  auto& catalogue = *new PluginCatalogue(plugin::PluginIndex({}));
  Result<LoadedType>& type = *new Result<LoadedType>(
      catalogue.acquire({std::move(file), code.file}, PluginKind::component, code.type, plugin::Trial::done));
  if (!type) return broken(type.error());
  const Result<Contract> contract = plugin::describe_component(*type->entry, code.file, nullptr);
  if (!contract) return broken(contract.error());
  if (contract->needs_hardware) return kSound + std::string("it serves hardware");
  return kSound + joined(misfits_in(place.graph, place.settings, place.ports, contract->ports), "; ");
}

void look_at_all(std::span<const OfferedCode> all, const FitPlace& place, plugin::TrialLine& line) {
  LastWords::leave_copy();
  for (const OfferedCode& code : all) {
    line.step("the code of " + code.type);
    line.find(look_at(code, place));
  }
  line.end();
}

std::vector<OfferedCode> offers_of(const plugin::PluginIndex& index) {
  std::vector<OfferedCode> all;
  for (const std::string& type : index.types(PluginKind::component))
    if (const Result<std::string> file = index.file_of(type)) all.push_back({*file, type, {}});
  return all;
}

// Takes over what a copy has found. If it did not come to its end, the type that it stopped at is broken, unless it was only the last of
// many that took their time.
// @return how many types are settled.
std::size_t take(const TrialResult& looked, std::span<OfferedCode> left) {
  std::size_t count = 0;
  for (const std::string& finding : looked.findings) {
    left[count].is_broken = finding[0] == kBroken;
    left[count++].misfit = finding.substr(1);
  }
  if (looked.ending == TrialResult::Ending::well || count == left.size()) return left.size();
  if (looked.ending == TrialResult::Ending::too_long && count > 0) return count;
  left[count].is_broken = true;
  left[count].misfit = looked.last_step + " " + looked.text;
  return count + 1;
}

}  // namespace

Result<std::vector<OfferedCode>> compare_offers(const graph::Graph& graph, const std::string& component,
                                                const std::vector<PortContract>& ports,
                                                const plugin::PluginIndex& index,
                                                const std::function<bool()>& give_up) {
  if constexpr (!kTriesCode)
    return fail(Code::unimplemented, "ThreadSanitizer cannot follow a copy of a process");
  const graph::ComponentNode* const node = graph.find_component(component);
  if (node == nullptr) return fail(Code::not_found, "the graph has no such component", component);
  const FitPlace place{graph, settings_of(*node), ports};
  std::vector<OfferedCode> all = offers_of(index);
  for (std::span<OfferedCode> left(all); !left.empty();) {
    const TrialResult looked =
        plugin::run_trial([&](plugin::TrialLine& line) { look_at_all(left, place, line); }, kLookLimit,
                          plugin::Effects::none, give_up);
    if (looked.ending == TrialResult::Ending::silent) return fail(Code::unavailable, looked.text);
    left = left.subspan(take(looked, left));
  }
  return all;
}

}  // namespace orca::host
