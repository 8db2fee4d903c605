// SPDX-License-Identifier: GPL-3.0-or-later
#include "shm_links.hpp"

#include <utility>

#include "bulk_pools.hpp"

namespace orca::test {

// Ends the help for an end before the end itself goes, because the port destroys it first.
class ShmLinks::Helped final : public LinkEnd {
 public:
  explicit Helped(ShmLinks& links) : links_(links) {}
  ~Helped() override {
    const std::lock_guard lock(links_.mutex_);
    std::erase(links_.helped_, intake_);
  }
  void begin(Intake& intake) {
    intake_ = &intake;
    const std::lock_guard lock(links_.mutex_);
    links_.helped_.push_back(intake_);
  }
  Helped(const Helped&) = delete;
  Helped& operator=(const Helped&) = delete;

 private:
  ShmLinks& links_;
  Intake* intake_ = nullptr;
};

namespace {

RingSegment map(const MemoryFile& file) { return RingSegment::map(file.descriptor()).value(); }

}  // namespace

ShmLinks::ShmLinks(Executive& executive, std::size_t capacity)
    : executive_(executive), capacity_(capacity), end_(executive.make_event()) {
  provide_to_itself();
  task_ = executive_.spawn({"helper", 0}, [this] { work(); });
}

ShmLinks::~ShmLinks() {
  ending_ = true;
  end_->notify();
  task_->join_until(kForever);
}

void ShmLinks::work() {
  while (!ending_) {
    {
      const std::lock_guard lock(mutex_);
      for (Intake* intake : helped_) intake->take_in();
    }
    end_->wait_until(executive_.now() + 1ms);
  }
}

MemoryFile ShmLinks::make_file() const { return RingSegment::create("test", capacity_).value(); }

ShmPeer ShmLinks::peer(Endpoint& port) {
  Strand& strand = port.home().strand;
  if (strand.doorbell() == nullptr) strand.set_doorbell(bells_.emplace_back(0U));
  return {port.path(), strand.doorbell()};
}

template <class Port, class... Arguments>
void ShmLinks::make_end(Port& port, const MemoryFile& file, Endpoint& other, const Arguments&... arguments) {
  auto helped = std::make_unique<Helped>(*this);
  Helped& help = *helped;
  port.adopt(std::move(helped), other.path());
  help.begin(dynamic_cast<Intake&>(make_shm_end(port, map(file), peer(other), arguments...)));
}

void ShmLinks::push(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy) {
  const MemoryFile file = make_file();
  make_end(server, file, client, policy);
  make_end(client, file, server, policy, server.base_period());
}

void ShmLinks::query(QueryClientEndpoint& client, QueryServerEndpoint& server) {
  const MemoryFile file = make_file();
  make_end(server, file, client);
  make_end(client, file, server);
}

void ShmLinks::send(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy) {
  const MemoryFile file = make_file();
  make_end(server, file, client, policy);
  make_end(client, file, server, policy);
}

}  // namespace orca::test
