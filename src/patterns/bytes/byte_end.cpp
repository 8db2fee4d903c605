// SPDX-License-Identifier: LGPL-3.0-or-later
#include "byte_end.hpp"

#include <array>
#include <utility>

#include "orca/base/log.hpp"

namespace orca::bytes {

using namespace frames;

namespace {

constexpr std::size_t kMostUnsent = std::size_t{64} << 20;  // [bytes]

}  // namespace

ByteEnd::ByteEnd(Connection connection)
    : connection_(std::move(connection)), event_(connection_.executive.make_event()) {}

ByteEnd::~ByteEnd() { stop(); }

void ByteEnd::start(FrameHandlers handlers) {
  handlers_ = std::move(handlers);
  connection_.in->set_receiver(event_.get());
  connection_.out->set_sender(event_.get());
  task_ = connection_.executive.spawn({"link " + connection_.name, 0}, [this] { work(); });
}

void ByteEnd::stop() {
  if (task_ == nullptr) return;
  ending_ = true;
  event_->notify();
  task_->join_until(kForever);
  task_.reset();
  connection_.in->set_receiver(nullptr);
  connection_.out->set_sender(nullptr);
  connection_.in->close();
  connection_.out->close();
  cut_ = true;
}

Sent ByteEnd::send(const Frame& frame, Loss loss, Caller /*caller*/) {
  if (is_cut()) return Sent::cut;
  const std::lock_guard lock(mutex_);
  if (loss == Loss::allowed && !unsent_.empty()) return Sent::no_room;
  const std::vector<std::byte> bytes = in_stream(frame);
  const std::size_t sent = unsent_.empty() ? connection_.out->write(bytes) : 0;
  unsent_.insert(unsent_.end(), bytes.begin() + static_cast<std::ptrdiff_t>(sent), bytes.end());
  if (unsent_.size() > kMostUnsent && !std::exchange(peer_is_deaf_, true)) event_->notify();
  return Sent::yes;
}

void ByteEnd::flush() {
  const std::lock_guard lock(mutex_);
  if (unsent_.empty()) return;
  const std::size_t sent = connection_.out->write(unsent_);
  unsent_.erase(unsent_.begin(), unsent_.begin() + static_cast<std::ptrdiff_t>(sent));
}

void ByteEnd::work() {
  while (!ending_) {
    if (!is_cut()) {
      flush();
      const bool closed = connection_.in->closed();  // first: what was sent before is still received
      Status received = receive_all();
      if (const auto deaf = fault(); received.ok() && deaf) received = *deaf;
      if (!received.ok()) {
        connection_.traffic.peers_cut_off.fetch_add(1, std::memory_order_relaxed);
        log::warning(connection_.name, "its peer is cut off: " + received.error().message);
        cut_off(received.error());
      } else if (closed) {
        cut_off(fail(Code::unavailable, "the other end of " + connection_.name + " has gone"));
      }
    }
    event_->wait_until(kForever);
  }
}

std::optional<Error> ByteEnd::fault() const {
  const std::lock_guard lock(mutex_);
  if (!peer_is_deaf_) return std::nullopt;
  return fail(Code::unavailable, std::to_string(unsent_.size()) + " bytes wait to be read by it");
}

Status ByteEnd::receive_all() {
  std::array<std::byte, 4096> portion;
  while (const std::size_t count = connection_.in->read(portion)) {
    splitter_.append(std::span(portion).first(count));
    for (;;) {
      const auto frame = splitter_.next();
      if (!frame) return frame.error();
      if (!frame->has_value()) break;
      connection_.traffic.frames_received.fetch_add(1, std::memory_order_relaxed);
      FrameReader reader(**frame);
      if (Status handled = handlers_.receive(reader); !handled.ok()) return handled;
      if (Status whole = reader.status(); !whole.ok()) return whole;
    }
  }
  return ok();
}

void ByteEnd::cut_off(const Error& reason) {
  cut_.store(true, std::memory_order_release);
  connection_.in->close();
  connection_.out->close();
  handlers_.cut(reason);
}

}  // namespace orca::bytes
