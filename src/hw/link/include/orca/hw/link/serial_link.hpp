// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/stream_link.hpp"

namespace orca::hw::link {

class OldSettings;
class SerialPlaces;

struct SerialOptions {
  /// A path, or a name in /dev/serial/by-id, /dev/serial/by-path or /dev.
  std::string device;
  Line line{};
  /// Where the system keeps by-id and by-path.
  std::string folder = "/dev/serial";
  /// For how long open() waits for a device that is not there yet [s].
  Duration patience{0};
  NowFunction now = steady_now;  ///< The clock of that.
  /// Says before each opening whether the place may be trusted; empty: it may.
  std::function<Status()> check{};
};

/// A serial line: raw bytes, any rate, no flow control. The port is this link's alone while it is open.
///
/// An adapter that was unplugged is found again by its name in by-id, even if it comes back under another number. A
/// device that has taken the old number meanwhile is not opened: commands to the motors must not go to a stranger. A name
/// in by-id or by-path is always followed. By-path is the choice for two adapters of one make without serial numbers, which
/// have one name in by-id.
///
/// What is pending includes what the driver of the port still holds. A device that takes none of it for half a second, because an
/// XOFF or the wires of flow control hold it back, has failed (deadline_exceeded): what waits would reach it too late, so close()
/// drops it. close() lets out what was written last, which is
/// often a command to stop, but waits at most 50 ms for that, and puts the old settings back. The system lowers DTR behind a
/// port that is closed, unless set_dtr() was called: then it stays as it was set.
///
/// Thread contract: one strand.
class SerialLink final : public StreamLink {
 public:
  explicit SerialLink(SerialOptions options);
  ~SerialLink() override;

  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] std::size_t pending() const override;
  void discard_input() override;
  void discard_output() override;
  [[nodiscard]] std::string name() const override { return "serial:" + options_.device; }
  [[nodiscard]] Status set_line(const Line& line) override;
  [[nodiscard]] Status set_dtr(bool raised) override;
  [[nodiscard]] double byte_time() const override { return options_.line.byte_time(); }

  /// Returns the path, without links, of the device that is open; empty: none is.
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  [[nodiscard]] Status write_paced(std::span<const std::uint8_t> bytes);
  [[nodiscard]] bool goes_on_waiting();
  [[nodiscard]] Result<std::string> locate() const;
  [[nodiscard]] Result<Descriptor> claim(const std::string& path);
  [[nodiscard]] Status take(int terminal);
  [[nodiscard]] Status check_flow();
  void let_last_words_out();

  SerialOptions options_;
  const std::unique_ptr<SerialPlaces> places_;
  const std::unique_ptr<OldSettings> old_;
  std::string identity_;  // the path in by-id of the adapter that was opened first, by another name
  std::string path_;
  std::optional<bool> dtr_;               // raised or lowered; nothing: nobody has asked for it
  std::optional<TimePoint> waits_since_;  // for a device that is not there
  // On the system's clock: how long the line is busy with what was written, at its rate; and when it was last seen to take some.
  TimePoint busy_until_;
  TimePoint flowed_;
  std::size_t waited_ = 0;  // bytes, at that look
};

}  // namespace orca::hw::link
