// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/executive.hpp"
#include "orca/base/output_file.hpp"
#include "orca/base/result.hpp"
#include "orca/patterns/endpoints/link_observer.hpp"
#include "run/recording/trace_hash.hpp"

namespace orca::host {

/// The origin of what comes from outside the graph, from an operator.
inline constexpr std::string_view kOutside = "orcactl";

/// A recorder of what happens in a run. In virtual time it also computes the trace hash: TraceHash over (time in
/// ns, component, port, seq, hash of the XCDR1 payload) of every delivery, in delivery order. Questions from outside, which are nobody's
/// mission, are not among them.
///
/// The file has one line per event: time [s], what, who, details; a delivery's last words are the object itself
/// as text (docs/objects.md) if values are wanted.
///
/// Thread contract: any strand.
class Trace final : public LinkObserver {
 public:
  explicit Trace(const Executive& executive);

  enum class Detail { events, values };

  /// Starts to write a file as well.
  /// @errors  as OutputFile::open().
  Status open(const std::string& path, Detail detail = Detail::events);

  /// Writes the rest of the file and closes it. What comes later is not written any more. It does not wait for
  /// a strand that is stuck while it writes; the rest is lost then.
  /// @errors  unavailable with the system's reason if anything could not be written.
  Status close();

  void delivered(std::string_view component, std::string_view port, const ObjectRef& object) override;
  void link_changed(std::string_view client, std::string_view server, bool connected) override;
  void state_changed(std::string_view who, std::string_view from, std::string_view to);
  /// @param pause  time [s] in which neither of the two objects could work, until now.
  void code_exchanged(std::string_view who, std::string_view was, std::string_view is, Duration pause);

  [[nodiscard]] std::uint64_t hash() const;

 private:
  void serialize(const ObjectRef& object);
  void write_line(std::initializer_list<std::string_view> parts);

  const Executive& executive_;
  const TimePoint start_;
  mutable std::mutex mutex_;
  std::atomic<bool> writes_{false};
  Detail detail_ = Detail::events;
  OutputFile file_{"the trace"};
  TraceHash hash_;
  // The object whose payload is in payload_, so that an object with many readers is serialised and hashed once.
  ObjectRef serialized_;
  std::vector<std::byte> payload_;
  std::uint64_t hash_of_payload_ = 0;
};

}  // namespace orca::host
