// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "orca/patterns/dds/dds_backend.hpp"
#include "orca/patterns/endpoints/links.hpp"

namespace orca::test {

/// Returns a new part in DDS, for a process of that name.
/// @param run   that no other test uses.
/// @param keys  folder with the keys of the process; empty: everything is plain.
std::unique_ptr<DdsBackend> make_dds(const std::string& process, const std::string& run,
                                     const std::string& keys = {});
/// Returns the DDS domain of this test program; the same in those that it forks afterwards.
std::uint32_t dds_test_domain();
/// Returns a name for a run that no other test uses.
std::string fresh_run();

/// Links through DDS whose two ends are in this process, as if they were in two: clients in one, servers in the other.
///
/// Strands that have no task of their own, because the test acts for them, take in nothing by themselves. As a rule a task
/// does that for them, every millisecond.
///
/// Thread contract: as Links. It must outlive the ports that it connects.
class DdsLinks final : public Links {
 public:
  /// Whether a task takes in for strands that have none of their own.
  enum class Help { task, none };
  /// @param servers_ahead  by how much the clients are to think that the clock of the servers is ahead [s].
  /// @param keys           folder with keys of the processes "servers" and "clients"; empty: everything is plain.
  explicit DdsLinks(Executive& executive, Help help = Help::task, Duration servers_ahead = Duration{0},
                    const std::string& keys = {});
  ~DdsLinks() override;

 private:
  class Helped;

  void push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) override;
  void query(QueryClientEndpoint& client, QueryServerEndpoint& server) override;
  void send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) override;

  void join(Endpoint& server, Endpoint& client, const QueuePolicy& policy,
            Duration base_period = Duration{0});
  void make_end(DdsBackend& backend, Endpoint& port, const DdsPeer& peer, const QueuePolicy& policy,
                Duration base_period);
  void work();

  Executive& executive_;
  const Duration servers_ahead_;
  const std::string run_ = fresh_run();
  const std::unique_ptr<DdsBackend> servers_;
  const std::unique_ptr<DdsBackend> clients_;

  std::uint64_t edges_ = 0;  // so far
  std::mutex mutex_;
  std::vector<Strand*> helped_;  // guarded by mutex_, as their intakes are
  std::atomic<bool> ending_{false};
  std::unique_ptr<Event> end_;
  std::unique_ptr<Task> task_;
};

}  // namespace orca::test
