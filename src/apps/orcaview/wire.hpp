// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

// Boost.Asio 1.74 needs it and does not include it.
#include <utility>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <functional>
#include <memory>

#include "orca/base/descriptor.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/channel.hpp"

namespace orca::view {

/// A channel that an event loop serves: to the supervisor, or the line of a port.
///
/// Thread contract: the loop's thread.
class Wire : public std::enable_shared_from_this<Wire> {
 public:
  using Taker = std::function<void(supervisor::Message)>;
  using Ended = std::function<void(const Error& why)>;

  /// Returns a wire; null if there are no descriptors left.
  [[nodiscard]] static std::shared_ptr<Wire> make(const boost::asio::any_io_executor& loop,
                                                  Descriptor socket);
  Wire(const boost::asio::any_io_executor& loop, Descriptor socket, int copy);

  /// Begins to receive.
  /// @param take   takes each message.
  /// @param ended  is called once when the other end is gone or sends nonsense, but not after close().
  void start(Taker take, Ended ended);
  /// Sends a message, or queues it.
  /// @errors  as Channel::post().
  Status post(supervisor::Message message);
  /// Ends it. Nothing is called any more.
  void close();

 private:
  void wait_to_receive();
  void receive_all();
  void wait_to_send();
  void end(const Error& why);

  supervisor::Channel channel_;
  boost::asio::posix::stream_descriptor waiting_;  // a copy of the channel's descriptor
  Taker take_;
  Ended ended_;
  bool sends_ = false;  // waits until the socket takes more
};

}  // namespace orca::view
