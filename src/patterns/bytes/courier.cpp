// SPDX-License-Identifier: LGPL-3.0-or-later
#include "courier.hpp"

#include <utility>

#include "byte_wire.hpp"

namespace orca::bytes {

Courier::Courier() : thread_([this] { work(); }) {}

Courier::~Courier() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Courier::serve(std::shared_ptr<ByteWire> wire) {
  {
    const std::lock_guard lock(mutex_);
    wires_.push_back(std::move(wire));
  }
  notify();
}

void Courier::notify() {
  {
    const std::lock_guard lock(mutex_);
    notified_ = true;
  }
  changed_.notify_one();
}

std::vector<std::shared_ptr<ByteWire>> Courier::open_wires() {
  std::erase_if(wires_, [](const auto& wire) { return wire->closed(); });
  return wires_;
}

void Courier::work() {
  std::unique_lock lock(mutex_);
  while (!ending_) {
    notified_ = false;
    const auto wires = open_wires();
    lock.unlock();
    bool carried = false;
    for (const auto& wire : wires) carried = wire->carry() || carried;
    lock.lock();
    if (!carried) changed_.wait(lock, [this] { return notified_ || ending_; });
  }
}

}  // namespace orca::bytes
