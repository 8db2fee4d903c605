// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "comparison.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "peer.hpp"

namespace orca::bench {

using Scan = idl::LaserRangeReadings;

/// Sizes of a scan: its number of ranges.
constexpr std::size_t kSmall = 2;       // 16 B
constexpr std::size_t kLaser = 361;     // 3 KB: half a degree over a half circle
constexpr std::size_t kImage = 131072;  // 1 MB

/// Returns scans as a driver has just filled them, with the header still in the caches. The time to make them
/// is not measured.
std::vector<Loan<Scan>> make_scans(int count, std::size_t ranges);

/// Returns the time in which the bytes of a scan of kImage ranges are copied.
Nanoseconds copy_image(int times);

struct Publisher : test::Peer {
  explicit Publisher(Executive& executive, const std::string& name = "publisher") : Peer(executive, name) {}
  PushServer<Scan> out{*this, "out"};
};

struct Subscriber : test::Peer {
  explicit Subscriber(Executive& executive, const std::string& name = "subscriber") : Peer(executive, name) {}
  PushProxy<Scan> in{*this, "in"};
};

/// Connects the two and subscribes.
void subscribe(Publisher& publisher, Subscriber& subscriber, const QueuePolicy& policy = {});

}  // namespace orca::bench
