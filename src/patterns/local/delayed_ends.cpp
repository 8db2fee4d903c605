// SPDX-License-Identifier: LGPL-3.0-or-later
#include "delayed_ends.hpp"

#include <optional>
#include <string>
#include <utility>

namespace orca {
namespace {

// The way of one Push edge. On an edge that blocks, one object is under way at a time, until the publisher knows that it was taken.
class DelayedPush final : public LinkEnd, public PushSource, public PushSink {
 public:
  DelayedPush(PushSource& source, const Transport& transport) : source_(source), transport_(transport) {}
  ~DelayedPush() override { transport_.courier.recall(this); }
  DelayedPush(const DelayedPush&) = delete;
  DelayedPush& operator=(const DelayedPush&) = delete;

  // The edge outlives this object's use.
  void serve(const PushEdge& edge) { edge_ = &edge; }

  void attach(PushSink& sink, const UpdateRate& rate) override {
    sink_ = &sink;
    source_.attach(*this, rate);
  }
  void detach() override {
    source_.detach();
    clear();
    sink_ = nullptr;
  }
  void change(const UpdateRate& rate) override { source_.change(rate); }
  void room() override {
    if (stage_ == Stage::waits) post(Duration{0}, [this] { arrive(); });
  }
  [[nodiscard]] Duration base_period() const override { return source_.base_period(); }
  [[nodiscard]] std::string path() const override { return source_.path(); }

  std::optional<Duration> deliver(ObjectRef&& object) override;
  void give_up(const ObjectRef& object) override;
  void granted(const UpdateGrant& grant) override { sink_->granted(grant); }
  void lost(std::uint64_t objects) override { sink_->lost(objects); }

 private:
  // Stages of the one object of an edge that blocks.
  enum class Stage {
    none,       // there is no such object
    under_way,  // to the subscriber
    waits,      // for room at the subscriber
    taken,      // the publisher does not know yet
    confirmed,  // the publisher has been woken
  };

  [[nodiscard]] bool blocks() const {
    return edge_ != nullptr && edge_->policy().overflow == QueuePolicy::Overflow::block;
  }
  void post(Duration delay, std::function<void()> arrive) {
    transport_.courier.post(this, delay, std::move(arrive));
  }
  void arrive();
  void clear() {
    transport_.courier.recall(this);
    object_ = ObjectRef{};
    stage_ = Stage::none;
  }

  PushSource& source_;
  const Transport transport_;
  const PushEdge* edge_ = nullptr;
  PushSink* sink_ = nullptr;  // null: not subscribed
  Stage stage_ = Stage::none;
  ObjectRef object_;  // under way or waiting
};

std::optional<Duration> DelayedPush::deliver(ObjectRef&& object) {
  if (stage_ == Stage::confirmed) {
    stage_ = Stage::none;
    return std::nullopt;
  }
  if (stage_ == Stage::none && !blocks()) {
    post(transport_.delay, [this, sent = std::move(object)] { (void)sink_->deliver(ObjectRef(sent)); });
    return std::nullopt;
  }
  if (stage_ == Stage::none) {
    object_ = object;
    stage_ = Stage::under_way;
    post(transport_.delay, [this] { arrive(); });
  }
  return saturating_add(TimePoint(edge_->policy().block_limit), 2 * transport_.delay).time_since_epoch();
}

void DelayedPush::arrive() {
  stage_ = Stage::waits;
  if (sink_->deliver(ObjectRef(object_))) return;
  object_ = ObjectRef{};
  stage_ = Stage::taken;
  post(transport_.delay, [this] {
    stage_ = Stage::confirmed;
    source_.room();
  });
}

// An object that was taken already is not lost, although the publisher does not hear of it.
void DelayedPush::give_up(const ObjectRef& object) {
  const bool is_lost = stage_ == Stage::under_way || stage_ == Stage::waits;
  clear();
  if (is_lost) sink_->give_up(object);
}

// The way of one Query or Send edge.
template <class Answer>
class DelayedRequests final : public LinkEnd, public RequestTarget<Answer>, public ReplySink<Answer> {
 public:
  DelayedRequests(RequestTarget<Answer>& target, const Transport& transport)
      : target_(target), transport_(transport) {}
  ~DelayedRequests() override { transport_.courier.recall(this); }
  DelayedRequests(const DelayedRequests&) = delete;
  DelayedRequests& operator=(const DelayedRequests&) = delete;

  std::optional<Answer> offer(const ObjectRef& object, ReplySink<Answer>& reply_to, RequestId id,
                              bool may_wait) override {
    client_ = &reply_to;
    post(id, [this, object, id, may_wait] {
      if (std::optional<Answer> answer = target_.offer(object, *this, id, may_wait))
        reply(id, std::move(*answer));
    });
    return std::nullopt;
  }
  void reply(RequestId id, Answer answer) override {
    post(id, [this, id, answer = std::move(answer)] { client_->reply(id, answer); });
  }
  void withdraw(RequestId id) override {
    if (!transport_.courier.recall(this, id)) target_.withdraw(id);
  }
  [[nodiscard]] Duration patience() const override { return target_.patience() + 2 * transport_.delay; }
  [[nodiscard]] std::string path() const override { return target_.path(); }

 private:
  void post(RequestId id, std::function<void()> arrive) {
    transport_.courier.post(this, transport_.delay, std::move(arrive), id);
  }

  RequestTarget<Answer>& target_;
  const Transport transport_;
  ReplySink<Answer>* client_ = nullptr;  // null: nothing was offered yet
};

template <class Answer>
void connect_requests(RequestClient<Answer>& client, RequestTarget<Answer>& target,
                      const Transport& transport) {
  auto end = std::make_unique<DelayedRequests<Answer>>(target, transport);
  client.connect(*end);
  client.adopt(std::move(end), target.path());
}

}  // namespace

void connect_delayed(PushServerEndpoint& server, PushClientEndpoint& client, const QueuePolicy& policy,
                     const Transport& transport) {
  auto end = std::make_unique<DelayedPush>(server.connect(client.path()), transport);
  end->serve(client.connect(*end, policy));
  client.adopt(std::move(end), server.path());
}

void connect_delayed(QueryClientEndpoint& client, QueryServerEndpoint& server, const Transport& transport) {
  connect_requests(client, server.connect(client.path()), transport);
}

void connect_delayed(SendClientEndpoint& client, SendServerEndpoint& server, const QueuePolicy& policy,
                     const Transport& transport) {
  connect_requests(client, server.connect(client.path(), policy), transport);
}

}  // namespace orca
