// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/network_address.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using Catch::Contains;

TEST_CASE("the interface decides which address is a machine's own, then its address", "[base][network]") {
  CHECK(own_address("lo", "10.1.2.3").value() == "127.0.0.1");
  CHECK(own_address("", "127.0.0.1").value() == "127.0.0.1");
  CHECK(own_address("", "").value().empty());
}

TEST_CASE("an interface or host that is not there is an error that names it", "[base][network]") {
  CHECK(own_address("wlan77", "").error().code == Code::unavailable);
  CHECK_THAT(own_address("wlan77", "").error().message, Contains("\"wlan77\""));
  CHECK(own_address("", "192.0.2.1").error().message ==
        "there is no network interface with the address 192.0.2.1");
  CHECK_THAT(address_of_host("no such host").error().message, Contains("\"no such host\""));
}
