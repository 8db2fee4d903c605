// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include "wire.hpp"

// after wire.hpp, which includes what Boost.Asio lacks
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "orca/base/result.hpp"
#include "replay/recorded_system.hpp"

namespace orca::view {

/// A recording that is played: it answers like the supervisor and the processes of a running system, at a time that goes on, stands,
/// or is set, so that whoever shows a system shows a recording. It refuses all orders but `replay`.
///
/// Thread contract: the loop's thread.
class Playback {
 public:
  static constexpr double kSlowest = 0.1;
  static constexpr double kFastest = 100.0;

  /// @param jumped  is called when the time was set, so that everything seen so far holds no more.
  Playback(const boost::asio::any_io_executor& loop, RecordedSystem system, std::function<void()> jumped);
  ~Playback();
  Playback(const Playback&) = delete;
  Playback& operator=(const Playback&) = delete;

  /// Returns a connection, as to a supervisor.
  /// @errors  unavailable if there are no descriptors left.
  [[nodiscard]] Result<Descriptor> connect();

 private:
  struct Client {
    std::shared_ptr<Wire> wire;
    std::optional<std::uint64_t> log{};  // request of whoever follows the log
    std::set<std::string> who{};         // whose
  };
  struct Line {
    std::string row;
    std::shared_ptr<Wire> wire;
  };
  using Clients = std::list<Client>;
  using Stamp = recording::Stamp;

  void take(Client& client, supervisor::Message message);
  bool show(const supervisor::Ask& ask, const std::function<void(supervisor::ControlAnswer)>& say) const;
  void answer(Client& client, const supervisor::Ask& ask, std::uint64_t request);
  Status steer(const std::vector<std::string>& words);
  Status open_line(Client& client, const std::string& port, std::uint64_t request);
  void jump(Stamp time);
  void wait();
  void turn();
  void pass_on(Stamp from, Stamp to);
  [[nodiscard]] supervisor::Record state() const;

  const boost::asio::any_io_executor loop_;
  const RecordedSystem system_;
  const std::function<void()> jumped_;
  boost::asio::steady_timer timer_;
  Clients clients_;
  std::list<Line> lines_;
  Stamp now_;
  bool plays_ = true;
  double speed_ = 1.0;
  std::chrono::steady_clock::time_point turned_{};
};

}  // namespace orca::view
