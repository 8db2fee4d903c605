// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "hardware_instance.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/seat.hpp"

namespace orca::host {

/// The place of one hardware element of the graph in this process: the seat that its servers hold, the driver in it, and
/// beside it for a while a spare one, which is to take the driver's place or has left it.
///
/// Thread contract: name(), seat(), shut_down() and is_closed() from any thread; the rest from the executive's main task.
class HardwarePlace {
 public:
  /// @param driver  constructed.
  explicit HardwarePlace(std::unique_ptr<HardwareInstance> driver);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] hw::HardwareSeat& seat() { return seat_; }
  [[nodiscard]] HardwareInstance& driver() { return *driver_; }
  /// Returns the other driver; null: there is none.
  [[nodiscard]] HardwareInstance* spare() { return spare_.get(); }

  /// Takes a driver beside the present one. @pre  there is no spare one.
  HardwareInstance& add_spare(std::unique_ptr<HardwareInstance> driver);
  /// Exchanges the driver and the spare one. The seat is not changed.
  void exchange();
  /// Destroys the spare driver if its strand has ended by the deadline.
  /// @return whether there is no spare one any more.
  bool remove_spare(TimePoint deadline);

  /// Starts a strand that opens a device, unless all was shut down.
  void run(HardwareInstance& driver);
  /// Stops the motors, closes the devices and ends the strands, for good.
  void shut_down();
  /// Returns whether nothing is open any more, as far as a driver works.
  [[nodiscard]] bool is_closed() const;
  /// Waits until the strands have ended, at most until the deadline.
  [[nodiscard]] bool join_until(TimePoint deadline);

 private:
  const std::string name_;
  mutable std::mutex mutex_;
  // Changed by the main task with mutex_ held, so that it reads them without.
  std::unique_ptr<HardwareInstance> driver_;
  std::unique_ptr<HardwareInstance> spare_;
  bool ending_ = false;
  hw::HardwareSeat seat_;
};

}  // namespace orca::host
