// SPDX-License-Identifier: LGPL-3.0-or-later
#include "publication.hpp"

#include <utility>

namespace orca::dds {
namespace {

constexpr int kMostEdges = 62;                             // what a label has room for
constexpr std::size_t kMostQueued = std::size_t{4} << 20;  // [bytes]

}  // namespace

std::optional<std::uint64_t> Publication::reserve() {
  for (int i = 0; i < kMostEdges; ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    if ((taken_ & bit) != 0) continue;
    taken_ |= bit;
    return bit;
  }
  return std::nullopt;
}

bool Publication::add(const ObjectRef& object, std::uint64_t bit) {
  if (pending_ != object) {
    flush();
    if (writer_->queued.load(std::memory_order_relaxed) >= kMostQueued) return false;
    pending_ = object;
  }
  due_ |= bit;
  return true;
}

void Publication::flush() {
  if (!pending_) return;
  const Label label{pending_.type().layout_hash, std::exchange(due_, 0), epoch_};
  const std::size_t size = pending_.type().write(pending_.get(), {});
  outbox_.post({writer_, std::exchange(pending_, {}), label, {}, size});
}

}  // namespace orca::dds
