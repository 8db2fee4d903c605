// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// The link between ports of two processes through DDS, of one machine or of several.
///
/// The objects of a Push port travel on the topic orca/GRAPH/COMPONENT/PORT as plain XCDR1 of the port's IDL type, so that
/// any DDS program can read them. Everything else travels as messages between the two processes.
///
/// The link is a library of its own, liborca_dds.so, which a process opens when it has an edge that needs it
/// (open_dds()), and never closes. This header needs nothing of it.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/patterns/endpoints/endpoint.hpp"

namespace orca {

/// The settings of a process's part in DDS.
struct DdsOptions {
  std::string graph;    ///< Name of the graph, for topics.
  std::string run;      ///< The same in all processes of a run, and in no other run.
  std::string process;  ///< Name of this process in the graph.
  /// Address of the network interface; others are not used. Empty: all are.
  std::string address = "127.0.0.1";
  std::vector<std::string> others{};  ///< Addresses of other machines, which are asked besides a multicast.
  std::uint32_t domain = 0;
  /// Folder with the keys of this machine's processes (orca/keys/key_folder.hpp). Empty: everything is plain.
  std::string keys{};
  Duration liveliness{300ms};  ///< A process that gives no sign of life for this long [s] is lost.
};

/// The port at the other end of an edge.
struct DdsPeer {
  std::string path;     ///< "component.port".
  std::string process;  ///< The one that it is in.
  std::string type;     ///< IDL name of the type that a Push server declares; otherwise not needed.
  std::uint64_t edge =
      0;  ///< Tells edges between the same ports apart, if there is more than one in the life of both.
  /// Returns by how much the peer's clock is ahead of this process's at present [s], as far as the instants in its objects are to be
  /// corrected; none: they have one clock. Any thread.
  std::function<Duration()> clock_ahead{};
};

/// This process's part in DDS: all ends of its edges.
///
/// Thread contract: connect() before the components run; cut() from any thread. It outlives the ports.
class DdsBackend {
 public:
  virtual ~DdsBackend() = default;

  /// Makes this process's end of an edge. It is given to the port and lives as long as the port. Both ends may be made in
  /// any order, and at any time. Subscriptions stand again by themselves after the peer was lost.
  /// @param policy       of the edge, the same at both ends.
  /// @param base_period  of the server of Push [s], as its contract says; 0: irregular.
  /// @errors  unavailable if DDS refuses; invalid_argument if the port has more than 62 edges of this kind.
  virtual Status connect(Endpoint& port, const DdsPeer& peer, const QueuePolicy& policy,
                         Duration base_period) = 0;

  /// Says that a process is gone: what waits for it gets an error that says why. If it lives nevertheless, the edges are
  /// soon made again.
  virtual void cut(const std::string& process, const Error& reason) = 0;

  /// Returns whether that process is there and has answered.
  /// @thread  any.
  [[nodiscard]] virtual bool reaches(const std::string& process) const = 0;
};

/// Opens the library of the link, if this process has not done so yet, and takes part in DDS.
/// @errors  unavailable if there is no such library, or if DDS does not start.
[[nodiscard]] Result<std::unique_ptr<DdsBackend>> open_dds(const DdsOptions& options);

/// The result of the library's function.
using MadeDdsBackend = std::optional<Result<std::unique_ptr<DdsBackend>>>;
/// The one function that the library exports, as orca_make_dds_backend.
using MakeDdsBackend = void(const DdsOptions& options, MadeDdsBackend& made);

}  // namespace orca
