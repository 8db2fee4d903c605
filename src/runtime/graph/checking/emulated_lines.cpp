// SPDX-License-Identifier: LGPL-3.0-or-later
#include "checking/checks.hpp"

#include <algorithm>
#include <sstream>
#include <string>
#include <string_view>

#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "reading/codes.hpp"
#include "reading/parameters.hpp"

namespace orca::graph {
namespace {

constexpr std::string_view kScheme = "emulated:";
constexpr std::string_view kListens = "listen:";
constexpr const char* kOffer =
    "lines";  // the parameter of hardware that emulates devices: "KIND NAME; KIND NAME"

// Returns what a driver writes behind the scheme for a line with this name, or for listen:PORT.
std::string line_name_of(const std::string& place) {
  if (!place.starts_with(kListens)) return place;
  return "tcp:" + place.substr(place.find_last_of(':') + 1);
}

std::vector<std::string> offered_lines(const Model& model) {
  std::vector<std::string> names;
  for (const CheckedHardware& hardware : model.hardware) {
    const auto offer = hardware.value.params.find(kOffer);
    if (offer == hardware.value.params.end()) continue;
    const auto* const lines = std::get_if<std::string>(&offer->second);
    std::istringstream items(lines != nullptr ? *lines : "");
    for (std::string item; std::getline(items, item, ';');) {
      std::istringstream words(item);
      if (std::string kind, place; words >> kind >> place) names.push_back(line_name_of(place));
    }
  }
  return names;
}

void report_missing(const Node& node, const std::string& param, const std::string& name,
                    const std::vector<std::string>& offered, Report& report) {
  const std::string what = node.title() + ": parameter " + in_quotes(param) +
                           ": nothing in this graph emulates " + in_quotes(name);
  if (offered.empty())
    return report.warning(codes::kHardwareDoubts, place_of_param(node, param),
                          what + ", so another system must, or it waits in vain");
  const auto nearest = xml::nearest_name(name, offered);
  report.error(codes::kHardwareRefuses, place_of_param(node, param),
               what + (nearest ? xml::did_you_mean(nearest) : "; there are: " + listed(offered)));
}

}  // namespace

bool offers_lines(const HardwareNode& hardware) { return hardware.params.contains(kOffer); }

void check_emulated_lines(const std::vector<Node>& nodes, const Model& model, Report& report) {
  if (!std::ranges::all_of(model.hardware, &CheckedHardware::sound)) return;
  const std::vector<std::string> offered = offered_lines(model);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const auto& [param, value] : model.hardware[i].value.params) {
      const auto* const text = std::get_if<std::string>(&value);
      if (text == nullptr || !text->starts_with(kScheme)) continue;
      const std::string name = text->substr(kScheme.size());
      if (std::ranges::find(offered, name) == offered.end())
        report_missing(nodes[i], param, name, offered, report);
    }
}

}  // namespace orca::graph
