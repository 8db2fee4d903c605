// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoint.hpp"

namespace orca {

void Provenance::note(const idl::OrcaObject& received) {
  mission = received.mission();
  origin = received.origin();
  seq = received.seq();
}

void Provenance::stamp(idl::OrcaObject& sent) const {
  if (sent.mission() == 0) sent.mission(mission);
  sent.cause().origin() = origin;
  sent.cause().seq(seq);
}

Endpoint::Endpoint(PortHome& home, PortContract contract) : home_(home), contract_(std::move(contract)) {}

void Endpoint::stamp(ObjectLoan& loan, const Provenance* provenance) {
  idl::OrcaObject& header = loan.header();
  header.creation_time().ns(home_.strand.executive().now().time_since_epoch().count());
  header.origin() = home_.component;
  header.seq(next_seq_++);
  home_.strand.note_activity();
  if (provenance != nullptr) provenance->stamp(header);
}

void Endpoint::observe(const ObjectRef& object) const {
  if (home_.observer != nullptr) home_.observer->delivered(home_.component, contract_.name, object);
}

}  // namespace orca
