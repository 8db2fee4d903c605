// SPDX-License-Identifier: LGPL-3.0-or-later
#include "address_lookup.hpp"

#include <netdb.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <mutex>

namespace orca::hw::link {

struct AddressLookup::Request {
  std::string host;
  std::string port;
  addrinfo wanted{};
  gaicb entry{};
  int refused = 0;  // the system did not even begin

  ~Request() {
    if (entry.ar_result != nullptr) freeaddrinfo(entry.ar_result);
  }
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

// The system goes on writing into a search that it is busy with, so that one is kept until the process ends.
template <class Abandoned>
void keep_for_ever(Abandoned request) {
  static std::mutex mutex;
  static auto& kept = *new std::vector<Abandoned>;
  const std::lock_guard lock(mutex);
  kept.push_back(std::move(request));
}

Error not_resolved(const std::string& host, int fault) {
  const bool absent = fault == EAI_NONAME || fault == EAI_NODATA || fault == EAI_ADDRFAMILY;
  return fail(absent ? Code::not_found : Code::unavailable,
              "the host \"" + host + "\" has no address: " + gai_strerror(fault) +
                  "; check the name, the network, or write the address itself");
}

}  // namespace

AddressLookup::AddressLookup(const std::string& host, const std::string& port)
    : request_(std::make_unique<Request>()) {
  request_->host = host;
  request_->port = port;
  request_->wanted.ai_family = AF_UNSPEC;
  request_->wanted.ai_socktype = SOCK_STREAM;
  request_->entry.ar_name = request_->host.c_str();
  request_->entry.ar_service = request_->port.c_str();
  request_->entry.ar_request = &request_->wanted;
  gaicb* const entries[] = {&request_->entry};
  sigevent silent{};
  silent.sigev_notify = SIGEV_NONE;
  request_->refused = getaddrinfo_a(GAI_NOWAIT, const_cast<gaicb**>(entries), 1, &silent);
}

AddressLookup::~AddressLookup() {
  if (request_->refused != 0) return;
  if (gai_cancel(&request_->entry) == EAI_NOTCANCELED) keep_for_ever(std::move(request_));
}

Result<std::optional<std::vector<Address>>> AddressLookup::ask() {
  const int state = request_->refused != 0 ? request_->refused : gai_error(&request_->entry);
  if (state == EAI_INPROGRESS) return std::optional<std::vector<Address>>();
  if (state != 0) return not_resolved(request_->host, state);
  return std::optional(addresses_in(request_->entry.ar_result));
}

}  // namespace orca::hw::link
