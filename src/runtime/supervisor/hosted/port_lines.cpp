// SPDX-License-Identifier: LGPL-3.0-or-later
#include "port_lines.hpp"

#include <poll.h>
#include <pthread.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "orca/idl/object_type.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kLook = 10ms;                              // between two looks at the taps
constexpr std::size_t kBound = std::size_t{1} << 20;          // [bytes] that wait for a client
constexpr std::size_t kLongestOffer = std::size_t{16} << 20;  // [bytes]
constexpr int kMostOffers = 8;                                // of one client at a look
constexpr std::size_t kMostObjects = std::size_t{1} << 17;    // that wait at a tap for a look
constexpr Duration kEndLimit = 300ms;                         // for what waits when the process ends

std::uint64_t nanoseconds(TimePoint time) {
  return static_cast<std::uint64_t>(time.time_since_epoch().count());
}

std::vector<std::byte> bytes_of(const ObjectRef& object) {
  std::vector<std::byte> bytes;
  object.type().serialize(object.get(), bytes);
  return bytes;
}

using SteadyClock = std::chrono::steady_clock;

host::PortTap::Bounds bounds_of(const OpenLine& order) {
  return order.bound == 0 ? host::PortTap::Bounds{} : host::PortTap::Bounds{kMostObjects, order.bound};
}

// Sends what waits in channels, until all is sent or the time is over.
void push_out(std::vector<std::shared_ptr<Channel>> channels, SteadyClock::time_point end) {
  for (;;) {
    std::erase_if(channels,
                  [](const auto& channel) { return !channel->flush().ok() || !channel->has_unsent(); });
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - SteadyClock::now());
    if (channels.empty() || left.count() <= 0) return;
    std::vector<pollfd> ready;
    for (const auto& channel : channels) ready.push_back({channel->descriptor(), POLLOUT, 0});
    (void)poll(ready.data(), ready.size(), static_cast<int>(left.count()));
  }
}

Tapped to_word(const host::PortTap::Passed& passed, bool with_object, std::uint64_t lost) {
  Tapped word;
  word.type = passed.object.type().name;
  word.passed = nanoseconds(passed.time);
  word.created = static_cast<std::uint64_t>(passed.object.header().creation_time().ns());
  word.lost = lost;
  word.place = passed.place;
  if (!with_object) return word;
  word.object = bytes_of(passed.object);
  word.size = word.object.size();
  return word;
}

Result<ObjectLoan> read(const Offer& offer) {
  const ObjectType* const type = find_object_type(offer.type);
  if (type == nullptr) return fail(Code::invalid_argument, "there is no object type " + offer.type);
  ObjectLoan object = make_object(*type);
  if (Status read = type->deserialize(offer.object, object.get()); !read.ok()) return read.error();
  return object;
}

OfferOutcome to_word(const Result<ObjectRef>& answer) {
  if (!answer) return {answer.error(), "", {}};
  if (!*answer) return {ok(), "", {}};
  return {ok(), std::string(answer->type().name), bytes_of(*answer)};
}

}  // namespace

// One client.
class PortLines::Line {
 public:
  Line(host::PartAccess& part, OpenLine order, std::shared_ptr<host::PortTap> tap)
      : part_(part),
        port_(std::move(order.ports.front())),
        objects_(order.objects),
        is_bounded_(order.bound > 0),
        tap_(std::move(tap)),
        channel_(std::make_shared<Channel>(std::move(order.line), is_bounded_ ? order.bound : kBound,
                                           kLongestOffer)),
        lost_(order.ports.size()) {}

  // Returns false if the client is gone, or is to be cut off.
  bool serve() {
    if (tap_) send_passed();
    if (is_to_end_) send_end();
    return channel_->flush().ok() && take_offers();
  }

  // Puts the rest into the channel, because the process ends. Whoever looks on for a moment only need not have it.
  void finish() {
    if (!tap_ || !is_bounded_) return;
    send_passed();
    send_end();
  }

  [[nodiscard]] const std::shared_ptr<Channel>& channel() const { return channel_; }

 private:
  void send_passed() {
    const std::vector<std::uint64_t> lost = tap_->lost();
    for (const host::PortTap::Passed& passed : tap_->take()) {
      const std::size_t at = passed.place;
      const Status sent = channel_->post(encode(to_word(passed, objects_, lost[at] + lost_[at])));
      if (!sent.ok()) ++lost_[at];
    }
  }

  void send_end() {
    if (channel_->post(encode(LineWord(LineEnded{lost_in_all()}))).ok()) is_to_end_ = false;
  }

  [[nodiscard]] std::vector<std::uint64_t> lost_in_all() const {
    std::vector<std::uint64_t> lost = lost_;
    if (!tap_) return lost;
    std::ranges::transform(lost, tap_->lost(), lost.begin(), std::plus<>());
    return lost;
  }

  bool take_offers() {
    for (int i = 0; i < kMostOffers; ++i) {
      Result<std::optional<Message>> message = channel_->receive();
      if (!message) return false;
      if (!message->has_value()) return true;
      const std::uint64_t request = (*message)->request;
      Result<LineWord> word = decode_line_word(std::move(**message));
      if (word && std::holds_alternative<EndLine>(*word)) {
        is_to_end_ = true;                                                 // after the next look at the tap
      } else if (word && std::holds_alternative<Offer>(*word) && !tap_) {  // who looks gives no orders
        hand_over(std::get<Offer>(*word), request);
      } else {
        return false;
      }
    }
    return true;
  }

  // The reply is encoded on the strand of the component that answers, once for each question of an operator.
  void hand_over(const Offer& offer, std::uint64_t request) {
    const auto answer = [channel = channel_, request](const Result<ObjectRef>& outcome) {
      (void)channel->post(encode(LineWord(to_word(outcome)), request));
    };
    Result<ObjectLoan> object = read(offer);
    const Status given =
        object ? part_.offer(port_, std::move(object).value(), answer) : Status(object.error());
    if (!given.ok()) answer(given.error());
  }

  host::PartAccess& part_;
  const graph::PortRef port_;  // for which offers are
  const bool objects_;
  const bool is_bounded_;
  const std::shared_ptr<host::PortTap> tap_;  // null: the client only sends
  const std::shared_ptr<Channel> channel_;    // answers may come when the line is gone
  std::vector<std::uint64_t> lost_;           // by place, because the client did not read
  bool is_to_end_ = false;                    // the client wants to know that it has everything
};

PortLines::PortLines(host::PartAccess& part) : part_(part) {}

PortLines::~PortLines() {
  {
    const MutexLock lock(mutex_);
    ending_ = true;
  }
  if (thread_.joinable()) thread_.join();
}

Status PortLines::open(OpenLine order) {
  if (order.ports.empty()) return fail(Code::invalid_argument, "a line to no port");
  std::shared_ptr<host::PortTap> tap;
  if (order.taps) {
    Result<std::shared_ptr<host::PortTap>> opened = part_.tap(order.ports, bounds_of(order));
    if (!opened) return opened.error();
    tap = std::move(opened).value();
  }
  const MutexLock lock(mutex_);
  if (lines_.size() == kMost)
    return fail(Code::unavailable, "too many lines to the ports of this process: " + std::to_string(kMost));
  lines_.emplace_back(part_, std::move(order), std::move(tap));
  if (runs_) return ok();
  if (thread_.joinable()) thread_.join();  // it has nothing more to do
  runs_ = true;
  thread_ = std::thread([this] {
    pthread_setname_np(pthread_self(), "lines");
    serve();
  });
  return ok();
}

void PortLines::serve() {
  for (;;) {
    std::vector<std::shared_ptr<Channel>> channels;
    bool is_end = false;
    {
      const MutexLock lock(mutex_);
      std::erase_if(lines_, [](Line& line) { return !line.serve(); });
      is_end = ending_;
      if (is_end)
        for (Line& line : lines_) line.finish();
      runs_ = !lines_.empty() && !is_end;
      if (lines_.empty()) return;
      for (const Line& line : lines_) channels.push_back(line.channel());
    }
    const auto end = SteadyClock::now() + (is_end ? kEndLimit : kLook);
    push_out(std::move(channels), end);
    if (is_end) return;
    std::this_thread::sleep_until(end);  // objects that pass do not wake it: system calls
  }
}

}  // namespace orca::supervisor
