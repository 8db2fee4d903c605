// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "orca/patterns/endpoints/links.hpp"

namespace orca {

namespace bytes {
class Courier;
}
namespace frames {
struct Traffic;
}

/// The counters of the links of one ByteLinks, from its start until now. A plain value.
struct ByteLinkCounters {
  std::uint64_t frames_received = 0;
  std::uint64_t objects_lost = 0;   ///< Pushed objects for which the link had no room.
  std::uint64_t peers_cut_off = 0;  ///< Ends whose peer sent what cannot be, or did not read.
};

/// Links between ports of one process that share nothing but bytes. Every object is written as CDR, passes
/// through a bounded queue of bytes, is carried by a thread unknown to any executive, and is read again at
/// the other end. Links to other processes differ only in the location of the queues. No run uses it yet; the
/// contract suite does.
///
/// Works with the steady clock only, because virtual time would not wait for the carrying thread.
/// Thread contract: as Links. It must outlive the ports that it connects.
class ByteLinks final : public Links {
 public:
  /// @param capacity [bytes] of each queue; an edge has two in each direction.
  ByteLinks(Executive& executive, std::size_t capacity);
  ~ByteLinks() override;

  /// @thread  any.
  [[nodiscard]] ByteLinkCounters counters() const;

 private:
  void push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) override;
  void query(QueryClientEndpoint& client, QueryServerEndpoint& server) override;
  void send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) override;

  Executive& executive_;
  const std::size_t capacity_;
  std::unique_ptr<frames::Traffic> traffic_;
  std::unique_ptr<bytes::Courier> courier_;
};

}  // namespace orca
