// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/idl/object.hpp"
#include "orca/supervisor/control.hpp"
#include "system_link.hpp"

namespace orca::view {

/// Whoever wants the objects that pass a port.
class Onlooker {
 public:
  /// The line is there.
  virtual void looking(const std::string& type) = 0;
  /// It cannot be, or is gone. Nothing follows.
  virtual void blind(const Error& why, bool had_seen) = 0;
  /// Takes an object; all onlookers of a port share it.
  virtual void see(const std::shared_ptr<const supervisor::Tapped>& passed) = 0;

 protected:
  Onlooker() = default;
  ~Onlooker() = default;
};

/// The ports at which pages look, and to which they send. All that look at one port share one line to its process, so that
/// a process has no more to do for fifty pages than for one.
///
/// Thread contract: the loop's thread.
class Ports {
 public:
  /// Whom an object comes from: as in supervisor::Ask.
  struct Asker {
    supervisor::Access most = supervisor::Access::change;
    std::string via{};
    auto operator<=>(const Asker&) const = default;
  };
  using Answered = std::function<void(const Result<supervisor::OfferOutcome>& outcome)>;

  explicit Ports(SystemLink& link, const boost::asio::any_io_executor& loop) : link_(link), loop_(loop) {}
  ~Ports();
  Ports(const Ports&) = delete;
  Ports& operator=(const Ports&) = delete;

  /// Begins to look at a port. Answers come later.
  void look(const std::string& port, Onlooker& onlooker);
  /// Ends it; nothing if it has ended.
  void look_away(const std::string& port, Onlooker& onlooker);

  /// Begins all looks anew, with lines that begin now.
  void look_anew();

  /// Sends an object in its text form to a SendServer, or a question to a QueryServer.
  /// @param asker  whose role counts, unless the object only asks: then it goes to a QueryServer as from orcaview itself.
  void offer(const std::string& port, const std::string& xml, const Asker& asker, Answered answered);
  /// Returns whether there is a line for that already, so that the supervisor is not asked.
  [[nodiscard]] bool reaches(const std::string& port, const std::string& xml, const Asker& asker) const;

 private:
  struct View {
    std::string type;  // empty: the line is not there yet
    std::shared_ptr<Wire> wire;
    std::vector<Onlooker*> onlookers;
  };
  struct Counter {  // at which objects are handed in
    std::string type;
    bool answers = false;  // whether it is a QueryServer's
    std::shared_ptr<Wire> wire;
    std::map<std::uint64_t, Answered> waiting;
    std::vector<std::function<void(const Status&)>> opened;  // who waits for the line
  };
  void open_view(const std::string& port);
  void take(View& view, supervisor::Message message);
  void end_view(const std::string& port, const Error& why);
  // A port, and for whom its line was opened. What one role has opened serves no other.
  using CounterKey = std::pair<std::string, Asker>;
  [[nodiscard]] static CounterKey key_for(const std::string& port, const std::string& xml,
                                          const Asker& asker);
  void when_open(const CounterKey& key, std::function<void(const Status&)> then);
  void close_idle_counters();
  void hand_in(Counter& counter, const std::string& xml, Answered answered);
  void end_counter(const CounterKey& key, const Error& why);

  SystemLink& link_;
  const boost::asio::any_io_executor loop_;
  std::map<std::string, std::shared_ptr<View>> views_;
  std::map<CounterKey, std::shared_ptr<Counter>> counters_;
  std::uint64_t last_request_ = 0;
};

}  // namespace orca::view
