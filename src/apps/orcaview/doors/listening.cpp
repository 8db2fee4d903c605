// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "doors/listening.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <ctime>
#include <memory>

#include "orca/base/files/key_folder.hpp"

namespace orca::view {
namespace {

namespace ip = boost::asio::ip;

std::string host_text(const ip::address& address) {
  return address.is_v6() ? "[" + address.to_string() + "]" : address.to_string();
}

// Returns an address to which pages can be at; nothing: loopback, or one that only the link knows.
std::optional<ip::address> address_of(const sockaddr& given) {
  if (given.sa_family == AF_INET) {
    const ip::address_v4 v4(ntohl(reinterpret_cast<const sockaddr_in&>(given).sin_addr.s_addr));
    if (!v4.is_loopback()) return v4;
  }
  if (given.sa_family == AF_INET6) {
    ip::address_v6::bytes_type bytes{};
    std::ranges::copy(reinterpret_cast<const sockaddr_in6&>(given).sin6_addr.s6_addr, bytes.begin());
    const ip::address_v6 v6(bytes);
    if (!v6.is_loopback() && !v6.is_link_local()) return v6;
  }
  return std::nullopt;
}

// Returns the addresses of this machine, those of version 4 first.
std::vector<std::string> own_addresses(bool with_v6) {
  std::vector<std::string> v4;
  std::vector<std::string> v6;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return v4;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, &freeifaddrs);
  for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || (at->ifa_flags & IFF_RUNNING) == 0) continue;
    const std::optional<ip::address> address = address_of(*at->ifa_addr);
    if (address) (address->is_v6() ? v6 : v4).push_back(host_text(*address));
  }
  if (with_v6) v4.insert(v4.end(), v6.begin(), v6.end());
  return v4;
}

// Returns the names of this machine: as it calls itself, and as neighbours find it by mDNS.
std::vector<std::string> host_names() {
  std::array<char, 256> text{};
  if (gethostname(text.data(), text.size() - 1) != 0) return {};
  std::string name = text.data();
  std::ranges::transform(name, name.begin(), [](unsigned char each) { return std::tolower(each); });
  const bool is_name = !name.empty() && std::ranges::all_of(name, [](unsigned char each) {
    return std::isalnum(each) != 0 || each == '-' || each == '.';
  });
  if (!is_name || name == "localhost") return {};
  if (name.find('.') != std::string::npos) return {name};
  return {name, name + ".local"};
}

}  // namespace

Result<Listening> parse_listening(std::string_view text) {
  const Error wrong = fail(Code::invalid_argument,
                           "--listen needs an address of this machine, such as 0.0.0.0 for all, "
                           "10.0.0.7:8443 or [fd00::7]:8443; this is: " +
                               std::string(text));
  std::string_view host = text;
  std::string_view port;
  const std::size_t colon = text.rfind(':');
  const bool has_port =
      text.starts_with('[') ? text.find("]:") != std::string_view::npos : std::ranges::count(text, ':') == 1;
  if (has_port) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
  }
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  boost::system::error_code error;
  Listening listening{ip::make_address(std::string(host), error)};
  if (error) return wrong;
  if (!has_port) return listening;
  std::uint16_t number = 0;
  const auto [end, fault] = std::from_chars(port.data(), port.data() + port.size(), number);
  if (fault != std::errc() || end != port.data() + port.size()) return wrong;
  listening.port = number;
  return listening;
}

std::vector<std::string> names_at(const ip::address& address) {
  std::vector<std::string> names =
      address.is_unspecified() ? own_addresses(address.is_v6()) : std::vector{host_text(address)};
  std::ranges::copy(host_names(), std::back_inserter(names));
  if (names.empty()) names.emplace_back("localhost");
  return names;
}

Result<keys::ServerCertificate> certificate_for(const Listening& listening,
                                                const std::optional<std::string>& own) {
  const std::int64_t now = std::time(nullptr);
  if (own) return keys::read_server_certificate(*own + "/" + keys::kServerCertificateFile, now);
  const Result<std::string> folder = config_folder();
  if (!folder) return folder.error();
  return keys::own_server_certificate(*folder + "/orcaview", names_at(listening.address), now);
}

}  // namespace orca::view
