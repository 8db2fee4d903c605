// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/endpoint.hpp"

#include <cassert>
#include <utility>

namespace orca {
namespace {

constexpr std::size_t kCacheLine = 64;  // [bytes]

}  // namespace

Endpoint::Endpoint(PortHome& home, PortContract contract) : home_(home), contract_(std::move(contract)) {}

Endpoint::~Endpoint() {
  assert(link_ends_.empty());  // they would touch what has gone already
}

void Endpoint::stamp(ObjectLoan& loan, const Provenance* provenance) {
  idl::OrcaObject& header = loan.header();
  // Filling in a large object has driven its header out of the caches; it comes back while the clock is read.
  for (std::size_t line = 0; line < sizeof header; line += kCacheLine)
    __builtin_prefetch(reinterpret_cast<const char*>(&header) + line, 1);
  header.creation_time().ns(home_.strand.executive().now().time_since_epoch().count());
  header.origin() = home_.component;
  header.seq(next_seq_++);
  home_.strand.note_activity();
  home_.strand.note_activity();
  if (provenance != nullptr) provenance->stamp(header);
}

}  // namespace orca
