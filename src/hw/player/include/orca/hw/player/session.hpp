// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "orca/hw/player/message.hpp"

/// Messages of the device "player", which is the server itself, and of the session.
namespace orca::hw::player {

/// Empty; answered by DeviceList.
inline constexpr MessageId kListDevices{Interface::player, MessageType::request, 1};
/// DriverInfo without a name; answered by DriverInfo.
inline constexpr MessageId kAskDriver{Interface::player, MessageType::request, 2};
/// Subscription without a name; answered by Subscription, or by a nack if there is no such device.
inline constexpr MessageId kSubscribe{Interface::player, MessageType::request, 3};
/// Empty. In pull mode: the answer is an empty ack, the data that have come meanwhile, and a synch.
inline constexpr MessageId kAskData{Interface::player, MessageType::request, 4};
/// DataMode; the answer is empty.
inline constexpr MessageId kSetDataMode{Interface::player, MessageType::request, 5};
/// What a full queue of the server does; the answer is empty.
inline constexpr MessageId kAddReplaceRule{Interface::player, MessageType::request, 10};
/// Empty. Ends a round of data. Recognise it by its type: which device a server names in it was not recorded.
inline constexpr MessageId kSynch{Interface::player, MessageType::synch, 1};
/// The devices of a server.
struct DeviceList {
  static constexpr std::string_view kName = "player DEVLIST";
  std::vector<Address> devices{};
  friend bool operator==(const DeviceList&, const DeviceList&) = default;
};

/// Question for the driver of a device, and the answer.
struct DriverInfo {
  static constexpr std::string_view kName = "player DRIVERINFO";
  Address device{};
  std::string driver{};  ///< Empty in a question. A zero byte would end it.
  friend bool operator==(const DriverInfo&, const DriverInfo&) = default;
};

enum class Access : std::uint32_t {
  open = 1,     ///< Subscribe; in an answer: subscribed.
  close = 2,    ///< Unsubscribe; in an answer: unsubscribed.
  refused = 3,  ///< In an answer: the driver did not start. Retry later.
};

/// Wish to open or close a device, and the answer. A device may take many seconds to open.
struct Subscription {
  static constexpr std::string_view kName = "player DEV";
  Address device{};
  Access access = Access::open;
  std::string driver{};  ///< Empty in a wish. A zero byte would end it.
  friend bool operator==(const Subscription&, const Subscription&) = default;
};

/// How data come to the client.
struct DataMode {
  static constexpr std::string_view kName = "player DATAMODE";
  enum class Mode : std::uint32_t {
    push = 1,  ///< As they arise. The default of a new connection.
    pull = 2,  ///< At each kAskData.
  };
  Mode mode = Mode::push;
  friend bool operator==(const DataMode&, const DataMode&) = default;
};

/// Question whether a device knows a message.
struct Capability {
  static constexpr std::string_view kName = "capability query";
  std::uint32_t type = 0;
  std::uint32_t subtype = 0;
  friend bool operator==(const Capability&, const Capability&) = default;
};

}  // namespace orca::hw::player
