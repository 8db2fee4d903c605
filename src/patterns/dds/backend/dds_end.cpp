// SPDX-License-Identifier: LGPL-3.0-or-later
#include "dds_end.hpp"

#include <utility>

#include "orca/base/log.hpp"

namespace orca::dds {

using namespace frames;

namespace {

constexpr std::size_t kBehind = std::size_t{4} << 20;        // [bytes]
constexpr std::size_t kMostWaiting = std::size_t{64} << 20;  // [bytes]
constexpr std::size_t kPerFrame = 64;                        // [bytes] counted for each frame beside its own

}  // namespace

DdsEnd::DdsEnd(EndPlace place) : place_(std::move(place)) {}

DdsEnd::~DdsEnd() { DdsEnd::stop(); }

void DdsEnd::start(FrameHandlers handlers) {
  handlers_ = std::move(handlers);
  place_.strand.add_intake(*this);
  place_.line.add(place_.edge, *this);
}

void DdsEnd::boarded(std::uint64_t session) {
  line_session_ = session;
  session_ = session;
}

void DdsEnd::stop() {
  if (session_.exchange(0) == 0) return;
  place_.line.remove(place_.edge);
  place_.strand.remove_intake(*this);
  const MutexLock reading(reading_);
  handlers_ = {};
  cut_ = true;
}

Sent DdsEnd::send(const Frame& frame, Loss loss, Caller caller) {
  if (is_cut()) return Sent::cut;
  std::vector<std::byte> parcel = begin_parcel(place_.edge, Parcel::frame);
  frame.append_to(parcel);
  const std::size_t size = parcel.size();
  const By by = caller == Caller::waits ? By::caller : By::outbox;
  const Sent outcome = place_.line.send(std::move(parcel), session(), loss, by);
  if (by == By::caller) place_.outbox.write_here();
  if (outcome == Sent::too_large && !warned_.exchange(true))
    log::warning(name(), "an object takes " + std::to_string(size) +
                             " bytes, more than this link can carry; it and others like it are dropped");
  return outcome;
}

// --- News, from threads of DDS ----------------------------------------------------------------------------

void DdsEnd::arrived(Parcel kind, std::span<const std::byte> contents) {
  if (kind == Parcel::frame) return deliver({contents.begin(), contents.end()});
  if (kind == Parcel::closed)
    add({News::What::cut, {}, fail(Code::unavailable, "the other end of " + name() + " has gone")});
}

void DdsEnd::line_lost(const Error& reason) { add({News::What::cut, {}, reason}); }

void DdsEnd::line_joined(std::uint64_t session) {
  line_session_ = session;
  add({News::What::joined, {}, {}, session});
}

void DdsEnd::deliver(std::vector<std::byte> frame) {
  bool too_much = false;
  {
    const MutexLock lock(mutex_);
    too_much = waiting_bytes_ > kMostWaiting;
  }
  add(too_much ? News{News::What::fault, {}, fail(Code::unavailable, "it sends more than is read")}
               : News{News::What::frame, std::move(frame)});
}

bool DdsEnd::is_behind() const {
  const MutexLock lock(mutex_);
  return waiting_bytes_ > kBehind;
}

void DdsEnd::add(News news) {
  {
    const MutexLock lock(mutex_);
    if (news.what == News::What::fault && !news_.empty() && news_.back().what == News::What::fault) return;
    waiting_bytes_ += news.frame.size() + kPerFrame;
    news_.push_back(std::move(news));
    has_news_.store(true, std::memory_order_release);
  }
  place_.strand.wake();
}

// --- On the strand ----------------------------------------------------------------------------------------

void DdsEnd::take_news() {
  const MutexLock lock(mutex_);
  taken_.clear();  // of what a handler that threw has left
  taken_.swap(news_);
  waiting_bytes_ = 0;
  has_news_.store(false, std::memory_order_relaxed);
}

bool DdsEnd::take_in() {
  if (!has_news_.load(std::memory_order_acquire)) return false;
  if (!reading_.try_lock()) return false;
  const MutexLock reading(reading_, std::adopt_lock);
  if (!handlers_.receive) return false;
  take_news();
  for (const News& news : taken_) handle(news);
  taken_.clear();
  return true;
}

void DdsEnd::handle(const News& news) {
  switch (news.what) {
    case News::What::frame:
      if (is_cut()) return;
      if (const Status handled = handle_frame(news.frame); !handled.ok()) cut_off(handled.error());
      return;
    case News::What::joined: return begin_session(news.session);
    case News::What::cut:
      if (!is_cut()) lose(news.reason);
      return;
    case News::What::fault:
      if (!is_cut()) cut_off(news.reason);
      return;
  }
}

Status DdsEnd::handle_frame(std::span<const std::byte> bytes) {
  traffic_.frames_received.fetch_add(1, std::memory_order_relaxed);
  FrameReader frame(bytes, place_.clock_ahead ? place_.clock_ahead() : Duration{0});
  if (Status handled = handlers_.receive(frame); !handled.ok()) return handled;
  return frame.status();
}

void DdsEnd::begin_session(std::uint64_t session) {
  if (session_ == session) return;
  if (!is_cut()) lose(fail(Code::unavailable, "its peer was replaced"));
  session_ = session;
  cut_.store(false, std::memory_order_release);
  handlers_.renewed();
}

void DdsEnd::lose(const Error& reason) {
  cut_.store(true, std::memory_order_release);
  handlers_.cut(reason);
}

void DdsEnd::cut_off(const Error& reason) {
  traffic_.peers_cut_off.fetch_add(1, std::memory_order_relaxed);
  log::warning(name(), "its peer is cut off: " + reason.message);
  (void)place_.line.send(begin_parcel(place_.edge, Parcel::closed), session());
  lose(reason);
}

}  // namespace orca::dds
