// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "byte_wire.hpp"
#include "frame_splitter.hpp"
#include "frames/frame_end.hpp"
#include "orca/base/executive.hpp"

namespace orca::bytes {

/// The wires by which an end reaches its peer.
struct Connection {
  Executive& executive;
  frames::Traffic& traffic;
  std::string name;  ///< For people: "a.out > b.in".
  std::shared_ptr<ByteWire> out;
  std::shared_ptr<ByteWire> in;
};

/// One end of a link of bytes, which receives frames on a task of its own. A peer that does not read is cut off,
/// too. It is never renewed.
///
/// Thread contract: as FrameEnd. The handlers run on the receiving task.
class ByteEnd final : public frames::FrameEnd {
 public:
  explicit ByteEnd(Connection connection);
  ~ByteEnd() override;

  void start(frames::FrameHandlers handlers) override;
  void stop() override;
  frames::Sent send(const frames::Frame& frame, frames::Loss loss = frames::Loss::never,
                    frames::Caller caller = frames::Caller::goes_on) override;

  [[nodiscard]] bool is_cut() const override { return cut_.load(std::memory_order_acquire); }
  [[nodiscard]] const std::string& name() const override { return connection_.name; }
  [[nodiscard]] frames::Traffic& traffic() const override { return connection_.traffic; }

 private:
  void work();
  void flush();
  Status receive_all();
  [[nodiscard]] std::optional<Error> fault() const;
  void cut_off(const Error& reason);

  Connection connection_;
  std::unique_ptr<Event> event_;
  frames::FrameHandlers handlers_;
  FrameSplitter splitter_;
  std::atomic<bool> ending_{false};
  std::atomic<bool> cut_{false};

  mutable std::mutex mutex_;
  // Below: guarded by mutex_.
  std::vector<std::byte> unsent_;  // what found no room yet, oldest first
  bool peer_is_deaf_ = false;

  std::unique_ptr<Task> task_;
};

}  // namespace orca::bytes
