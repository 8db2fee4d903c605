// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::supervisor {

/// A place in the network at which the machines of a system, or the systems of a team, say what they have to say, and hear what the
/// others do. What is said may be lost, doubled or late, and anybody may say anything.
///
/// Thread contract: one thread.
class Bulletin {
 public:
  Bulletin() = default;
  virtual ~Bulletin() = default;
  Bulletin(const Bulletin&) = delete;
  Bulletin& operator=(const Bulletin&) = delete;

  /// Says something to all who listen now.
  /// @param state  an object of the bulletin's type as XCDR1, without encapsulation header.
  virtual void say(std::span<const std::byte> state) = 0;
};

/// Where to meet the others.
struct MeetingPlace {
  std::string type;                 ///< IDL name of what is said: "orca::idl::MachineState".
  std::string topic;                ///< The same on all machines.
  std::string address;              ///< Of this machine; empty: any.
  std::string interface {};         ///< Network interface of this machine; empty: any.
  std::vector<std::string> others;  ///< Addresses of other machines, which are asked besides a multicast.
  std::uint32_t domain = 0;         ///< Of DDS, the same on all machines.
  std::string keys{};  ///< Folder with the keys of this machine (orca/keys/key_folder.hpp); empty: plain.
};

/// Takes what anybody has said, this process too.
/// @thread  a thread of the bulletin.
using HearState = std::function<void(std::span<const std::byte> state)>;

/// Opens a bulletin over Fast DDS. It is the symbol of that name in the library orca_bulletin, which a process loads only if
/// it needs it.
/// @param hear   called until the bulletin is destroyed.
/// @param error  set if the bulletin cannot be opened: unavailable if the interface or the address is not there.
/// @return the bulletin, owned by the caller; null: an error.
/// @thread  the main thread.
extern "C" Bulletin* orca_open_bulletin(const MeetingPlace& place, HearState hear, Error& error);

}  // namespace orca::supervisor
