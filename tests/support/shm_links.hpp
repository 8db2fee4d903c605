// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <vector>

#include "orca/patterns/endpoints/links.hpp"
#include "orca/patterns/shm/shm_edges.hpp"

namespace orca::test {

/// Links through shared memory whose two ends are in this process, as if they were in two.
///
/// Strands that have no task of their own, because the test acts for them, take in nothing by themselves. A task does
/// that for them, every millisecond.
///
/// Thread contract: as Links. It must outlive the ports that it connects.
class ShmLinks final : public Links {
 public:
  explicit ShmLinks(Executive& executive, std::size_t capacity = RingSegment::kDefaultCapacity);
  ~ShmLinks() override;

 private:
  class Helped;

  void push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) override;
  void query(QueryClientEndpoint& client, QueryServerEndpoint& server) override;
  void send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) override;

  [[nodiscard]] MemoryFile make_file() const;
  ShmPeer peer(Endpoint& port);
  template <class Port, class... Arguments>
  void make_end(Port& port, const MemoryFile& file, Endpoint& other, const Arguments&... arguments);
  void work();

  Executive& executive_;
  const std::size_t capacity_;
  std::deque<DoorbellWord> bells_;

  std::mutex mutex_;
  std::vector<Intake*> helped_;  // guarded by mutex_
  std::atomic<bool> ending_{false};
  std::unique_ptr<Event> end_;
  std::unique_ptr<Task> task_;
};

}  // namespace orca::test
