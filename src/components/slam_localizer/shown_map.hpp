// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "orca/base/time.hpp"
#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/navigation/drawn_map.hpp"

namespace orca::slam {

/// The map that a SlamLocalizer makes, as others have it: what changes of it goes to whoever takes it. It is drawn even while nobody does, so
/// that no lap has much to draw when somebody comes.
///
/// Thread contract: the component's strand.
class ShownMap {
 public:
  explicit ShownMap(Component& owner)
      : port_(owner, "OccupancyGridPush",
              {.text = "What has changed of the map, at most once a second: a rectangle of it, with a corner "
                       "of its own "
                       "and the name of the map. The whole map to a new subscriber, and with it to all."}) {}

  /// Forgets the map; the next one has another name: the time from which it is. So it is also another one after a swap, or in a new process.
  void begin_anew(TimePoint now) {
    map_ = nav::DrawnMap(kCell);
    const auto seconds = std::chrono::floor<std::chrono::seconds>(now.time_since_epoch());
    const auto rest = std::chrono::floor<std::chrono::milliseconds>(now.time_since_epoch() - seconds);
    name_ = "slam " + std::to_string(seconds.count()) + "." + std::to_string(1000 + rest.count()).substr(1);
    whole_is_due_ = true;
  }

  /// Draws some of what is new, and pushes it once a second.
  /// @param nodes  of the Slam that makes the map.
  void show(std::span<const nav::SlamNode> nodes, TimePoint now) {
    constexpr std::size_t kMost = 10;  // per lap, so that none takes long
    constexpr Duration kPeriod = std::chrono::seconds(1);
    (void)map_.draw(nodes, kMost);
    if (port_.take_new_subscribers()) whole_is_due_ = true;
    if (port_.subscriber_count() == 0 || now < due_) return;
    due_ = now + kPeriod;
    const auto news = map_.news();
    if (std::exchange(whole_is_due_, false))
      port_.push(whole());
    else if (news)
      port_.push(grid_of(*news));
  }

  /// Returns all of the map, as far as it is drawn.
  [[nodiscard]] Loan<idl::OccupancyGrid> whole() const { return grid_of(map_.whole()); }

 private:
  static constexpr double kCell = 0.05;  // [m]

  [[nodiscard]] Loan<idl::OccupancyGrid> grid_of(const nav::MapPart& part) const {
    auto grid = port_.loan();
    grid->name(name_);
    grid->corner().x(part.lattice.corner.x);
    grid->corner().y(part.lattice.corner.y);
    grid->resolution(part.lattice.side);
    grid->columns(static_cast<std::uint32_t>(part.lattice.columns));
    grid->rows(static_cast<std::uint32_t>(part.lattice.rows));
    grid->cells(part.cells);
    return grid;
  }

  nav::DrawnMap map_{kCell};
  std::string name_;
  TimePoint due_{};
  bool whole_is_due_ = true;  // somebody takes the map who has none of it
  PushServer<idl::OccupancyGrid> port_;
};

}  // namespace orca::slam
