// SPDX-License-Identifier: LGPL-3.0-or-later
#include "player_uses.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "orca/base/text.hpp"

namespace orca::hw::player {
namespace {

struct PartName {
  std::string_view word;
  Part part;
  Interface interface;  // of its own
};
constexpr PartName kParts[] = {{"base", Part::base, Interface::position2d},
                               {"sonar", Part::sonar, Interface::sonar},
                               {"laser", Part::laser, Interface::laser},
                               {"bumper", Part::bumper, Interface::bumper},
                               {"power", Part::power, Interface::power}};

std::string_view interface_name(Interface interface) {
  if (interface == Interface::position2d) return "position2d";
  if (interface == Interface::ranger) return "ranger";
  const auto* const own = std::ranges::find(kParts, interface, &PartName::interface);
  return own != std::end(kParts) ? own->word : "interface";
}

// Sonars and lasers may be rangers, too.
std::optional<Interface> interface_of(const PartName& part, std::string_view word) {
  const bool may_be_ranger = part.part == Part::sonar || part.part == Part::laser;
  if (may_be_ranger && word == interface_name(Interface::ranger)) return Interface::ranger;
  if (word == interface_name(part.interface)) return part.interface;
  return std::nullopt;
}

// Of PART or PART=INTERFACE:NUMBER.
std::optional<Use> read_use(std::string_view word) {
  const std::size_t equals = word.find('=');
  const auto* const part = std::ranges::find(kParts, word.substr(0, equals), &PartName::word);
  if (part == std::end(kParts)) return std::nullopt;
  if (equals == std::string_view::npos) return Use{part->part, part->interface, 0};
  const std::string_view device = word.substr(equals + 1);
  const std::size_t colon = device.find(':');
  const auto interface = interface_of(*part, device.substr(0, colon));
  if (!interface || colon == std::string_view::npos) return std::nullopt;
  Use use{part->part, *interface, 0};
  const std::string_view number = device.substr(colon + 1);
  const auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), use.index);
  if (problem != std::errc() || end != number.data() + number.size()) return std::nullopt;
  return use;
}

}  // namespace

std::string device_name(const Use& use) {
  return std::string(interface_name(use.interface)) + ":" + std::to_string(use.index);
}

std::vector<Use> read_uses(const std::string& text, std::vector<HardwareFault>& faults) {
  std::vector<Use> uses{Use{}};
  std::istringstream words(text);
  bool has_base = false;
  for (std::string word; words >> word;) {
    const std::optional<Use> use = read_use(word);
    if (!use) {
      faults.push_back({"uses", in_quotes(word) +
                                    " is none of sonar, laser, bumper, power; write some of them with blanks "
                                    "between, or, if a device is not number 0 of its own interface, "
                                    "laser=laser:1, sonar=ranger:0, laser=ranger:1, base=position2d:1"});
    } else if (use->part == Part::base) {
      if (!std::exchange(has_base, true)) uses.front() = *use;
    } else if (std::ranges::find(uses, use->part, &Use::part) == uses.end()) {
      uses.push_back(*use);
    }
  }
  return uses;
}

}  // namespace orca::hw::player
