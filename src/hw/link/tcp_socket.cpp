// SPDX-License-Identifier: LGPL-3.0-or-later
#include "tcp_socket.hpp"

#include <linux/sockios.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <algorithm>
#include <cstring>
#include <mutex>
#include <thread>

namespace orca::hw::link {
namespace {

void set_number(int socket, int level, int option, int value) {
  (void)setsockopt(socket, level, option, &value, sizeof value);
}

constexpr int kSendBuffer = 16384;  // [bytes]

}  // namespace

void keep_fresh(int socket) {
  set_number(socket, SOL_SOCKET, SO_SNDBUF, kSendBuffer);
  set_number(socket, IPPROTO_TCP, TCP_NODELAY, 1);
  set_number(socket, SOL_SOCKET, SO_KEEPALIVE, 1);
  set_number(socket, IPPROTO_TCP, TCP_KEEPIDLE, 2);   // [s]
  set_number(socket, IPPROTO_TCP, TCP_KEEPINTVL, 1);  // [s]
  set_number(socket, IPPROTO_TCP, TCP_KEEPCNT, 3);
  set_number(socket, IPPROTO_TCP, TCP_USER_TIMEOUT, 5000);  // [ms]
}

std::size_t unsent_bytes(int socket) {
  int unsent = 0;
  if (socket < 0 || ioctl(socket, SIOCOUTQNSD, &unsent) != 0 || unsent < 0) return 0;
  return static_cast<std::size_t>(unsent);
}

std::string with_port(const std::string& address, std::uint16_t port) {
  const bool v6 = address.find(':') != std::string::npos;
  return (v6 ? "[" + address + "]" : address) + ":" + std::to_string(port);
}

struct AddressLookup::Search {
  const std::string host;
  const std::string port;
  std::mutex mutex;
  bool done = false;               // protected by mutex, as what follows
  int fault = 0;                   // of getaddrinfo()
  std::vector<Address> addresses;  // without a fault at least one

  Search(std::string name, std::string number) : host(std::move(name)), port(std::move(number)) {}
  void run(int flags);
};

namespace {

std::vector<Address> addresses_in(const addrinfo* first) {
  std::vector<Address> all;
  for (const addrinfo* at = first; at != nullptr; at = at->ai_next) {
    Address address;
    address.size = std::min<socklen_t>(at->ai_addrlen, sizeof address.place);
    std::memcpy(&address.place, at->ai_addr, address.size);
    all.push_back(address);
  }
  return all;
}

Error not_resolved(const std::string& host, int fault) {
  const bool absent = fault == EAI_NONAME || fault == EAI_NODATA || fault == EAI_ADDRFAMILY;
  return fail(absent ? Code::not_found : Code::unavailable,
              "the host \"" + host + "\" has no address: " + gai_strerror(fault) +
                  "; check the name, the network, or write the address itself");
}

}  // namespace

void AddressLookup::Search::run(int flags) {
  addrinfo wanted{};
  wanted.ai_flags = flags;
  wanted.ai_family = AF_UNSPEC;
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int result = getaddrinfo(host.c_str(), port.c_str(), &wanted, &found);
  const std::lock_guard lock(mutex);
  done = true;
  fault = result;
  if (result != 0) return;
  addresses = addresses_in(found);
  freeaddrinfo(found);
}

AddressLookup::AddressLookup(const std::string& host, const std::string& port)
    : search_(std::make_shared<Search>(host, port)) {
  search_->run(AI_NUMERICHOST);
  if (search_->fault == 0) return;
  search_->done = false;
  std::thread([search = search_] { search->run(0); }).detach();
}

AddressLookup::~AddressLookup() = default;

Result<std::optional<std::vector<Address>>> AddressLookup::ask() const {
  const std::lock_guard lock(search_->mutex);
  if (!search_->done) return std::optional<std::vector<Address>>();
  if (search_->fault != 0) return not_resolved(search_->host, search_->fault);
  return std::optional(search_->addresses);
}

}  // namespace orca::hw::link
