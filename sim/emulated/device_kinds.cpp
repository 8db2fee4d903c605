// SPDX-License-Identifier: LGPL-3.0-or-later
#include "device_kinds.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <sstream>
#include <utility>

#include "device_line.hpp"
#include "orca/base/text.hpp"
#include "orca/emulators/create2_firmware.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "orca/emulators/sick_lms_firmware.hpp"
#include "orca/emulators/xr4000_firmware.hpp"
#include "orca/hw/link/make_link.hpp"
#include "orca/xml/names.hpp"

namespace orca::sim {
namespace {

using Made = Result<std::unique_ptr<emulators::Firmware>>;

struct Kind {
  std::string_view name;
  Made (*make)(const DeviceWish& wish, WorldBody& body);
};

Error no_model(const DeviceWish& wish, const std::vector<std::string>& models) {
  return fail(Code::invalid_argument, "there is no model " + in_quotes(wish.model) + " of " + wish.kind +
                                          "; models: " + listed(models) +
                                          xml::did_you_mean(xml::nearest_name(wish.model, models)));
}

Error only_one_model(const DeviceWish& wish) {
  return fail(Code::invalid_argument,
              wish.kind + " has no models; write " + in_quotes(wish.kind + " " + wish.place));
}

Made make_p2os(const DeviceWish& wish, WorldBody& body) {
  const std::string subclass = wish.model.empty() ? "p2dx" : wish.model;
  const auto settings = emulators::p2os_settings(subclass);
  if (!settings) return no_model(wish, emulators::p2os_subclasses());
  return Made(std::make_unique<emulators::P2osFirmware>(body, *settings));
}

// The whole robot, with its laser.
Made make_player(const DeviceWish& wish, WorldBody& body) {
  const bool is_stage = wish.model == "stage";
  if (!wish.model.empty() && !is_stage) return no_model(wish, {"stage"});
  return Made(std::make_unique<emulators::PlayerFirmware>(
      body, emulators::PlayerSettings{.shows_rangers = is_stage}, &body));
}

// Makes the firmware of a device of which there is one model.
template <class Firmware>
Made make_only(const DeviceWish& wish, WorldBody& body) {
  if (!wish.model.empty()) return only_one_model(wish);
  return Made(std::make_unique<Firmware>(body));
}

constexpr std::array kKinds = {Kind{"create2", make_only<emulators::Create2Firmware>},
                               Kind{"nomad_scout", make_only<emulators::NomadScoutFirmware>},
                               Kind{"p2os", make_p2os},
                               Kind{"player", make_player},
                               Kind{"rplidar", make_only<emulators::RplidarFirmware>},
                               Kind{"sick_lms", make_only<emulators::SickLmsFirmware>},
                               Kind{"xr4000", make_only<emulators::Xr4000Firmware>}};

Error wrong(const std::string& what) {
  return fail(Code::invalid_argument,
              what +
                  "; lines are a list such as \"p2os pioneer; sick_lms pioneer_laser\": the kind of each "
                  "device and the name of its line, which is emulated:NAME to the driver, or listen:PORT, "
                  "which is emulated:tcp:PORT to it");
}

Result<DeviceWish> read_device(const std::string& item) {
  std::istringstream words(item);
  DeviceWish wish;
  std::string more;
  words >> wish.kind >> wish.place;
  if (wish.place.empty() || words >> more) return wrong(in_quotes(item) + " is no kind and name");
  if (const std::size_t colon = wish.kind.find(':'); colon != std::string::npos) {
    wish.model = wish.kind.substr(colon + 1);
    wish.kind.resize(colon);
  }
  if (wish.place.starts_with(kListens)) {
    const auto link = hw::link::make_link(wish.place);
    return link ? Result<DeviceWish>(wish) : wrong(link.error().message);
  }
  const bool is_plain = std::ranges::all_of(wish.place, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  if (!is_plain) return wrong(in_quotes(wish.place) + " is no name of a line: letters, digits, _ and -");
  return wish;
}

}  // namespace

Result<std::vector<DeviceWish>> read_devices(std::string_view text) {
  std::vector<DeviceWish> wishes;
  std::set<std::string> names;
  std::istringstream items{std::string(text)};
  for (std::string item; std::getline(items, item, ';');) {
    if (item.find_first_not_of(" \t\n") == std::string::npos) continue;
    Result<DeviceWish> wish = read_device(item);
    if (!wish) return wish.error();
    if (!names.insert(wish->place).second) return wrong("two lines have the name " + in_quotes(wish->place));
    wishes.push_back(std::move(*wish));
  }
  if (wishes.empty()) return wrong("no device is named");
  return wishes;
}

Made make_firmware(const DeviceWish& wish, WorldBody& body) {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) {
    if (kind.name == wish.kind) return kind.make(wish, body);
    names.emplace_back(kind.name);
  }
  return fail(Code::invalid_argument, "there is no emulation of " + in_quotes(wish.kind) +
                                          "; kinds: " + listed(names) +
                                          xml::did_you_mean(xml::nearest_name(wish.kind, names)));
}

}  // namespace orca::sim
