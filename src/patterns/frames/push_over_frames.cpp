// SPDX-License-Identifier: LGPL-3.0-or-later
#include "push_over_frames.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace orca::frames {
namespace {

Frame with_rate(FrameKind kind, std::uint64_t subscription, const UpdateRate& rate) {
  Frame frame(kind, subscription);
  // A component may ask for nonsense; nonsense that travels would make the peer cut this end off.
  frame.add(static_cast<std::uint64_t>(std::max(rate.interval, Duration{0}).count()));
  frame.add(std::uint64_t{std::max(rate.multiple, 1U)});
  return frame;
}

// Reads a field that must be between two bounds.
template <class Bounded>
Status read_bounded(FrameReader& frame, std::uint64_t least, Bounded most, std::uint64_t& value) {
  value = frame.read_number();
  if (value >= least && value <= static_cast<std::uint64_t>(most)) return ok();
  return fail(Code::data_loss, "a frame of kind " + std::to_string(static_cast<int>(frame.kind())) +
                                   " says " + std::to_string(value) + " where at least " +
                                   std::to_string(least) + " and at most " + std::to_string(most) +
                                   " is possible");
}

Status read_duration(FrameReader& frame, Duration& duration) {
  std::uint64_t ns = 0;
  if (Status read = read_bounded(frame, 0, Duration::max().count(), ns); !read.ok()) return read;
  duration = Duration(static_cast<Duration::rep>(ns));
  return ok();
}

Status read_multiple(FrameReader& frame, std::uint32_t& multiple) {
  std::uint64_t number = 0;
  constexpr auto kMost = std::numeric_limits<std::uint32_t>::max();
  if (Status read = read_bounded(frame, 1, kMost, number); !read.ok()) return read;
  multiple = static_cast<std::uint32_t>(number);
  return ok();
}

Result<UpdateRate> read_rate(FrameReader& frame) {
  UpdateRate rate;
  if (Status read = read_duration(frame, rate.interval); !read.ok()) return read.error();
  if (Status read = read_multiple(frame, rate.multiple); !read.ok()) return read.error();
  if (Status whole = frame.status(); !whole.ok()) return whole.error();
  return rate;
}

Result<UpdateGrant> read_grant(FrameReader& frame) {
  UpdateGrant grant;
  if (Status read = read_duration(frame, grant.base_period); !read.ok()) return read.error();
  if (Status read = read_multiple(frame, grant.multiple); !read.ok()) return read.error();
  if (Status read = read_duration(frame, grant.interval); !read.ok()) return read.error();
  if (Status whole = frame.status(); !whole.ok()) return whole.error();
  return grant;
}

// Reads the only field of a frame.
Result<std::uint64_t> read_single(FrameReader& frame) {
  const std::uint64_t number = frame.read_number();
  if (Status whole = frame.status(); !whole.ok()) return whole.error();
  return number;
}

}  // namespace

PushSourceOverFrames::PushSourceOverFrames(std::unique_ptr<FrameEnd> end, const ObjectType& type,
                                           std::string path, Duration base_period)
    : type_(type), path_(std::move(path)), base_period_(base_period), end_(std::move(end)) {
  end_->start({[this](FrameReader& frame) { return receive(frame); },
               [this](const Error& /*reason*/) { lose_server(); }, [this] { subscribe_again(); }});
}

void PushSourceOverFrames::attach(PushSink& sink, const UpdateRate& rate) {
  const MutexLock lock(mutex_);
  sink_ = &sink;
  rate_ = rate;
  send_attach();
}

void PushSourceOverFrames::send_attach() {
  ++subscription_;
  end_->send(with_rate(FrameKind::attach, subscription_, rate_));
}

void PushSourceOverFrames::detach() {
  const MutexLock lock(mutex_);
  sink_ = nullptr;
  held_.reset();
  end_->send(Frame(FrameKind::detach, subscription_));
}

void PushSourceOverFrames::change(const UpdateRate& rate) {
  const MutexLock lock(mutex_);
  rate_ = rate;
  end_->send(with_rate(FrameKind::change, subscription_, rate));
}

void PushSourceOverFrames::room() {
  const MutexLock lock(mutex_);
  if (!held_) return;
  Held held = std::move(*held_);
  held_.reset();
  deliver(std::move(held.object), held.ticket);
}

Duration PushSourceOverFrames::base_period() const {
  const MutexLock lock(mutex_);
  return base_period_;
}

void PushSourceOverFrames::deliver(ObjectRef object, std::uint64_t ticket) {
  if (sink_->deliver(std::move(object)).has_value()) {
    held_ = Held{std::move(object), ticket};  // deliver() left it unchanged
    return;
  }
  if (ticket == 0) return;
  Frame taken(FrameKind::taken, subscription_);
  taken.add(ticket);
  end_->send(taken);
}

Status PushSourceOverFrames::receive(FrameReader& frame) {
  switch (frame.kind()) {
    case FrameKind::object: return receive_object(frame);
    case FrameKind::granted: return receive_grant(frame);
    case FrameKind::give_up: return receive_give_up(frame);
    case FrameKind::lost: return receive_loss(frame);
    default: return unexpected(frame, "Push");
  }
}

// Drops an object that waits for room, because nobody waits for it to be taken any more.
void PushSourceOverFrames::lose_server() {
  const MutexLock lock(mutex_);
  if (held_) sink_->give_up(held_->object);
  held_.reset();
}

void PushSourceOverFrames::subscribe_again() {
  const MutexLock lock(mutex_);
  if (sink_ != nullptr) send_attach();
}

// Returns whether the frame belongs to the present subscription.
bool PushSourceOverFrames::is_current(const FrameReader& frame) const {
  return sink_ != nullptr && frame.number() == subscription_;
}

Status PushSourceOverFrames::receive_object(FrameReader& frame) {
  const std::uint64_t ticket = frame.read_number();
  Result<ObjectRef> object = frame.read_object(type_);
  if (!object) return object.error();
  const MutexLock lock(mutex_);
  if (is_current(frame)) deliver(std::move(object).value(), ticket);
  return ok();
}

Status PushSourceOverFrames::receive_grant(FrameReader& frame) {
  const Result<UpdateGrant> grant = read_grant(frame);
  if (!grant) return grant.error();
  const MutexLock lock(mutex_);
  if (!is_current(frame)) return ok();
  base_period_ = grant->base_period;
  sink_->granted(*grant);
  return ok();
}

Status PushSourceOverFrames::receive_give_up(FrameReader& frame) {
  const Result<std::uint64_t> ticket = read_single(frame);
  if (!ticket) return ticket.error();
  const MutexLock lock(mutex_);
  if (is_current(frame) && held_ && held_->ticket == *ticket)
    sink_->give_up(std::exchange(held_, std::nullopt)->object);
  return ok();
}

Status PushSourceOverFrames::receive_loss(FrameReader& frame) {
  const Result<std::uint64_t> objects = read_single(frame);
  if (!objects) return objects.error();
  const MutexLock lock(mutex_);
  if (is_current(frame)) sink_->lost(*objects);
  return ok();
}

PushSinkOverFrames::PushSinkOverFrames(std::unique_ptr<FrameEnd> end, PushSource& source,
                                       const QueuePolicy& policy)
    : source_(source),
      waits_(policy.overflow == QueuePolicy::Overflow::block),
      limit_(policy.block_limit),
      end_(std::move(end)) {
  end_->start({[this](FrameReader& frame) { return receive(frame); },
               [this](const Error& /*reason*/) { lose_client(); }, [] {}});  // the new client subscribes
}

PushSinkOverFrames::~PushSinkOverFrames() {
  end_->stop();
  source_.detach();
}

void PushSinkOverFrames::lose_client() {
  source_.detach();
  const MutexLock lock(mutex_);
  in_flight_ = {};
}

std::uint64_t PushSinkOverFrames::subscription() const {
  const MutexLock lock(mutex_);
  return attached_;
}

Status PushSinkOverFrames::receive(FrameReader& frame) {
  switch (frame.kind()) {
    case FrameKind::attach:
    case FrameKind::change: return receive_rate(frame);
    case FrameKind::detach: source_.detach(); return ok();
    case FrameKind::taken: return receive_taken(frame);
    default: return unexpected(frame, "Push");
  }
}

Status PushSinkOverFrames::receive_rate(FrameReader& frame) {
  const Result<UpdateRate> rate = read_rate(frame);
  if (!rate) return rate.error();
  if (frame.kind() == FrameKind::change) {
    source_.change(*rate);
    return ok();
  }
  {
    const MutexLock lock(mutex_);
    attached_ = frame.number();
  }
  source_.attach(*this, *rate);
  return ok();
}

Status PushSinkOverFrames::receive_taken(FrameReader& frame) {
  const Result<std::uint64_t> ticket = read_single(frame);
  if (!ticket) return ticket.error();
  {
    const MutexLock lock(mutex_);
    taken_ = taken_ || *ticket == ticket_;
  }
  source_.room();
  return ok();
}

std::optional<Duration> PushSinkOverFrames::deliver(ObjectRef&& object) {
  if (end_->is_cut()) return std::nullopt;
  if (waits_) return push_and_wait(object);
  push(object);
  return std::nullopt;
}

void PushSinkOverFrames::push(const ObjectRef& object) {
  const std::uint64_t current = subscription();
  if (losses_ > 0) {
    Frame losses(FrameKind::lost, current);
    losses.add(losses_);
    if (end_->send(losses, Loss::allowed) == Sent::yes) losses_ = 0;
  }
  Frame frame(FrameKind::object, current);
  frame.add(std::uint64_t{0});
  frame.add(object);
  if (end_->send(frame, Loss::allowed) != Sent::yes) lost(1);
}

void PushSinkOverFrames::lost(std::uint64_t objects) {
  losses_ += objects;
  end_->traffic().objects_lost.fetch_add(objects, std::memory_order_relaxed);
}

// Called repeatedly with the same object until the client has taken it.
std::optional<Duration> PushSinkOverFrames::push_and_wait(const ObjectRef& object) {
  const MutexLock lock(mutex_);
  if (in_flight_ == object) {
    if (!taken_) return limit_;
    in_flight_ = {};
    return std::nullopt;
  }
  in_flight_ = object;
  taken_ = false;
  Frame frame(FrameKind::object, attached_);
  frame.add(++ticket_);
  frame.add(object);
  if (end_->send(frame) == Sent::yes) return limit_;
  in_flight_ = {};
  lost(1);
  return std::nullopt;
}

void PushSinkOverFrames::give_up(const ObjectRef& /*object*/) {
  const MutexLock lock(mutex_);
  in_flight_ = {};
  Frame frame(FrameKind::give_up, attached_);
  frame.add(ticket_);
  end_->send(frame);
}

void PushSinkOverFrames::granted(const UpdateGrant& grant) {
  Frame frame(FrameKind::granted, subscription());
  frame.add(static_cast<std::uint64_t>(grant.base_period.count()));
  frame.add(std::uint64_t{grant.multiple});
  frame.add(static_cast<std::uint64_t>(grant.interval.count()));
  end_->send(frame);
}

}  // namespace orca::frames
