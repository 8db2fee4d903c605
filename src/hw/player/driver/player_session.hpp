// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/line_session.hpp"
#include "orca/hw/player/message_reader.hpp"
#include "orca/hw/player/payload.hpp"
#include "orca/hw/player/sensors.hpp"
#include "orca/hw/player/session.hpp"
#include "player_uses.hpp"

namespace orca::hw::player {

/// What a server has said of its robot.
struct PlayerRobotFacts {
  std::string version;                    ///< Of the server.
  std::string driver;                     ///< Of the base.
  std::vector<std::string> shortcomings;  ///< What is missing, for people, with what to do.
  std::optional<Geometry> base;           ///< Nothing: it does not say.
  std::optional<SonarGeometry> sonars;    ///< Likewise.
  std::optional<Geometry> laser;          ///< Likewise.
  std::optional<RangerConfig> angles;     ///< Of a laser that is a ranger; likewise.
};

/// The connection to a Player server: waits for the banner, lets data come by themselves, asks what devices there are, opens the base and
/// those others that are wished, and asks where they are. Then it passes messages on.
///
/// One request is made at a time. Without a base there is no hope; without another device, or its place, it goes on. Drivers answer when
/// they have started, which takes some of them half a minute: what comes later is taken then.
///
/// Thread contract: not synchronised; the container's strand.
/// @source  Player 3.1 server and its client library libplayerc.
class PlayerSession final : public LineSession {
 public:
  /// A function that takes a message, and when its first byte came.
  using Take = std::function<void(const Message&, TimePoint sent)>;

  /// @param link      outlives the object.
  /// @param wishes    the base, and other devices that are used as far as the server has them.
  /// @param patience  [s] for the answer when a device is opened, whose driver starts then, and for the first answers of all drivers.
  PlayerSession(link::ByteLink& link, std::vector<Use> wishes, Duration patience);

  /// What the line has brought since it was opened is not dropped, for that is the banner.
  Status begin(TimePoint now) override;
  /// @return whether all is open.
  /// @errors  not_found if nothing or something else than a Player server speaks, or if there is no base; unavailable if the base is refused;
  ///          deadline_exceeded if a request gets no answer; each with what to do. Those of the link and of MessageReader.
  Result<bool> advance(TimePoint now) override;
  [[nodiscard]] TimePoint next() const override { return deadline_; }
  [[nodiscard]] LineCounts counts() const override {
    return {.frames = messages_ - bad_, .bad_checksums = bad_};
  }

  /// Reads what there is and hands out the messages.
  /// @errors  those of the link and of MessageReader.
  Status receive(TimePoint now, const Take& take);

  /// Takes an answer that did not come in time: of a driver that was still starting.
  /// @return whether it has changed facts().
  bool take_late(const Message& message);

  /// Sends a message to the device of an interface with this number.
  /// @errors  those of ByteLink::write().
  Status send(const MessageId& id, std::span<const std::uint8_t> payload, std::uint32_t index = 0);

  /// Counts a message that could not be read.
  void note_bad() { ++bad_; }
  [[nodiscard]] const PlayerRobotFacts& facts() const { return facts_; }

 private:
  // A request whose answer is awaited, or will be.
  struct Question {
    MessageId id;
    std::vector<std::uint8_t> payload;
    Use about{};  // which device, unless it is about the server

    // Of the device that is asked, which is the server itself if it is to open one.
    [[nodiscard]] std::uint32_t index() const { return id.interface == Interface::player ? 0 : about.index; }
    // The driver of the device answers, not the server.
    [[nodiscard]] bool is_about_place() const { return id.interface != Interface::player; }
  };

  void ask_place(const Use& device);
  Status ask(TimePoint now);
  Status take(const Message& message, TimePoint now);
  [[nodiscard]] bool is_late(const Message& message) const;
  Status take_answer(const Question& question, std::span<const std::uint8_t> payload);
  Status take_devices(std::span<const std::uint8_t> payload);
  Status take_subscription(const Use& about, std::span<const std::uint8_t> payload);
  Status take_geometry(const Question& question, std::span<const std::uint8_t> payload);
  Status take_ranger(const Question& question, std::span<const std::uint8_t> payload);
  Status refuse(const Question& question);
  Status miss(const Question& question);
  Status go_without(const Use& about, const std::string& why);

  link::ByteLink& link_;
  const std::vector<Use> wishes_;
  const Duration patience_;
  MessageReader reader_{MessageReader::Side::client};
  std::deque<Question> questions_;       // the first one was asked
  std::vector<Question> late_;           // that were asked, and not answered in time
  std::optional<TimePoint> places_due_;  // the answers of drivers; nothing: none was asked
  bool greeted_ = false;
  TimePoint deadline_{};
  PlayerRobotFacts facts_;
  std::uint64_t messages_ = 0;
  TimePoint begun_{};      // when the first byte came of the message that is not whole yet
  std::uint64_t bad_ = 0;  // of them
};

}  // namespace orca::hw::player
