// SPDX-License-Identifier: LGPL-3.0-or-later

/// @file
/// The link between ports of two processes of one machine: objects travel through rings in shared memory, encoded
/// straight into them and decoded straight out of them. There is no receiving thread. A component's strand takes in
/// what its rings hold when it waits or looks at a port, and the peer wakes it by its doorbell.
///
/// Each process makes its own end of an edge, from the same segment. The strand of the port needs a doorbell
/// (Strand::set_doorbell). Virtual time has no such links.
///
/// Thread contract of all functions here: before the component runs, or its strand between two laps.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "orca/base/doorbell.hpp"
#include "orca/base/result.hpp"
#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "orca/patterns/endpoints/query_client_endpoint.hpp"
#include "orca/patterns/endpoints/query_server_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_server_endpoint.hpp"
#include "orca/patterns/shm/ring_segment.hpp"

namespace orca {

/// The counters of one end, from its start until now. A plain value.
struct ShmCounters {
  std::uint64_t frames_received = 0;
  std::uint64_t objects_lost = 0;   ///< Pushed objects for which the ring had no room.
  std::uint64_t peers_cut_off = 0;  ///< How often the peer wrote what cannot be, or did not read.
};

/// The port at the other end of an edge, in another process.
struct ShmPeer {
  std::string path;        ///< "component.port".
  DoorbellWord* doorbell;  ///< Wakes its strand; outlives the end.
  /// Called when the peer has written what cannot be, and is cut off; may be empty. It must not block.
  /// @thread  the strand of this end's port.
  std::function<void(const Error& reason)> on_cut_off{};
};

/// One end of an edge, as the process that hosts it controls it. It belongs to its port.
///
/// Thread contract: any thread. Orders are carried out on the strand of the port, when it next waits or looks at a
/// port; the functions wake it.
class ShmEnd {
 public:
  virtual ~ShmEnd() = default;
  /// Cuts the link, because the peer is gone: open requests get an error that says why, a subscription of the peer
  /// ends, and what the peer had offered is withdrawn if it was not yet accepted.
  virtual void cut(Error reason) = 0;
  /// Gives the link a new peer, through a fresh segment. Subscriptions are made again. If the link is not cut, it is
  /// cut before.
  virtual void renew(RingSegment segment) = 0;
  /// Returns whether the link has no peer: it was cut, by this process or by the peer, and not renewed.
  [[nodiscard]] virtual bool is_cut() const = 0;
  [[nodiscard]] virtual ShmCounters counters() const = 0;
};

/// Makes one end of an edge. It is given to the port and lives as long as the port, or until Links::leave().
/// @param policy  of the edge, the same at both ends.
ShmEnd& make_shm_end(PushServerEndpoint& server, RingSegment segment, ShmPeer client,
                     const QueuePolicy& policy);
/// Likewise. @param base_period  of the server [s], as its contract says; 0: irregular. Later ones come with what it grants.
ShmEnd& make_shm_end(PushClientEndpoint& client, RingSegment segment, ShmPeer server,
                     const QueuePolicy& policy, Duration base_period);
ShmEnd& make_shm_end(QueryServerEndpoint& server, RingSegment segment, ShmPeer client);
ShmEnd& make_shm_end(QueryClientEndpoint& client, RingSegment segment, ShmPeer server);
ShmEnd& make_shm_end(SendServerEndpoint& server, RingSegment segment, ShmPeer client,
                     const QueuePolicy& policy);
ShmEnd& make_shm_end(SendClientEndpoint& client, RingSegment segment, ShmPeer server,
                     const QueuePolicy& policy);

}  // namespace orca
