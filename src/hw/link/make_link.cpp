// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/link/make_link.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>
#include <string>

#include "orca/base/files/own_folder.hpp"
#include "orca/base/text.hpp"
#include "orca/hw/link/device_files.hpp"
#include "orca/hw/link/listen_link.hpp"
#include "orca/hw/link/memory_link.hpp"
#include "orca/hw/link/pty_link.hpp"
#include "orca/hw/link/replay_link.hpp"
#include "orca/hw/link/serial_link.hpp"
#include "orca/hw/link/tcp_link.hpp"
#include "serial_trouble.hpp"

namespace orca::hw::link {
namespace {

using Made = Result<std::unique_ptr<ByteLink>>;

constexpr Duration kEmulationStarts = 10s;  // another process may have to load a world first

constexpr const char* kEmulated = "emulated";

constexpr const char* kForms =
    "; a link is serial:/dev/ttyUSB0 (or the path alone), tcp:HOST:PORT, emulated:NAME, memory:NAME, "
    "pty:PATH, "
    "listen:PORT or replay:FILE";

Error wrong(std::string_view text, const std::string& what) {
  return fail(Code::invalid_argument, in_quotes(printable(text)) + " is no link: " + what + kForms);
}

struct Place {
  std::string_view host;
  std::string_view port;
};

// Splits HOST:PORT or [ADDRESS]:PORT; nothing: it is neither.
std::optional<Place> split(std::string_view rest) {
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos) return std::nullopt;
  Place place{rest.substr(0, colon), rest.substr(colon + 1)};
  const bool bracketed = place.host.starts_with('[') && place.host.ends_with(']');
  if (bracketed) place.host = place.host.substr(1, place.host.size() - 2);
  const bool has_colon = place.host.find(':') != std::string_view::npos;
  const bool has_bracket = place.host.find_first_of("[]") != std::string_view::npos;
  if (place.host.empty() || has_bracket || has_colon != bracketed) return std::nullopt;
  return place;
}

std::optional<std::uint16_t> read_port(std::string_view digits) {
  std::uint16_t port = 0;
  const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (fault != std::errc() || end != digits.data() + digits.size() || port == 0) return std::nullopt;
  return port;
}

Made make_tcp(std::string_view text, std::string_view rest, const LinkOptions& options) {
  const std::optional<Place> place = split(rest);
  if (!place) return wrong(text, "tcp needs a host and a port, with an IPv6 address in brackets");
  const std::optional<std::uint16_t> port = read_port(place->port);
  if (!port) return wrong(text, in_quotes(printable(place->port)) + " is no port; ports are 1 to 65535");
  return Made(std::make_unique<TcpLink>(TcpOptions{std::string(place->host), *port, options.connect_limit}));
}

Made make_listener(std::string_view text, std::string_view rest) {
  const bool is_port_alone = rest.find(':') == std::string_view::npos;
  const std::optional<Place> place = is_port_alone ? Place{"127.0.0.1", rest} : split(rest);
  if (!place) return wrong(text, "listen needs a port, or an address and a port: listen:0.0.0.0:6665");
  const std::optional<std::uint16_t> port = read_port(place->port);
  if (!port) return wrong(text, in_quotes(printable(place->port)) + " is no port; ports are 1 to 65535");
  return Made(std::make_unique<ListenLink>(ListenOptions{std::string(place->host), *port}));
}

Made make_serial(std::string_view device, const LinkOptions& options) {
  SerialOptions serial;
  serial.device = device;
  serial.line = options.line;
  return Made(std::make_unique<SerialLink>(std::move(serial)));
}

// Somebody else's folder could lead the driver to any line.
Status check_folder() {
  const Result<OwnFolder> folder = OwnFolder::open();
  return folder || folder.error().code == Code::not_found ? ok() : Status(folder.error());
}

Made make_memory(std::string_view name, const LinkOptions& options) {
  MemoryOptions memory;
  memory.name = name;
  memory.line = options.line;
  memory.patience = kEmulationStarts;
  memory.now = options.now;
  return Made(std::make_unique<MemoryLink>(std::move(memory)));
}

Made make_emulated(std::string_view text, std::string_view name, const LinkOptions& options) {
  if (options.is_virtual) return make_memory(name, options);
  constexpr std::string_view kTcp = "tcp:";
  if (name.starts_with(kTcp)) {
    const std::optional<std::uint16_t> port = read_port(name.substr(kTcp.size()));
    if (!port)
      return wrong(text,
                   in_quotes(printable(name.substr(kTcp.size()))) + " is no port; ports are 1 to 65535");
    return Made(
        std::make_unique<TcpLink>(TcpOptions{"127.0.0.1", *port, options.connect_limit, kEmulationStarts}));
  }
  if (name.find('/') != std::string_view::npos || name.starts_with('.'))
    return wrong(text, "the name of an emulation is no path");
  SerialOptions serial;
  serial.device = emulated_path(name);
  serial.check = check_folder;
  serial.line = options.line;
  serial.patience = kEmulationStarts;
  serial.now = options.now;
  return Made(std::make_unique<SerialLink>(std::move(serial)));
}

}  // namespace

std::string emulated_path(std::string_view name) {
  return OwnFolder::path_of_user() + "/" + kEmulated + "/" + std::string(name);
}

Status make_emulated_folder() {
  const Result<OwnFolder> folder = OwnFolder::make();
  if (!folder) return folder.error();
  if (mkdirat(folder->descriptor(), kEmulated, 0700) == 0 || errno == EEXIST) return ok();
  return fail(Code::unavailable,
              "cannot make " + folder->path() + "/" + kEmulated + ": " + std::strerror(errno));
}

bool fits_virtual_time(std::string_view text) {
  const std::string_view kind = text.substr(0, text.find(':'));
  return kind == kEmulated || kind == "memory" || kind == "replay";
}

std::string real_place(std::string_view text) {
  constexpr std::string_view kSerial = "serial:";
  const bool is_serial = text.starts_with('/') || text.starts_with(kSerial);
  if (!is_serial) return std::string(text);
  const std::string_view device = text.starts_with(kSerial) ? text.substr(kSerial.size()) : text;
  const std::string real = resolved(SerialPlaces(SerialOptions{}.folder).path_of(std::string(device)));
  return real.empty() ? std::string(text) : real;
}

Result<std::unique_ptr<ByteLink>> make_link(std::string_view text, const LinkOptions& options) {
  if (text.find_first_of(std::string_view("\0\n", 2)) != std::string_view::npos)
    return wrong(text, "it has a line break or a zero in it");
  if (text.starts_with('/')) return make_serial(text, options);
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return wrong(text, "it is no path and names no kind of link");
  const std::string_view kind = text.substr(0, colon);
  const std::string rest(text.substr(colon + 1));
  constexpr std::array<std::string_view, 7> kKinds{"serial", "tcp",    "emulated", "memory",
                                                   "pty",    "listen", "replay"};
  if (std::ranges::find(kKinds, kind) == kKinds.end())
    return wrong(text, "there is no kind " + in_quotes(printable(kind)));
  if (rest.empty()) return wrong(text, "nothing follows " + std::string(kind) + ":");
  if (kind == "serial") return make_serial(rest, options);
  if (kind == "tcp") return make_tcp(text, rest, options);
  if (kind == "emulated") return make_emulated(text, rest, options);
  if (kind == "memory") return make_memory(rest, options);
  if (kind == "listen") return make_listener(text, rest);
  if (kind == "pty") return Made(std::make_unique<PtyLink>(rest));
  return Made(std::make_unique<ReplayLink>(ReplayOptions{rest, options.now}));
}

}  // namespace orca::hw::link
