// SPDX-License-Identifier: LGPL-3.0-or-later
#include "address_lookup.hpp"

#include <netdb.h>

#include <algorithm>
#include <cstring>
#include <mutex>
#include <thread>

namespace orca::hw::link {

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
