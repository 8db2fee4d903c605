// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoint.hpp"

namespace orca {

void Provenance::begin_handling(const idl::OrcaObject& object) {
  mission_ = object.mission();
  note(object);
}

void Provenance::begin_task(const idl::OrcaObject& object) {
  task_mission_ = object.mission();
  begin_handling(object);
}

void Provenance::note(const idl::OrcaObject& received) {
  if (received.mission() != 0) mission_ = received.mission();
  if (origin_ != received.origin()) origin_ = received.origin();
  seq_ = received.seq();
}

void Provenance::stamp(idl::OrcaObject& sent) const {
  if (sent.mission() == 0) sent.mission(mission_);
  sent.cause().origin() = origin_;
  sent.cause().seq(seq_);
}

Endpoint::Endpoint(PortHome& home, PortContract contract) : home_(home), contract_(std::move(contract)) {}

void Endpoint::stamp(ObjectLoan& loan, const Provenance* provenance) {
  idl::OrcaObject& header = loan.header();
  header.creation_time().ns(home_.strand.executive().now().time_since_epoch().count());
  header.origin() = home_.component;
  header.seq(next_seq_++);
  if (provenance != nullptr) provenance->stamp(header);
}

}  // namespace orca
