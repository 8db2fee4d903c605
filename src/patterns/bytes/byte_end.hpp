// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "byte_wire.hpp"
#include "frame.hpp"
#include "orca/base/executive.hpp"
#include "traffic.hpp"

namespace orca::bytes {

/// The wires by which an end reaches its peer.
struct Connection {
  Executive& executive;
  Traffic& traffic;
  std::string name;  ///< For people: "a.out > b.in".
  std::shared_ptr<ByteWire> out;
  std::shared_ptr<ByteWire> in;
};

/// One end of a link of bytes. It sends frames to a peer, and receives frames on a task of its own. A peer
/// that sends invalid data, or that does not read, is cut off: nothing passes in either direction any more,
/// and the event is counted and logged.
///
/// Thread contract: send() and cut() from any thread; start() and stop() from one task.
class ByteEnd {
 public:
  /// Whether a frame may be dropped because the link has no room for it.
  enum class Loss { never, allowed };
  /// Handles a frame; an error cuts the peer off.
  using Receive = std::function<Status(FrameReader&)>;

  explicit ByteEnd(Connection connection);
  ~ByteEnd();
  ByteEnd(const ByteEnd&) = delete;
  ByteEnd& operator=(const ByteEnd&) = delete;

  /// Starts the receiving task, which calls both functions; neither may block.
  /// @param on_cut  called once if the link is cut by either side.
  void start(Receive receive, std::function<void(const Error&)> on_cut);
  /// Cuts the link and ends the receiving task.
  void stop();

  /// Sends a frame, at once or as soon as the link has room.
  /// @return false if it was dropped: there was no room, or the link is cut.
  bool send(FrameWriter frame, Loss loss = Loss::never);

  [[nodiscard]] bool is_cut() const { return cut_.load(std::memory_order_acquire); }
  [[nodiscard]] const std::string& name() const { return connection_.name; }
  [[nodiscard]] Executive& executive() const { return connection_.executive; }
  [[nodiscard]] Traffic& traffic() const { return connection_.traffic; }

 private:
  void work();
  void flush();
  Status receive_all();
  [[nodiscard]] std::optional<Error> fault() const;
  void cut_off(const Error& reason);

  Connection connection_;
  std::unique_ptr<Event> event_;
  Receive receive_;
  std::function<void(const Error&)> on_cut_;
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
