// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <functional>
#include <mutex>

#include "orca/base/result.hpp"
#include "orca/patterns/endpoint.hpp"

namespace orca {

/// Where sent objects go: the server's side of a link.
class SendTarget {
 public:
  virtual ~SendTarget() = default;
  /// Accepts the object for the server, or refuses it with the reason; never loses it silently, never blocks.
  virtual Status offer(const ObjectRef& object) = 0;
  [[nodiscard]] virtual std::string path() const = 0;
};

/// What has happened at one Send or Query server so far.
struct IntakeCounters {
  std::uint64_t accepted = 0;
  std::uint64_t refused = 0;  ///< Not accepted: full or closed.
  std::uint64_t failed = 0;   ///< Accepted, but the handler returned an error or threw.
};

/// Server side of Send: accepted objects wait here until the component's strand handles them between two
/// laps.
///
/// Thread contract: offer() from any strand; the rest from the server's.
class SendServerEndpoint final : public Endpoint, public SendTarget {
 public:
  using Handler = std::function<Status(const ObjectRef&)>;

  SendServerEndpoint(PortHome& home, PortContract contract);

  Status offer(const ObjectRef& object) override;
  [[nodiscard]] std::string path() const override { return Endpoint::path(); }

  /// Opens or closes the intake. Closed, everything is refused with `reason`.
  void open(Handler handler);
  void close(std::string reason);

  /// Handles one waiting object.
  /// @return false if none was waiting. The handler's own error is counted and returned through `outcome`;
  /// what it throws is counted and passes.
  bool handle_one(Status& outcome);

  /// Whether something waits to be handled.
  [[nodiscard]] bool has_waiting() const;
  [[nodiscard]] IntakeCounters counters() const;

 private:
  void count_failure();

  mutable std::mutex mutex_;
  std::deque<ObjectRef> waiting_;
  Handler handler_;
  std::string closed_because_ = "it has not been started yet";
  IntakeCounters counters_;
};

/// Client side of Send.
///
/// Thread contract: the client's strand.
class SendClientEndpoint final : public Endpoint {
 public:
  SendClientEndpoint(PortHome& home, PortContract contract);

  void connect(SendTarget& target) { target_ = &target; }
  [[nodiscard]] bool connected() const { return target_ != nullptr; }

  /// @errors  failed_precondition if not connected; unavailable with the server's reason if refused.
  Status send(ObjectLoan loan, const Provenance* provenance);

 private:
  SendTarget* target_ = nullptr;
};

}  // namespace orca
