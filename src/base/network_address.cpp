// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/network_address.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <chrono>
#include <memory>
#include <thread>

namespace orca {
namespace {

constexpr auto kPause = std::chrono::milliseconds(100);

std::string text_of(const sockaddr& address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  const auto& v4 = reinterpret_cast<const sockaddr_in&>(address);
  return inet_ntop(AF_INET, &v4.sin_addr, text.data(), text.size()) == nullptr ? "" : text.data();
}

// Looks for an IPv4 address of this machine, by the name of its interface or as a text.
Result<std::string> find_running(const std::string& interface, const std::string& address) {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0)
    return fail(Code::unavailable, "the system does not list its network interfaces");
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> owner(first, &freeifaddrs);
  const std::string what = interface.empty() ? "network interface with the address " + address
                                             : "network interface \"" + interface + "\" with an IPv4 address";
  Error error = fail(Code::unavailable, "there is no " + what);
  for (const ifaddrs* at = first; at != nullptr; at = at->ifa_next) {
    if (at->ifa_addr == nullptr || at->ifa_addr->sa_family != AF_INET) continue;
    const std::string text = text_of(*at->ifa_addr);
    if (interface.empty() ? text != address : at->ifa_name != interface) continue;
    if ((at->ifa_flags & IFF_UP) != 0 && (at->ifa_flags & IFF_RUNNING) != 0) return text;
    error = fail(Code::unavailable, "the " + what + " is not connected");
  }
  return error;
}

Result<std::string> try_own_address(const std::string& interface, const std::string& address) {
  if (!interface.empty()) return find_running(interface, "");
  if (address.empty()) return std::string();
  const Result<std::string> number = address_of_host(address);
  return number ? find_running("", *number) : number;
}

}  // namespace

Result<std::string> own_address(const std::string& interface, const std::string& address, Duration patience) {
  const auto end = std::chrono::steady_clock::now() + patience;
  for (;;) {
    Result<std::string> found = try_own_address(interface, address);
    if (found || std::chrono::steady_clock::now() >= end) return found;
    std::this_thread::sleep_for(kPause);
  }
}

Result<std::string> address_of_host(const std::string& host) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  addrinfo* found = nullptr;
  if (const int fault = getaddrinfo(host.c_str(), nullptr, &wanted, &found); fault != 0)
    return fail(Code::unavailable, "\"" + host + "\" has no IPv4 address: " + gai_strerror(fault));
  const std::unique_ptr<addrinfo, decltype(&freeaddrinfo)> owner(found, &freeaddrinfo);
  return text_of(*found->ai_addr);
}

}  // namespace orca
