// SPDX-License-Identifier: GPL-3.0-or-later
// Anybody in the network may write to the inbox of a process and to its topics: a line meets who echoes its number, its end hands over
// frames or cuts the peer off, and a stranger changes nothing. The first byte chooses the port; the rest is a sequence of pieces: what
// comes (1 byte), its length (1 byte), and its bytes.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "all_ports.hpp"
#include "dds/backend/line.hpp"
#include "dds/backend/push_ends.hpp"
#include "frames/push_over_frames.hpp"
#include "frames/request_over_frames.hpp"
#include "orca/base/log.hpp"

namespace {

using namespace orca;
using namespace orca::dds;
using namespace orca::frames;
using test::AllPorts;
using test::port;
using Bytes = std::span<const std::byte>;

constexpr std::uint64_t kEdge = 7;
constexpr std::uint64_t kPeer = 5;  // the number by which the peer takes part
constexpr Origin kPeerOrigin{std::byte{1}};
constexpr Origin kStranger{std::byte{2}};

// What comes.
enum class Piece { parcel, frame, message, sample_of_strangers, object, time, another_peer, rate };
constexpr unsigned kPieces = 8;

class NoTopic final : public TopicWriter {
 public:
  bool write(const ObjectRef& /*object*/, std::size_t /*size*/, const Label& /*label*/) override {
    return true;
  }
  bool write(std::vector<std::byte> /*messages*/) override { return true; }
};

std::uint64_t take(Bytes& bytes) { return take_number(bytes).value_or(0); }

// One process with an edge to a peer, which the input plays.
class Process {
 public:
  Process(Executive& executive, unsigned choice) : node_(executive, "node") {
    make_end(choice);
    node_.open();
    if (node_.in.connected()) node_.in.subscribe();
    meet();
  }
  ~Process() {
    node_.strand().take_in();
    node_.close("the end");
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void take_piece(Piece piece, Bytes bytes) {
    switch (piece) {
      case Piece::parcel: return say(bytes);
      case Piece::frame: return say_frame(bytes);
      case Piece::message: return say_message(bytes, kPeerOrigin);
      case Piece::sample_of_strangers: return receive(bytes, kStranger);
      case Piece::object: return publish(bytes);
      case Piece::time: return pass(take(bytes));
      case Piece::another_peer: return replace();
      case Piece::rate: return ask_for(bytes);
    }
  }

  // Lets the component do whatever may make it write, or look at what it has received.
  void act() {
    node_.strand().take_in();
    node_.out.push(full_stop());
    if (node_.in.connected()) (void)node_.in.get_update_wait_max(Duration{0});
    if (const auto id = node_.sender.send_request(full_stop())) (void)node_.sender.send_receive(*id);
    if (const auto id = node_.question.query_request(node_.question.loan()))
      (void)node_.question.query_receive(*id);
    while (node_.handle_one()) {
    }
  }

 private:
  void make_end(unsigned choice) {
    switch (choice % 6) {
      case 0: return serve();
      case 1: return subscribe();
      case 2: {
        auto& server = port<SendServerEndpoint>(node_, "taker");
        return answer(server, server.connect("peer.port", {}));
      }
      case 3: return call(port<SendClientEndpoint>(node_, "sender"));
      case 4: {
        auto& server = port<QueryServerEndpoint>(node_, "answerer");
        return answer(server, server.connect());
      }
      default: return call(port<QueryClientEndpoint>(node_, "question"));
    }
  }

  EndPlace place() {
    return {line_, outbox_, kEdge, node_.strand(), "node.port to peer.port", [] { return Duration{12'345}; }};
  }
  static const ObjectType& type_of(const TypeId& id) { return *find_object_type(id.name); }
  static RequestTypes types_of(const Endpoint& port) {
    const auto& reply = port.contract().reply;
    return {type_of(port.contract().type), reply ? &type_of(*reply) : nullptr};
  }

  void serve() {
    auto& server = port<PushServerEndpoint>(node_, "out");
    auto publication = std::make_shared<Publication>(outbox_, std::make_shared<NoTopic>());
    const std::uint64_t bit = publication->reserve().value();
    server.add_outlet(*publication);
    auto end = std::make_unique<PublishingEnd>(place(), std::move(publication), bit);
    server.adopt(std::make_unique<PushSinkOverFrames>(std::move(end), server.connect(), QueuePolicy{}));
  }
  void subscribe() {
    auto& client = port<PushClientEndpoint>(node_, "in");
    auto end = std::make_unique<SubscribingEnd>(place(), std::make_shared<Subscription>());
    topic_ = end.get();
    auto source = std::make_unique<PushSourceOverFrames>(std::move(end), type_of(client.contract().type),
                                                         "peer.port", Duration{0});
    client.connect(*source, {.depth = 4});
    client.adopt(std::move(source));
  }
  template <class Answer>
  void answer(Endpoint& server, RequestTarget<Answer>& target) {
    server.adopt(std::make_unique<CallerOverFrames<Answer>>(std::make_unique<DdsEnd>(place()),
                                                            types_of(server), target));
  }
  template <class Answer>
  void call(RequestClient<Answer>& client) {
    auto target = std::make_unique<TargetOverFrames<Answer>>(
        std::make_unique<DdsEnd>(place()), node_.strand(), types_of(client), "peer.port", Duration{0});
    client.connect(*target);
    client.adopt(std::move(target));
  }

  // --- What comes -----------------------------------------------------------------------------------------

  void meet() {
    line_.greet_if_alone();
    receive_from({9, peer_, own_, 0, 0, {}}, kPeerOrigin);
    sequence_ = 0;
  }
  void receive_from(const Message& message, const Origin& origin) {
    const std::vector<std::byte> bytes = encode(message);
    receive(bytes, origin);
  }
  void receive(Bytes sample, const Origin& origin) {
    const bool is_joined = line_.is_joined();
    while (const auto message = take_message(sample)) line_.receive(*message, origin);
    // A stranger may be met by who is alone only.
    if (origin == kStranger && is_joined && !line_.is_peer(kPeerOrigin)) std::abort();
  }
  void send(const std::vector<std::byte>& parcel) {
    receive_from({9, peer_, own_, ++sequence_, 0, parcel}, kPeerOrigin);
  }
  void say(Bytes bytes) {
    std::vector<std::byte> parcel = begin_parcel(kEdge, static_cast<Parcel>(take(bytes) % 6));
    parcel.insert(parcel.end(), bytes.begin(), bytes.end());
    send(parcel);
  }
  void say_frame(Bytes bytes) {
    std::vector<std::byte> parcel = begin_parcel(kEdge, Parcel::frame);
    parcel.insert(parcel.end(), bytes.begin(), bytes.end());
    send(parcel);
  }
  void say_message(Bytes bytes, const Origin& origin) {
    const std::uint64_t own = take(bytes) % 3 == 0 ? own_ : take(bytes);
    const std::uint64_t sequence = sequence_ + take(bytes);
    const std::uint64_t received = take(bytes);
    receive_from({9, peer_, own, sequence, received, bytes}, origin);
  }
  void publish(Bytes bytes) {
    if (topic_ == nullptr) return;
    Sample sample;
    sample.origin = take(bytes) % 3 == 0 ? kStranger : kPeerOrigin;
    sample.label = {take(bytes), take(bytes), static_cast<std::uint32_t>(take(bytes))};
    const std::uint64_t missed = take(bytes);
    sample.bytes.resize(kHeadroom);
    sample.bytes.insert(sample.bytes.end(), bytes.begin(), bytes.end());
    topic_->take_sample(std::move(sample), missed);
  }
  void pass(std::uint64_t ticks) {
    for (std::uint64_t i = 0; i < ticks % 64; ++i) line_.tick();
  }
  void replace() {
    ++peer_;
    line_.lose(fail(Code::unavailable, "it has gone"));
    meet();
  }
  // Lets a client ask for another rate.
  void ask_for(Bytes bytes) {
    node_.in.set_interval(Duration(static_cast<std::int64_t>(take(bytes) % 1000)));
  }

  std::uint64_t own_ = 0;
  std::uint64_t peer_ = kPeer;
  std::uint64_t sequence_ = 0;
  Outbox outbox_{[] {}};  // its thread ends with each input, so that nothing of it looks like a leak
  Line line_{"peer", Line::Settings{1, 300ms}, [this](const std::vector<std::byte>& bytes, By) {
               Bytes rest = bytes;
               const auto message = take_message(rest);
               if (!message || !rest.empty()) std::abort();
               own_ = message->own;
             }};
  SampleSink* topic_ = nullptr;
  AllPorts node_;  // the last member: its ends use the others
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  log::set_level(log::Level::error);  // being cut off is a warning
  static const auto executive = make_executive({}).value();
  executive->run([&] {
    Process process(*executive, data[0]);
    for (Bytes rest = std::as_bytes(std::span(data + 1, size - 1)); rest.size() >= 2;) {
      const auto length = std::min<std::size_t>(rest.size() - 2, std::to_integer<unsigned>(rest[1]));
      process.take_piece(static_cast<Piece>(std::to_integer<unsigned>(rest[0]) % kPieces),
                         rest.subspan(2, length));
      process.act();
      rest = rest.subspan(2 + length);
    }
  });
  return 0;
}
