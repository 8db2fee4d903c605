// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <poll.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// An order, and who has given it.
struct Told {
  Order order;
  std::uint64_t request = 0;
  std::shared_ptr<Channel> by;
};

/// The wait of a host process that has lost its supervisor. It takes in one visitor after the other, tells each who this
/// process is, and hears what it orders. A visitor that says nothing for kPatience, or what a visitor may not order, is sent
/// away; one that is gone changes nothing.
///
/// Thread contract: one thread. Nothing waits.
class Vigil {
 public:
  static constexpr auto kPatience = std::chrono::seconds(5);

  /// @param place      the meeting place; outlives the object.
  /// @param introduce  makes what each visitor hears first.
  Vigil(const ControlSocket& place, std::function<Orphaned()> introduce)
      : place_(place), introduce_(std::move(introduce)) {}

  /// Adds what it waits for.
  void add_to(std::vector<pollfd>& all) const;
  /// Takes in a visitor, and returns what it orders: Adopt, StopMotors, ReleaseMotors or TakeDown; nothing if it has said
  /// nothing yet.
  [[nodiscard]] std::optional<Told> turn(Moment now);

 private:
  void take_in(Moment now);
  [[nodiscard]] std::optional<Told> hear();

  const ControlSocket& place_;
  const std::function<Orphaned()> introduce_;
  std::shared_ptr<Channel> visitor_;
  Moment sent_away_at_{};  // unless it says something
};

}  // namespace orca::supervisor
