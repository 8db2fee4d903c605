// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/patterns/dds/dds_backend.hpp"

#include <pthread.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <map>
#include <mutex>
#include <utility>

#include "frames/push_over_frames.hpp"
#include "frames/request_over_frames.hpp"
#include "orca/base/hash.hpp"
#include "orca/base/mutex.hpp"
#include "orca/patterns/dds/topic_names.hpp"
#include "orca/patterns/endpoints/push_client_endpoint.hpp"
#include "orca/patterns/endpoints/query_client_endpoint.hpp"
#include "orca/patterns/endpoints/query_server_endpoint.hpp"
#include "orca/patterns/endpoints/send_client_endpoint.hpp"
#include "orca/patterns/endpoints/send_server_endpoint.hpp"
#include "outbox.hpp"
#include "push_ends.hpp"

namespace orca {
namespace {

using namespace dds;
using namespace frames;

constexpr std::int32_t kLineDepth = 256;     // of messages that DDS repeats by itself
constexpr std::int32_t kReaderDepth = 1024;  // of what waits for a sample that is repeated
constexpr std::uint32_t kMostDepth = 1024;   // of objects that DDS repeats

std::uint64_t hash_of(const std::string& first, const std::string& second = {}) {
  Fnv1a hash;
  hash.add_text(first);
  hash.add_text(second);
  return hash.value();
}

const ObjectType& type_of(const TypeId& id) { return *find_object_type(id.name); }

// Returns the name of a type as its IDL scopes it: "orca::idl::Odometry", "my::Light" for the type my.Light.
std::string idl_name(std::string type) {
  const std::size_t dot = type.find('.');
  return dot == std::string::npos ? "orca::idl::" + type : type.replace(dot, 1, "::");
}

RequestTypes types_of(const Endpoint& port) {
  const std::optional<TypeId>& reply = port.contract().reply;
  return {type_of(port.contract().type), reply ? &type_of(*reply) : nullptr};
}

// Returns whether the port is the `from` end of its connections.
bool is_from(const Endpoint& port) {
  return (port.contract().pattern == Pattern::push) == (port.contract().role == Role::server);
}

std::uint64_t edge_number(const Endpoint& port, const DdsPeer& peer) {
  return (is_from(port) ? hash_of(port.path(), peer.path) : hash_of(peer.path, port.path())) + peer.edge;
}

std::int32_t depth_of(const QueuePolicy& policy) {
  return static_cast<std::int32_t>(std::clamp<std::uint32_t>(policy.depth, 1, kMostDepth));
}

class FastBackend final : public DdsBackend {
 public:
  FastBackend(const DdsOptions& options, std::unique_ptr<Participant> participant)
      : options_(options), participant_(std::move(participant)), outbox_([this] { tick(); }) {}

  ~FastBackend() override {
    inbox_.reset();  // waits for a callback that may be using a line
    outbox_.end();   // which ticks them
    std::map<std::uint64_t, std::unique_ptr<Line>> lines;
    const MutexLock lock(mutex_);
    lines.swap(lines_);  // a late callback of DDS finds none
  }
  FastBackend(const FastBackend&) = delete;
  FastBackend& operator=(const FastBackend&) = delete;

  Status open() {
    auto inbox = participant_->make_reader(inbox_of(options_.process, kReaderDepth),
                                           [this](const Sample& sample) { receive(sample); });
    if (!inbox) return inbox.error();
    inbox_ = std::move(inbox).value();
    return ok();
  }

  Status connect(Endpoint& port, const DdsPeer& peer, const QueuePolicy& policy,
                 Duration base_period) override {
    const Result<Line*> line = line_to(peer.process);
    if (!line) return line.error();
    const EndPlace place{**line,
                         outbox_,
                         edge_number(port, peer),
                         port.home().strand,
                         port.path() + " to " + peer.path,
                         peer.clock_ahead};
    if (auto* server = dynamic_cast<PushServerEndpoint*>(&port)) return serve(*server, place, policy);
    if (auto* client = dynamic_cast<PushClientEndpoint*>(&port))
      return subscribe(*client, place, peer, policy, base_period);
    connect_requests(port, place, peer, policy);
    return ok();
  }

  void cut(const std::string& process, const Error& reason) override {
    const MutexLock lock(mutex_);
    if (const auto line = lines_.find(hash_of(process)); line != lines_.end()) line->second->lose(reason);
  }

  [[nodiscard]] bool reaches(const std::string& process) const override {
    const MutexLock lock(mutex_);
    const auto line = lines_.find(hash_of(process));
    return line != lines_.end() && line->second->is_joined();
  }

 private:
  // A port that publishes, with what its edges share.
  struct Published {
    std::weak_ptr<Publication> publication;
    std::int32_t depth = 0;  // of its writer, once there is one
  };

  [[nodiscard]] TopicOptions inbox_of(const std::string& process, std::int32_t depth) {
    return {inbox_topic(options_.graph, options_.run, process), "orca::dds::Message", depth,
            [this] { greet(); }};
  }

  // Returns the topic of a Push port.
  [[nodiscard]] TopicOptions topic_of(const std::string& path, const std::string& type,
                                      std::int32_t depth) const {
    return {object_topic(options_.graph, path), idl_name(type), depth};
  }

  // DDS is called without the lock, because it calls back with locks of its own.
  Result<Line*> line_to(const std::string& process) {
    if (Line* const known = find_line(hash_of(process))) return known;
    Result<std::shared_ptr<TopicWriter>> writer = participant_->make_writer(inbox_of(process, kLineDepth));
    if (!writer) return writer.error();
    auto line =
        std::make_unique<Line>(process, Line::Settings{hash_of(options_.process), options_.liveliness},
                               [this, to = std::move(writer).value()](std::vector<std::byte> message, By by) {
                                 outbox_.post({to, {}, {}, std::move(message)}, by);
                               });
    const MutexLock lock(mutex_);
    return lines_.emplace(hash_of(process), std::move(line)).first->second.get();
  }

  // A sample is a sequence<octet>, its length, then the bytes, which are messages.
  void receive(const Sample& sample) {
    std::uint32_t length = 0;
    std::span<const std::byte> bytes = sample.contents();
    if (bytes.size() < sizeof length) return;
    std::memcpy(&length, bytes.data(), sizeof length);
    bytes = bytes.subspan(sizeof length);
    if (length > bytes.size()) return;
    bytes = bytes.first(length);
    while (const auto message = take_message(bytes))
      if (Line* const line = find_line(message->from))
        if (participant_->may_speak_for(sample.origin, line->peer())) line->receive(*message, sample.origin);
  }

  Line* find_line(std::uint64_t process) {
    const MutexLock lock(mutex_);
    const auto line = lines_.find(process);
    return line == lines_.end() ? nullptr : line->second.get();
  }

  void tick() {
    participant_->look_after_keys(std::chrono::system_clock::now());
    const MutexLock lock(mutex_);
    for (const auto& [process, line] : lines_) line->tick();
  }

  // A peer was found, whichever it is.
  void greet() {
    const MutexLock lock(mutex_);
    for (const auto& [process, line] : lines_) line->greet_if_alone();
  }

  Status serve(PushServerEndpoint& server, const EndPlace& place, const QueuePolicy& policy) {
    Result<std::shared_ptr<Publication>> publication = publication_of(server, depth_of(policy));
    if (!publication) return publication.error();
    const std::optional<std::uint64_t> bit = (*publication)->reserve();
    if (!bit)
      return fail(Code::invalid_argument, server.path() + " has too many connections that go over DDS");
    auto end = std::make_unique<PublishingEnd>(place, std::move(publication).value(), *bit);
    server.adopt(std::make_unique<PushSinkOverFrames>(std::move(end), server.connect(), policy));
    return ok();
  }

  // Returns the publication of a port. Its writer keeps as many objects as the deepest queue of all edges.
  Result<std::shared_ptr<Publication>> publication_of(PushServerEndpoint& server, std::int32_t depth) {
    Published& known = published_[&server];
    std::shared_ptr<Publication> publication = known.publication.lock();
    if (publication != nullptr && known.depth >= depth) return publication;
    auto writer = participant_->make_writer(topic_of(server.path(), server.contract().type.name, depth));
    if (!writer) return writer.error();
    known.depth = depth;
    if (publication != nullptr) {
      publication->use(std::move(writer).value());
      return publication;
    }
    publication = std::make_shared<Publication>(outbox_, std::move(writer).value());
    known.publication = publication;
    server.add_outlet(*publication);
    return publication;
  }

  Status subscribe(PushClientEndpoint& client, const EndPlace& place, const DdsPeer& peer,
                   const QueuePolicy& policy, Duration base_period) {
    const TopicOptions topic = topic_of(peer.path, peer.type, kReaderDepth);
    std::weak_ptr<Subscription>& known = subscriptions_[topic.name];
    std::shared_ptr<Subscription> subscription = known.lock();
    if (subscription == nullptr) {
      subscription = std::make_shared<Subscription>();
      if (Status opened = subscription->open(*participant_, topic); !opened.ok()) return opened;
      known = subscription;
    }
    auto end = std::make_unique<SubscribingEnd>(place, std::move(subscription));
    auto source = std::make_unique<PushSourceOverFrames>(std::move(end), type_of(client.contract().type),
                                                         peer.path, base_period);
    client.connect(*source, policy);
    client.adopt(std::move(source));
    return ok();
  }

  static void connect_requests(Endpoint& port, const EndPlace& place, const DdsPeer& peer,
                               const QueuePolicy& policy) {
    const bool blocks = policy.overflow == QueuePolicy::Overflow::block;
    if (auto* server = dynamic_cast<QueryServerEndpoint*>(&port))
      return answer(*server, server->connect(), place);
    if (auto* server = dynamic_cast<SendServerEndpoint*>(&port))
      return answer(*server, server->connect(peer.path, policy), place);
    if (auto* client = dynamic_cast<QueryClientEndpoint*>(&port))
      return call(*client, place, peer, Duration{0});
    if (auto* client = dynamic_cast<SendClientEndpoint*>(&port))
      call(*client, place, peer, blocks ? policy.block_limit : Duration{0});
  }

  template <class Answer>
  static void answer(Endpoint& server, RequestTarget<Answer>& target, const EndPlace& place) {
    server.adopt(std::make_unique<CallerOverFrames<Answer>>(std::make_unique<DdsEnd>(place), types_of(server),
                                                            target));
  }

  template <class Answer>
  static void call(RequestClient<Answer>& client, const EndPlace& place, const DdsPeer& peer,
                   Duration patience) {
    auto target = std::make_unique<TargetOverFrames<Answer>>(
        std::make_unique<DdsEnd>(place), client.home().strand, types_of(client), peer.path, patience);
    client.connect(*target);
    client.adopt(std::move(target));
  }

  const DdsOptions options_;
  const std::unique_ptr<Participant> participant_;
  std::map<Endpoint*, Published> published_;
  std::map<std::string, std::weak_ptr<Subscription>> subscriptions_;
  mutable Mutex mutex_;
  std::map<std::uint64_t, std::unique_ptr<Line>> lines_ ORCA_GUARDED_BY(mutex_);  // not what is in them
  Outbox outbox_;
  std::unique_ptr<TopicReader> inbox_;
};

// Gives the threads of Fast DDS a name, which they take over from the one that makes them: so one can see which they are.
Result<std::unique_ptr<Participant>> open_named(const DdsOptions& options) {
  std::array<char, 16> name{};
  pthread_getname_np(pthread_self(), name.data(), name.size());
  pthread_setname_np(pthread_self(), "dds");
  Result<std::unique_ptr<Participant>> participant = Participant::open(options);
  pthread_setname_np(pthread_self(), name.data());
  return participant;
}

}  // namespace

extern "C" [[gnu::visibility("default")]] void orca_make_dds_backend(const DdsOptions& options,
                                                                     MadeDdsBackend& made) {
  Result<std::unique_ptr<Participant>> participant = open_named(options);
  if (!participant) {
    made.emplace(participant.error());
    return;
  }
  auto backend = std::make_unique<FastBackend>(options, std::move(participant).value());
  if (const Status opened = backend->open(); !opened.ok()) {
    made.emplace(opened.error());
  } else {
    made.emplace(std::move(backend));
  }
}

}  // namespace orca
