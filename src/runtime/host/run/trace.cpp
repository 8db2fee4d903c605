// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trace.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace orca::host {

Trace::Trace(const Executive& executive) : executive_(executive), start_(executive.now()) {}

Status Trace::open(const std::string& path) {
  file_.open(path);
  if (!file_)
    return fail(Code::unavailable, std::string("cannot write the trace: ") + std::strerror(errno), path);
  return ok();
}

template <class... Parts>
void Trace::write_line(std::string_view event, const Parts&... parts) {
  if (!file_.is_open()) return;
  char time[32];
  std::snprintf(time, sizeof time, "%.6f", to_seconds(executive_.now() - start_));
  file_ << time << ' ' << event;
  ((file_ << ' ' << parts), ...);
  file_ << '\n';
}

void Trace::serialize(const ObjectRef& object) {
  if (serialized_ == object) return;
  payload_.clear();
  object.type().serialize(object.get(), payload_);
  serialized_ = object;
}

void Trace::delivered(std::string_view component, std::string_view port, const ObjectRef& object) {
  if (!executive_.is_virtual() && !file_.is_open()) return;
  const std::lock_guard lock(mutex_);
  const idl::OrcaObject& header = object.header();
  if (executive_.is_virtual()) {
    serialize(object);
    hash_.add_u64(static_cast<std::uint64_t>(executive_.now().time_since_epoch().count()));
    hash_.add_text(component);
    hash_.add_text(port);
    hash_.add_u64(header.seq());
    hash_.add(payload_);
  }
  write_line("deliver", component, port, header.seq(), object.type().name, "from", header.origin());
}

void Trace::link_changed(std::string_view client, std::string_view server, bool connected) {
  const std::lock_guard lock(mutex_);
  write_line(connected ? "connect" : "disconnect", client, server);
}

void Trace::state_changed(std::string_view who, std::string_view from, std::string_view to) {
  const std::lock_guard lock(mutex_);
  write_line("state", who, from, to);
}

std::uint64_t Trace::hash() const {
  const std::lock_guard lock(mutex_);
  return hash_.value();
}

}  // namespace orca::host
