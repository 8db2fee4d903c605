// SPDX-License-Identifier: LGPL-3.0-or-later
#include "outer_offers.hpp"

#include <optional>
#include <string>
#include <utility>

#include "orca/base/mutex.hpp"
#include "orca/idl/time.hpp"
#include "orca/patterns/endpoints/query_server_endpoint.hpp"
#include "orca/patterns/endpoints/send_server_endpoint.hpp"
#include "run/recording/trace.hpp"

namespace orca::host {
namespace {

Result<ObjectRef> with_object(const Status& outcome) {
  if (!outcome.ok()) return outcome.error();
  return ObjectRef{};
}
Result<ObjectRef> with_object(Result<ObjectRef> answer) { return answer; }

// An operator is to know whether his object was taken, and not only that it waits to be handled.
QueuePolicy confirming(QueuePolicy policy) {
  policy.confirm = QueuePolicy::Confirm::handled;
  return policy;
}

}  // namespace

class OuterOffers::Edge {
 public:
  virtual ~Edge() = default;
  virtual void offer(const ObjectRef& object, Answered answered) = 0;
};

// The edge to one port. The answers come on the port's strand.
template <class Answer>
class OuterOffers::EdgeOf final : public Edge, public ReplySink<Answer> {
 public:
  explicit EdgeOf(RequestTarget<Answer>& target) : target_(target) {}

  void offer(const ObjectRef& object, Answered answered) override {
    RequestId id = 0;
    {
      const MutexLock lock(mutex_);
      id = ++last_id_;
      waiting_.emplace(id, std::move(answered));
    }
    if (std::optional<Answer> at_once = target_.offer(object, *this, id, false))
      reply(id, std::move(*at_once));
  }

  void reply(RequestId id, Answer answer) override {
    Answered taker;
    {
      const MutexLock lock(mutex_);
      auto found = waiting_.extract(id);
      if (found.empty()) return;
      taker = std::move(found.mapped());
    }
    taker(with_object(std::move(answer)));
  }

 private:
  RequestTarget<Answer>& target_;
  Mutex mutex_;
  std::map<RequestId, Answered> waiting_ ORCA_GUARDED_BY(mutex_);
  RequestId last_id_ ORCA_GUARDED_BY(mutex_) = 0;
};

OuterOffers::OuterOffers(const Executive& executive, std::atomic<std::uint64_t>* missions)
    : executive_(executive), missions_(missions) {}

OuterOffers::~OuterOffers() = default;

Result<OuterOffers::Edge*> OuterOffers::edge_at(Endpoint& port) {
  const auto known = edges_.find(&port);
  if (known != edges_.end()) return known->second.get();
  std::unique_ptr<Edge> made;
  if (auto* const server = dynamic_cast<SendServerEndpoint*>(&port))
    made = std::make_unique<EdgeOf<Status>>(
        server->connect(std::string(kOutside), confirming(port.contract().queue)));
  if (auto* const server = dynamic_cast<QueryServerEndpoint*>(&port))
    made = std::make_unique<EdgeOf<Result<ObjectRef>>>(server->connect());
  if (!made)
    return fail(Code::invalid_argument,
                port.path() + " takes nothing from outside; only a SendServer and a QueryServer do");
  return edges_.emplace(&port, std::move(made)).first->second.get();
}

// Only what is sent begins a mission: a question is nobody's task.
void OuterOffers::stamp(ObjectLoan& object, Pattern pattern) {
  idl::OrcaObject& header = object.header();
  header.creation_time(to_time_value(executive_.now()));
  header.origin() = kOutside;
  header.seq(++last_seq_);
  if (missions_ != nullptr && pattern == Pattern::send) header.mission(++*missions_);
}

Status OuterOffers::offer(Endpoint& port, ObjectLoan object, Answered answered) {
  const ObjectType* const wanted = find_object_type(port.contract().type.name);
  if (wanted == nullptr || !is_a(object.type(), *wanted))
    return fail(Code::invalid_argument, port.path() + " takes " + port.contract().type.name + ", not " +
                                            std::string(object.type().name));
  Edge* edge = nullptr;
  {
    const MutexLock lock(mutex_);
    const Result<Edge*> found = edge_at(port);
    if (!found) return found.error();
    edge = *found;
    stamp(object, port.contract().pattern);
  }
  edge->offer(std::move(object).seal(), std::move(answered));
  return ok();
}

void OuterOffers::forget(const std::string& component) {
  const MutexLock lock(mutex_);
  std::erase_if(edges_, [&](const auto& edge) {
    const std::string path = edge.first->path();
    return path.substr(0, path.rfind('.')) == component;
  });
}

}  // namespace orca::host
