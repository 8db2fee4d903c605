// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/endpoints/provenance.hpp"

namespace orca {

void Provenance::begin_lap() {
  mission_ = task_mission_;
  settled_ = mission_ != 0;
}

void Provenance::begin_handling(const idl::OrcaObject& object) {
  mission_ = object.mission();
  settled_ = mission_ != 0;
  note(object);
}

void Provenance::begin_task(const idl::OrcaObject& object) {
  mission_before_task_ = task_mission_;
  task_mission_ = object.mission();
  begin_handling(object);
}

void Provenance::begin_mission(std::uint64_t mission) {
  task_mission_ = mission;
  begin_lap();
}

void Provenance::note(const idl::OrcaObject& received) {
  if (const std::uint64_t mission = received.mission(); mission != 0 && !settled_) mission_ = mission;
  if (const std::string& origin = received.origin(); origin_ != origin) origin_ = origin;
  if (const std::string& port = received.origin_port(); port_ != port) port_ = port;
  seq_ = received.seq();
}

void Provenance::stamp(idl::OrcaObject& sent) const {
  if (mission_ != 0 && sent.mission() == 0) sent.mission(mission_);
  if (seq_ == 0) return;  // nothing was received yet
  idl::Cause& cause = sent.cause();
  cause.origin() = origin_;
  cause.port() = port_;
  cause.seq(seq_);
}

}  // namespace orca
