// SPDX-License-Identifier: GPL-3.0-or-later
#include "dds_links.hpp"

#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <utility>

namespace orca::test {
namespace {

constexpr std::uint32_t kFirstDomain = 100;  // not where people's systems are
constexpr std::uint32_t kDomains = 100;

void must(const Status& done) {
  if (!done.ok()) throw std::runtime_error(done.error().text());
}

}  // namespace

std::uint32_t dds_test_domain() {
  static const std::uint32_t domain = kFirstDomain + static_cast<std::uint32_t>(getpid()) % kDomains;
  return domain;
}

std::unique_ptr<DdsBackend> make_dds(const std::string& process, const std::string& run,
                                     const std::string& keys) {
  DdsOptions options;
  options.graph = "test";
  options.run = run;
  options.process = process;
  options.domain = dds_test_domain();
  options.keys = keys;
  auto made = open_dds(options);
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(made).value();
}

std::string fresh_run() {
  static std::atomic<int> runs{0};
  return std::to_string(getpid()) + "_" + std::to_string(++runs);
}

// Ends all help for a port's strand before the link's end itself goes, because the port destroys it first. The other
// ports of the strand go together with it.
class DdsLinks::Helped final : public LinkEnd {
 public:
  Helped(DdsLinks& links, Strand& strand) : links_(links), strand_(strand) {}
  ~Helped() override {
    const std::lock_guard lock(links_.mutex_);
    std::erase(links_.helped_, &strand_);
  }
  Helped(const Helped&) = delete;
  Helped& operator=(const Helped&) = delete;

 private:
  DdsLinks& links_;
  Strand& strand_;
};

DdsLinks::DdsLinks(Executive& executive, Help help, Duration servers_ahead, const std::string& keys)
    : executive_(executive),
      servers_ahead_(servers_ahead),
      servers_(make_dds("servers", run_, keys)),
      clients_(make_dds("clients", run_, keys)),
      end_(executive.make_event()) {
  if (help == Help::task) task_ = executive_.spawn({"helper", 0}, [this] { work(); });
}

DdsLinks::~DdsLinks() {
  ending_ = true;
  end_->notify();
  if (task_ != nullptr) task_->join_until(kForever);
}

void DdsLinks::work() {
  while (!ending_) {
    {
      const std::lock_guard lock(mutex_);
      for (Strand* strand : helped_) strand->take_in();
    }
    end_->wait_until(executive_.now() + 1ms);
  }
}

void DdsLinks::make_end(DdsBackend& backend, Endpoint& port, const DdsPeer& peer, const QueuePolicy& policy,
                        Duration base_period) {
  const std::lock_guard lock(mutex_);
  // A client that asks or sends looks for itself when it is used; meanwhile nobody else may move its connection.
  const auto* const movable = dynamic_cast<MovablePort*>(&port);
  const bool looks_itself =
      movable != nullptr && movable->can_move() && port.contract().pattern != Pattern::push;
  if (!looks_itself) {
    port.adopt(std::make_unique<Helped>(*this, port.home().strand));
    helped_.push_back(&port.home().strand);
  }
  must(backend.connect(port, peer, policy, base_period));
}

void DdsLinks::join(Endpoint& server, Endpoint& client, const QueuePolicy& policy, Duration base_period) {
  make_end(*servers_, server, {client.path(), "clients", {}, ++edges_}, policy, Duration{0});
  DdsPeer peer{server.path(), "servers", server.contract().type.name, edges_};
  if (servers_ahead_ != Duration{0}) peer.clock_ahead = [ahead = servers_ahead_] { return ahead; };
  make_end(*clients_, client, peer, policy, base_period);
  const auto limit = std::chrono::steady_clock::now() + 10s;
  while (!servers_->reaches("clients") || !clients_->reaches("servers")) {
    if (std::chrono::steady_clock::now() > limit) throw std::runtime_error("DDS joins nobody");
    std::this_thread::sleep_for(1ms);
  }
}

void DdsLinks::push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) {
  join(server, client, policy, server.base_period());
}

void DdsLinks::query(QueryClientEndpoint& client, QueryServerEndpoint& server) { join(server, client, {}); }

void DdsLinks::send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) {
  join(server, client, policy);
}

}  // namespace orca::test
