// SPDX-License-Identifier: LGPL-3.0-or-later
#include "trace.hpp"

#include <chrono>
#include <cstdio>
#include <string>

#include "lock_before.hpp"
#include "orca/text/object_xml.hpp"

namespace orca::host {
namespace {

constexpr std::chrono::milliseconds kTraceLockLimit{200};

}  // namespace

Trace::Trace(const Executive& executive) : executive_(executive), start_(executive.now()) {}

Status Trace::open(const std::string& path, Detail detail) {
  detail_ = detail;
  const Status opened = file_.open(path);
  if (opened.ok()) file_.flush();  // so that nobody takes an older trace for that of a run that crashed
  writes_.store(opened.ok());
  return opened;
}

Status Trace::close() {
  const auto lock = lock_before(std::chrono::steady_clock::now() + kTraceLockLimit, mutex_);
  if (!lock.owns_lock()) return fail(Code::deadline_exceeded, "the end of the trace could not be written");
  writes_.store(false);
  return file_.close();
}

void Trace::write_line(std::initializer_list<std::string_view> parts) {
  if (!writes_) return;
  char time[32];
  std::snprintf(time, sizeof time, "%.6f", to_seconds(executive_.now() - start_));
  file_.write(time);
  for (const std::string_view part : parts) {
    file_.write(" ");
    file_.write(part);
  }
  file_.write("\n");
}

void Trace::serialize(const ObjectRef& object) {
  if (serialized_ == object) return;
  payload_.clear();
  object.type().serialize(object.get(), payload_);
  TraceHash hash;
  hash.add(payload_);
  hash_of_payload_ = hash.value();
  serialized_ = object;
}

void Trace::delivered(std::string_view component, std::string_view port, const ObjectRef& object) {
  if (!executive_.is_virtual() && !writes_) return;
  const std::lock_guard lock(mutex_);
  const idl::OrcaObject& header = object.header();
  const bool only_asks = header.origin() == kOutside && header.mission() == 0;
  if (executive_.is_virtual() && !only_asks) {
    serialize(object);
    hash_.add_u64(static_cast<std::uint64_t>(executive_.now().time_since_epoch().count()));
    hash_.add_text(component);
    hash_.add_text(port);
    hash_.add_u64(header.seq());
    hash_.add_u64(hash_of_payload_);
  }
  if (!writes_) return;
  const std::string value = detail_ == Detail::values ? " " + to_xml(object) : "";
  write_line({"deliver", component, port, std::to_string(header.seq()), object.type().name, "from",
              header.origin() + value});
}

void Trace::link_changed(std::string_view client, std::string_view server, bool connected) {
  const std::lock_guard lock(mutex_);
  write_line({connected ? "connect" : "disconnect", client, server});
}

void Trace::state_changed(std::string_view who, std::string_view from, std::string_view to) {
  const std::lock_guard lock(mutex_);
  write_line({"state", who, from, to});
}

void Trace::code_exchanged(std::string_view who, std::string_view was, std::string_view is, Duration pause) {
  char time[32];
  std::snprintf(time, sizeof time, "%.6f", to_seconds(pause));
  const std::lock_guard lock(mutex_);
  write_line({"exchange", who, was, is, time});
}

std::uint64_t Trace::hash() const {
  const std::lock_guard lock(mutex_);
  return hash_.value();
}

}  // namespace orca::host
