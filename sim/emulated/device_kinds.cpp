// SPDX-License-Identifier: LGPL-3.0-or-later
#include "device_kinds.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <set>
#include <sstream>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/emulators/create2_firmware.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/emulators/rplidar_firmware.hpp"
#include "orca/emulators/sick_lms_firmware.hpp"
#include "orca/emulators/xr4000_firmware.hpp"
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
              wish.kind + " has no models; write " + in_quotes(wish.kind + " " + wish.line));
}

Made make_p2os(const DeviceWish& wish, WorldBody& body) {
  const std::string subclass = wish.model.empty() ? "p2dx" : wish.model;
  const auto settings = emulators::p2os_settings(subclass);
  if (!settings) return no_model(wish, emulators::p2os_subclasses());
  return Made(std::make_unique<emulators::P2osFirmware>(body, *settings));
}

// The whole robot, with its laser.
Made make_player(const DeviceWish& wish, WorldBody& body) {
  if (!wish.model.empty()) return only_one_model(wish);
  return Made(std::make_unique<emulators::PlayerFirmware>(body, emulators::PlayerSettings{}, &body));
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
  return fail(
      Code::invalid_argument,
      what +
          "; lines are a list such as \"p2os pioneer; player tcp:6665\": the kind of each device and "
          "its line, which is a name (emulated:NAME to the driver), tcp:PORT (emulated:tcp:127.0.0.1:PORT "
          "to the driver) or, with the address where clients are heard, tcp:0.0.0.0:PORT");
}

bool is_address(const std::string& text) {
  in_addr address{};
  return inet_pton(AF_INET, text.c_str(), &address) == 1;
}

// Reads what follows "tcp:".
Result<TcpPlace> read_place(const std::string& rest) {
  TcpPlace place;
  const std::size_t colon = rest.rfind(':');
  if (colon != std::string::npos) place.address = rest.substr(0, colon);
  const std::string digits = colon == std::string::npos ? rest : rest.substr(colon + 1);
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), place.port);
  if (fault != std::errc() || end != digits.data() + digits.size())
    return wrong(in_quotes(digits) + " is no port; ports are 1 to 65535, and 0 is any that is free");
  if (!is_address(place.address))
    return wrong(in_quotes(place.address) +
                 " is no IPv4 address of this machine; without one, clients on this machine are heard");
  return place;
}

Status read_line(DeviceWish& wish) {
  constexpr std::string_view kTcp = "tcp:";
  if (wish.line.starts_with(kTcp)) {
    Result<TcpPlace> place = read_place(wish.line.substr(kTcp.size()));
    if (place) wish.place = std::move(*place);
    return place ? ok() : Status(place.error());
  }
  const bool is_plain = std::ranges::all_of(wish.line, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return is_plain ? ok()
                  : Status(wrong(in_quotes(wish.line) + " is no name of a line: letters, digits, _ and -"));
}

Result<DeviceWish> read_device(const std::string& item) {
  std::istringstream words(item);
  DeviceWish wish;
  std::string more;
  words >> wish.kind >> wish.line;
  if (wish.line.empty() || words >> more) return wrong(in_quotes(item) + " is no kind and line");
  if (const std::size_t colon = wish.kind.find(':'); colon != std::string::npos) {
    wish.model = wish.kind.substr(colon + 1);
    wish.kind.resize(colon);
  }
  if (Status line = read_line(wish); !line.ok()) return line.error();
  return wish;
}

// Returns what no other line may have; empty: nothing.
std::string own_of(const DeviceWish& wish) {
  if (!wish.place) return "the name " + in_quotes(wish.line);
  return wish.place->port == 0 ? "" : "the port " + std::to_string(wish.place->port);
}

}  // namespace

Result<std::vector<DeviceWish>> read_devices(std::string_view text) {
  std::vector<DeviceWish> wishes;
  std::set<std::string> taken;
  std::istringstream items{std::string(text)};
  for (std::string item; std::getline(items, item, ';');) {
    if (item.find_first_not_of(" \t\n") == std::string::npos) continue;
    Result<DeviceWish> wish = read_device(item);
    if (!wish) return wish.error();
    const std::string own = own_of(*wish);
    if (!own.empty() && !taken.insert(own).second) return wrong("two lines have " + own);
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
