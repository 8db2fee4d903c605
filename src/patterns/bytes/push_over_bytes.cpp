// SPDX-License-Identifier: LGPL-3.0-or-later
#include "push_over_bytes.hpp"

#include <utility>

namespace orca::bytes {
namespace {

Error unexpected(const FrameReader& frame) {
  return fail(Code::data_loss, "a frame of kind " + std::to_string(static_cast<int>(frame.kind())) +
                                   " does not belong to Push, or not in this direction");
}

FrameWriter with_rate(FrameKind kind, std::uint64_t subscription, const UpdateRate& rate) {
  FrameWriter frame(kind, subscription);
  frame.add(static_cast<std::uint64_t>(rate.interval.count()));
  frame.add(std::uint64_t{rate.multiple});
  return frame;
}

Duration read_duration(FrameReader& frame) {
  return Duration(static_cast<Duration::rep>(frame.read_number()));
}

UpdateRate read_rate(FrameReader& frame) {
  UpdateRate rate;
  rate.interval = read_duration(frame);
  rate.multiple = static_cast<std::uint32_t>(frame.read_number());
  return rate;
}

}  // namespace

PushSourceOverBytes::PushSourceOverBytes(Connection connection, const ObjectType& type, std::string path,
                                         Duration base_period)
    : type_(type), path_(std::move(path)), base_period_(base_period), end_(std::move(connection)) {
  end_.start([this](FrameReader& frame) { return receive(frame); }, [](const Error&) {});
}

void PushSourceOverBytes::attach(PushSink& sink, const UpdateRate& rate) {
  const std::lock_guard lock(mutex_);
  sink_ = &sink;
  ++subscription_;
  end_.send(with_rate(FrameKind::attach, subscription_, rate));
}

void PushSourceOverBytes::detach() {
  const std::lock_guard lock(mutex_);
  sink_ = nullptr;
  held_.reset();
  end_.send(FrameWriter(FrameKind::detach, subscription_));
}

void PushSourceOverBytes::change(const UpdateRate& rate) {
  const std::lock_guard lock(mutex_);
  end_.send(with_rate(FrameKind::change, subscription_, rate));
}

void PushSourceOverBytes::room() {
  const std::lock_guard lock(mutex_);
  if (sink_ == nullptr || !held_) return;
  Held held = std::move(*held_);
  held_.reset();
  deliver(std::move(held.object), held.ticket);
}

Duration PushSourceOverBytes::base_period() const {
  const std::lock_guard lock(mutex_);
  return base_period_;
}

// Called with the lock held.
void PushSourceOverBytes::deliver(ObjectRef object, std::uint64_t ticket) {
  if (sink_->deliver(std::move(object)).has_value()) {
    held_ = Held{std::move(object), ticket};  // deliver() left it unchanged
    return;
  }
  if (ticket == 0) return;
  FrameWriter taken(FrameKind::taken, subscription_);
  taken.add(ticket);
  end_.send(std::move(taken));
}

Status PushSourceOverBytes::receive(FrameReader& frame) {
  if (frame.kind() == FrameKind::object) return receive_object(frame);
  const std::lock_guard lock(mutex_);
  const bool current = sink_ != nullptr && frame.number() == subscription_;
  if (frame.kind() == FrameKind::granted) {
    UpdateGrant grant;
    grant.base_period = read_duration(frame);
    grant.multiple = static_cast<std::uint32_t>(frame.read_number());
    grant.interval = read_duration(frame);
    if (current) receive_grant(grant);
  } else if (frame.kind() == FrameKind::give_up) {
    const std::uint64_t ticket = frame.read_number();
    if (current && held_ && held_->ticket == ticket)
      sink_->give_up(std::exchange(held_, std::nullopt)->object);
  } else if (frame.kind() == FrameKind::lost) {
    const std::uint64_t objects = frame.read_number();
    if (current) sink_->lost(objects);
  } else {
    return unexpected(frame);
  }
  return ok();
}

Status PushSourceOverBytes::receive_object(FrameReader& frame) {
  const std::uint64_t ticket = frame.read_number();
  Result<ObjectRef> object = frame.read_object(type_);
  if (!object) return object.error();
  const std::lock_guard lock(mutex_);
  if (sink_ != nullptr && frame.number() == subscription_) deliver(std::move(object).value(), ticket);
  return ok();
}

void PushSourceOverBytes::receive_grant(const UpdateGrant& grant) {
  base_period_ = grant.base_period;
  sink_->granted(grant);
}

PushSinkOverBytes::PushSinkOverBytes(Connection connection, PushSource& source, const QueuePolicy& policy)
    : source_(source),
      waits_(policy.overflow == QueuePolicy::Overflow::block),
      limit_(policy.block_limit),
      end_(std::move(connection)) {
  end_.start([this](FrameReader& frame) { return receive(frame); },
             [this](const Error&) { source_.detach(); });
}

PushSinkOverBytes::~PushSinkOverBytes() {
  end_.stop();
  source_.detach();
}

std::uint64_t PushSinkOverBytes::subscription() const {
  const std::lock_guard lock(mutex_);
  return subscription_;
}

Status PushSinkOverBytes::receive(FrameReader& frame) {
  if (frame.kind() == FrameKind::attach || frame.kind() == FrameKind::change) {
    const UpdateRate rate = read_rate(frame);
    if (Status whole = frame.status(); !whole.ok()) return whole;
    if (frame.kind() == FrameKind::change) {
      source_.change(rate);
      return ok();
    }
    {
      const std::lock_guard lock(mutex_);
      subscription_ = frame.number();
    }
    source_.attach(*this, rate);
  } else if (frame.kind() == FrameKind::detach) {
    source_.detach();
  } else if (frame.kind() == FrameKind::taken) {
    const std::uint64_t ticket = frame.read_number();
    {
      const std::lock_guard lock(mutex_);
      taken_ = taken_ || ticket == ticket_;
    }
    source_.room();
  } else {
    return unexpected(frame);
  }
  return ok();
}

std::optional<Duration> PushSinkOverBytes::deliver(ObjectRef&& object) {
  if (end_.is_cut()) return std::nullopt;
  if (waits_) return push_and_wait(object);
  push(object);
  return std::nullopt;
}

void PushSinkOverBytes::push(const ObjectRef& object) {
  const std::uint64_t current = subscription();
  if (losses_ > 0) {
    FrameWriter losses(FrameKind::lost, current);
    losses.add(losses_);
    if (end_.send(std::move(losses), ByteEnd::Loss::allowed)) losses_ = 0;
  }
  FrameWriter frame(FrameKind::object, current);
  frame.add(std::uint64_t{0});
  frame.add(object);
  if (end_.send(std::move(frame), ByteEnd::Loss::allowed)) return;
  lost(1);
}

void PushSinkOverBytes::lost(std::uint64_t objects) {
  losses_ += objects;
  end_.traffic().objects_lost.fetch_add(objects, std::memory_order_relaxed);
}

// Called repeatedly with the same object until the client has taken it.
std::optional<Duration> PushSinkOverBytes::push_and_wait(const ObjectRef& object) {
  const std::lock_guard lock(mutex_);
  if (in_flight_ == object) {
    if (!taken_) return limit_;
    in_flight_ = {};
    return std::nullopt;
  }
  in_flight_ = object;
  taken_ = false;
  FrameWriter frame(FrameKind::object, subscription_);
  frame.add(++ticket_);
  frame.add(object);
  end_.send(std::move(frame));
  return limit_;
}

void PushSinkOverBytes::give_up(const ObjectRef& /*object*/) {
  const std::lock_guard lock(mutex_);
  in_flight_ = {};
  FrameWriter frame(FrameKind::give_up, subscription_);
  frame.add(ticket_);
  end_.send(std::move(frame));
}

void PushSinkOverBytes::granted(const UpdateGrant& grant) {
  FrameWriter frame(FrameKind::granted, subscription());
  frame.add(static_cast<std::uint64_t>(grant.base_period.count()));
  frame.add(std::uint64_t{grant.multiple});
  frame.add(static_cast<std::uint64_t>(grant.interval.count()));
  end_.send(std::move(frame));
}

}  // namespace orca::bytes
