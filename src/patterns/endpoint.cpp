// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoint.hpp"

namespace orca {
namespace {

constexpr std::size_t kCacheLine = 64;  // [bytes]

}  // namespace

void Provenance::begin_handling(const idl::OrcaObject& object) {
  mission_ = object.mission();
  note(object);
}

void Provenance::begin_task(const idl::OrcaObject& object) {
  task_mission_ = object.mission();
  begin_handling(object);
}

void Provenance::note(const idl::OrcaObject& received) {
  if (const std::uint64_t mission = received.mission(); mission != 0) mission_ = mission;
  if (const std::string& origin = received.origin(); origin_ != origin) origin_ = origin;
  seq_ = received.seq();
}

void Provenance::stamp(idl::OrcaObject& sent) const {
  if (mission_ != 0 && sent.mission() == 0) sent.mission(mission_);
  if (seq_ == 0) return;  // nothing was received yet
  idl::Cause& cause = sent.cause();
  cause.origin() = origin_;
  cause.seq(seq_);
}

Endpoint::Endpoint(PortHome& home, PortContract contract) : home_(home), contract_(std::move(contract)) {}

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
