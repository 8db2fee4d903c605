// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/endpoint.hpp"

#include <cassert>
#include <utility>

#include "orca/base/activity.hpp"

namespace orca {
namespace {

constexpr std::size_t kCacheLine = 64;  // [bytes]

}  // namespace

Endpoint::Endpoint(PortHome& home, PortContract contract) : home_(home), contract_(std::move(contract)) {}

Endpoint::~Endpoint() {
  assert(link_ends_.empty());  // they would touch what has gone already
}

// The part of admits_caller() that strands do not need. A component that the main thread destroys has no strand
// any more.
bool Endpoint::admits_stranger() const {
  const Activity* const activity = Activity::current();
  if (activity != nullptr && activity->hook() == Hook::destructor) return true;
  if (LinkObserver* observer = home_.observer)
    observer->foreign_call(home_.component, contract_.name, home_.code.load(std::memory_order_acquire));
  return false;
}

Error Endpoint::foreign_call() const {
  return fail(Code::failed_precondition,
              path() +
                  " was called by a thread that runs no component; only the component's own hooks, laps and "
                  "handlers may call its ports");
}

void Endpoint::stamp(ObjectLoan& loan, const Provenance* provenance) {
  idl::OrcaObject& header = loan.header();
  // Filling in a large object has driven its header out of the caches; it comes back while the clock is read.
  for (std::size_t line = 0; line < sizeof header; line += kCacheLine)
    __builtin_prefetch(reinterpret_cast<const char*>(&header) + line, 1);
  header.creation_time().ns(home_.strand.executive().now().time_since_epoch().count());
  header.origin() = home_.component;
  header.origin_port() = contract_.name;
  header.seq(next_seq_++);
  home_.strand.note_activity();
  home_.strand.note_activity();
  if (provenance != nullptr) provenance->stamp(header);
}

}  // namespace orca
