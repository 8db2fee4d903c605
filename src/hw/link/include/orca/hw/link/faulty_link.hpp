// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "orca/hw/link/byte_link.hpp"

namespace orca::hw::link {

class ByteFaults;

/// What can go wrong on a line. Behind each: what FaultyLink::count() counts.
enum class Fault {
  drop,       ///< A byte is lost. Bytes.
  flip,       ///< Bits of a byte change. Bytes.
  insert,     ///< A byte comes that nobody has sent. Bytes.
  duplicate,  ///< A byte comes twice. Bytes.
  echo,       ///< What is written comes back as input. Bytes.
  silence,    ///< The device says nothing more; what it sends is lost. Bytes.
  refusal,    ///< The device takes no bytes, as after an XOFF. Writes that had to wait or were refused.
  end,        ///< The other end goes. Once each time.
  delay,      ///< Input comes later. Bytes.
  glue,       ///< Input is held until it comes in one piece with what follows. Bytes that joined others.
  split,      ///< Input is read byte by byte. Reads that gave less than was there.
};
inline constexpr std::size_t kFaults = 11;

/// The chances of each byte of one direction [0..1].
struct FaultRates {
  double drop = 0.0;
  double flip = 0.0;  ///< Of one bit, chosen at random.
  double insert = 0.0;
  double duplicate = 0.0;
};

enum class Direction { in, out };  ///< From the device; to the device.

/// A fault at one place of the stream.
struct ScriptedFault {
  Direction direction = Direction::in;
  std::uint64_t at = 0;  ///< The byte that it befalls, counted from 0 since the link was made.
  Fault fault =
      Fault::drop;  ///< One of the first four for this byte; silence, refusal or end from this byte on.
  std::uint8_t value = 0xFF;  ///< flip: the bits that change; insert: the byte that comes before this one.
};

/// The faults of the whole line, which can be switched at any time.
struct FaultModes {
  bool echo = false;
  bool silent = false;
  bool refuses = false;
  bool ended = false;  ///< The other end has gone, and open() fails.
  bool byte_by_byte = false;
  Duration delay{0};  ///< Of all input [s].
  Duration glue{0};   ///< For how long input waits for more after its first byte [s].
};

struct FaultPlan {
  std::uint64_t seed = 1;
  FaultRates in{};
  FaultRates out{};
  std::vector<ScriptedFault> script{};
  FaultModes modes{};  ///< At the beginning.
  NowFunction now{};   ///< For delay and glue.
};

/// Another link with faults. The same seed and the same bytes give the same faults, in whatever pieces they come.
///
/// Thread contract: one strand, but modes(), set_modes() and count() from any thread.
class FaultyLink final : public ByteLink {
 public:
  /// @pre  link is not null, and plan.now is set.
  FaultyLink(std::unique_ptr<ByteLink> link, FaultPlan plan);
  ~FaultyLink() override;

  [[nodiscard]] Result<Opening> open() override;
  void close() override;
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override;
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override;
  [[nodiscard]] Status flush() override;
  [[nodiscard]] std::size_t pending() const override;
  void discard_input() override;
  void discard_output() override;
  /// Returns -1: the inner link's would not tell of what is held back.
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] std::string name() const override { return link_->name(); }
  [[nodiscard]] Status set_line(const Line& line) override { return link_->set_line(line); }
  [[nodiscard]] Status set_dtr(bool raised) override { return link_->set_dtr(raised); }
  [[nodiscard]] double byte_time() const override { return link_->byte_time(); }

  [[nodiscard]] FaultModes modes() const;
  void set_modes(const FaultModes& modes);
  /// Returns how often a fault has happened since the link was made.
  [[nodiscard]] std::uint64_t count(Fault fault) const;

 private:
  struct Held {
    std::uint8_t byte;
    TimePoint due;
  };

  void change_modes(const FaultModes& modes);
  void take_in();
  void hold(const std::vector<std::uint8_t>& bytes);
  [[nodiscard]] std::size_t hand_out(std::span<std::uint8_t> into);
  [[nodiscard]] Status send(std::span<const std::uint8_t> bytes);
  [[nodiscard]] Status send_waiting();
  [[nodiscard]] Error gone() const;
  std::uint64_t& counter(Fault fault) { return counts_[static_cast<std::size_t>(fault)]; }

  const std::unique_ptr<ByteLink> link_;
  const NowFunction now_;
  mutable std::mutex mutex_;  // protects all that follows
  const std::unique_ptr<ByteFaults> in_;
  const std::unique_ptr<ByteFaults> out_;
  FaultModes modes_;
  std::array<std::uint64_t, kFaults> counts_{};
  std::deque<Held> held_;              // input, in the order in which it came
  std::optional<Error> failure_;       // of the inner link; told when the input before it has been read
  std::vector<std::uint8_t> waiting_;  // output that the device refuses
};

}  // namespace orca::hw::link
