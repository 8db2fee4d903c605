// SPDX-License-Identifier: GPL-3.0-or-later
// What a strand needs of every link beside its bytes: something to wait for, and a clean start.
#include <catch2/catch.hpp>

#include <set>

#include "link_kits.hpp"

using namespace orca;
using namespace orca::test;

TEMPLATE_TEST_CASE("the descriptor is readable exactly while read() has something to say", "[hw][link]",
                   ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  const int descriptor = kit.link->descriptor();
  CHECK((descriptor >= 0) == TestType::kHasDescriptor);
  if (!TestType::kHasDescriptor) return;
  CHECK_FALSE(is_readable(descriptor, 10ms));
  must_write(*kit.device, bytes_of("ab"));
  CHECK(is_readable(descriptor, 5000ms));
  CHECK(read_bytes(*kit.link, 1).size() == 1);
  CHECK(is_readable(descriptor, 5000ms));
  CHECK(read_bytes(*kit.link, 1).size() == 1);
  CHECK_FALSE(is_readable(descriptor, 10ms));
  kit.device->close();
  CHECK(is_readable(descriptor, 5000ms));
}

TEMPLATE_TEST_CASE("what has arrived and is discarded is not read", "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  must_write(*kit.device, bytes_of("old"));
  if (TestType::kHasDescriptor) CHECK(is_readable(kit.link->descriptor(), 5000ms));
  kit.link->discard_input();
  CHECK(read_some(*kit.link).empty());
  must_write(*kit.device, bytes_of("new"));
  CHECK(text_of(read_bytes(*kit.link, 3)) == "new");
}

TEMPLATE_TEST_CASE("a link has a name for people and takes a rate and a level of DTR, which some have",
                   "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  CHECK_FALSE(kit.link->name().empty());
  CHECK(kit.link->set_line({38400}).ok());
  CHECK(kit.link->set_dtr(false).ok());
  const std::set<double> times{0.0, 10.0 / 38400,
                               10.0 / 115200};  // none, the link's own, the driver's at the far end
  CHECK(times.count(kit.link->byte_time()) == 1);
}
