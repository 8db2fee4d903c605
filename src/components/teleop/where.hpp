// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"

namespace orca::teleop {

/// The question where the robot is, answered while it is driven on: nothing waits for the answer.
///
/// Thread contract: the component's strand.
class Where {
 public:
  using Port = QueryProxy<idl::AskReading, idl::Odometry>;

  /// @param port  of the base's odometry; it must outlive this object.
  explicit Where(Port& port) : port_(port) {}

  /// Asks where the robot is at `now` or a moment later. Has no effect while a question is open.
  void ask(TimePoint now);
  /// Returns what there is to say to whoever has asked, once: the position, or why it is not known.
  [[nodiscard]] std::optional<std::string> look(TimePoint now);
  /// Forgets an open question.
  void forget();

 private:
  void send();
  [[nodiscard]] std::string answered(std::string text);

  Port& port_;
  std::optional<TimePoint> since_;  // when it was asked, until it is answered
  std::optional<QueryId> question_;
  std::string trouble_;  // why the last question has no answer
};

}  // namespace orca::teleop
