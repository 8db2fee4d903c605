// SPDX-License-Identifier: LGPL-3.0-or-later
#include "port_lines.hpp"

#include <pthread.h>

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

std::uint64_t nanoseconds(TimePoint time) {
  return static_cast<std::uint64_t>(time.time_since_epoch().count());
}

std::vector<std::byte> bytes_of(const ObjectRef& object) {
  std::vector<std::byte> bytes;
  object.type().serialize(object.get(), bytes);
  return bytes;
}

Tapped to_word(const host::PortTap::Passed& passed, bool with_object, std::uint64_t lost) {
  Tapped word;
  word.type = passed.object.type().name;
  word.passed = nanoseconds(passed.time);
  word.created = static_cast<std::uint64_t>(passed.object.header().creation_time().ns());
  word.lost = lost;
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
  Line(host::HostedPart& part, OpenLine order, std::shared_ptr<host::PortTap> tap)
      : part_(part),
        port_{std::move(order.component), std::move(order.port)},
        objects_(order.objects),
        tap_(std::move(tap)),
        channel_(std::make_shared<Channel>(std::move(order.line), kBound, kLongestOffer)) {}

  // Returns false if the client is gone, or is to be cut off.
  bool serve() {
    if (tap_) send_passed();
    return channel_->flush().ok() && take_offers();
  }

 private:
  void send_passed() {
    for (const host::PortTap::Passed& passed : tap_->take()) {
      const Status sent = channel_->post(encode(to_word(passed, objects_, tap_->lost() + lost_)));
      if (!sent.ok()) ++lost_;
    }
  }

  bool take_offers() {
    for (int i = 0; i < kMostOffers; ++i) {
      Result<std::optional<Message>> message = channel_->receive();
      if (!message) return false;
      if (!message->has_value()) return true;
      const std::uint64_t request = (*message)->request;
      Result<LineWord> word = decode_line_word(std::move(**message));
      if (!word || !std::holds_alternative<Offer>(*word)) return false;
      hand_over(std::get<Offer>(*word), request);
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

  host::HostedPart& part_;
  const graph::PortRef port_;
  const bool objects_;
  const std::shared_ptr<host::PortTap> tap_;  // null: the client only sends
  const std::shared_ptr<Channel> channel_;    // answers may come when the line is gone
  std::uint64_t lost_ = 0;                    // because the client did not read
};

PortLines::PortLines(host::HostedPart& part) : part_(part) {}

PortLines::~PortLines() {
  {
    const MutexLock lock(mutex_);
    ending_ = true;
  }
  if (thread_.joinable()) thread_.join();
}

Status PortLines::open(OpenLine order) {
  std::shared_ptr<host::PortTap> tap;
  if (order.taps) {
    Result<std::shared_ptr<host::PortTap>> opened = part_.tap({order.component, order.port});
    if (!opened) return opened.error();
    tap = std::move(opened).value();
  }
  const MutexLock lock(mutex_);
  if (lines_.size() == kMost)
    return fail(Code::unavailable, "too many clients look at this process already: " + std::to_string(kMost));
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
    {
      const MutexLock lock(mutex_);
      std::erase_if(lines_, [](Line& line) { return !line.serve(); });
      runs_ = !lines_.empty() && !ending_;
      if (!runs_) return;
    }
    std::this_thread::sleep_for(
        kLook);  // an object that passes does not wake it: that would cost a system call
  }
}

}  // namespace orca::supervisor
