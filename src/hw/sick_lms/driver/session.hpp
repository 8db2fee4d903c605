// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/line_frames.hpp"
#include "orca/hw/line_session.hpp"
#include "orca/hw/sick_lms/reply.hpp"
#include "orca/hw/sick_lms/request.hpp"

namespace orca::hw::sick_lms {

/// What a laser shall be set to.
struct Wishes {
  Variant variant{};
  Unit unit = Unit::millimetre;
  std::uint8_t measuring_mode = 0;  ///< Or another one with the same bits of distance.
  std::uint32_t rate = 0;           ///< [baud] 0: the fastest that line and laser can have.
  Duration patience{0};             ///< For a laser that does not answer yet [s].
};

/// A telegram of the laser, and when its first byte left it.
struct Received {
  Reply reply;
  TimePoint stamp;
};

/// The connection to a laser: finds the rate of the line, stops what is being sent, sets the laser to what is wished, changes to
/// the wished rate, and then passes telegrams on.
///
/// The configuration is written only if it differs, since that wears the laser's memory. The lone bytes 06 are not needed; after
/// 15 a request is sent again.
///
/// Thread contract: not synchronised; the container's strand.
/// @source  LMS2xx telegram listing; order of requests and times of public drivers.
class Session final : public hw::LineSession {
 public:
  /// @param link      outlives the object.
  /// @param has_rate  whether the link has a rate; a connection has none.
  Session(link::ByteLink& link, const Wishes& wishes, bool has_rate);

  Status begin(TimePoint now) override;
  /// Also sets the laser, which then waits for send(request_mode(...)).
  /// @errors  those of LineSession; failed_precondition if the laser refuses what it must not refuse.
  Result<bool> advance(TimePoint now) override;
  [[nodiscard]] TimePoint next() const override { return deadline_; }
  [[nodiscard]] LineCounts counts() const override { return counts_of(scanner_.statistics()); }

  /// Reads what there is and hands out the telegrams.
  /// @errors  those of the link.
  Status receive(TimePoint now, const std::function<void(const Received&)>& take);
  /// Sends a request. At 500000 baud it pauses after each byte, as the laser needs it: 1 ms in all.
  /// @errors  those of ByteLink::write().
  Status send(const Telegram& request) { return link_.write(request.view()); }

  /// Returns type and version, as the laser names itself. @pre  advance() has returned true, as for the rest.
  [[nodiscard]] const std::string& type() const { return type_; }
  [[nodiscard]] const Configuration& configuration() const { return configuration_; }
  /// Returns the rate of the line [baud].
  [[nodiscard]] std::uint32_t rate() const { return rate_; }
  /// Returns why the rate is not the wished one; empty: it is.
  [[nodiscard]] const std::string& rate_trouble() const { return rate_trouble_; }

 private:
  enum class Step { find, type, read, install, write, leave, rate, settle, confirm, variant, done };

  Status say(Step step, TimePoint now);
  Status say_again(TimePoint now);
  [[nodiscard]] Result<Telegram> request() const;
  [[nodiscard]] Duration patience() const;
  Status take(const Reply& reply, TimePoint now);
  [[nodiscard]] bool answers(const Reply& reply) const;
  Status take_answer(const Reply& reply, TimePoint now);
  Status take_written(const Reply& reply, TimePoint now);
  Status take_variant(const Reply& reply, TimePoint now);
  Status take_configuration(const Reply& reply, TimePoint now);
  Status choose_rate(TimePoint now);
  [[nodiscard]] Result<bool> can_have(std::uint32_t baud);
  Status take_rate(const Reply& reply, TimePoint now);
  void miss_rate(const std::string& why);
  Status give_up(TimePoint now);
  Status find_from(std::size_t index, TimePoint now);
  Status set_rate(std::uint32_t baud);
  [[nodiscard]] Error nobody() const;
  [[nodiscard]] Error refused(const std::string& what) const;

  link::ByteLink& link_;
  const Wishes wishes_;
  const bool has_rate_;
  framing::Scanner scanner_{kFromLaser};
  Arrivals arrivals_;
  framing::Scanner own_{kFromHost};  // finds our own requests, which a loop sends back
  Step step_ = Step::find;
  std::vector<std::uint32_t> order_;  // of the rates at which it is looked for
  std::uint32_t last_rate_ = 0;       // at which it worked last
  std::size_t index_ = 0;             // of the rate at which it is looked for now
  std::uint32_t rate_ = 0;            // of the line
  std::uint32_t wanted_ = 0;
  int tries_ = 0;  // of this step
  TimePoint deadline_{};
  TimePoint patient_until_{};
  std::set<std::uint32_t> unusable_;  // rates that the laser refused, or at which it was not heard any more
  std::string type_;
  Configuration configuration_;
  std::string rate_trouble_;
};

}  // namespace orca::hw::sick_lms
