// SPDX-License-Identifier: GPL-3.0-or-later
// A link from a text, as it stands in a graph.
#include <catch2/catch.hpp>

#include <filesystem>

#include "link_talk.hpp"
#include "orca/hw/link/make_link.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::make_link;

TEST_CASE("a link is made from its text, and its name leads to the same link again", "[hw][link][text]") {
  const std::vector<std::pair<std::string, std::string>> texts{
      {"/dev/ttyUSB0", "serial:/dev/ttyUSB0"},
      {"/dev/serial/by-path/pci-0000:00:14.0-usb-0:1:1.0-port0",
       "serial:/dev/serial/by-path/pci-0000:00:14.0-usb-0:1:1.0-port0"},
      {"serial:/dev/ttyUSB0", "serial:/dev/ttyUSB0"},
      {"serial:usb-FTDI_FT232R-if00", "serial:usb-FTDI_FT232R-if00"},
      {"tcp:scout.local:4000", "tcp:scout.local:4000"},
      {"tcp:127.0.0.1:65535", "tcp:127.0.0.1:65535"},
      {"tcp:[::1]:1", "tcp:[::1]:1"},
      {"pty:/tmp/scout", "pty:/tmp/scout"},
      {"listen:6665", "listen:127.0.0.1:6665"},
      {"listen:0.0.0.0:6665", "listen:0.0.0.0:6665"},
      {"listen:[::1]:6665", "listen:[::1]:6665"},
      {"replay:run7.bytes", "replay:run7.bytes"}};
  for (const auto& [text, name] : texts) {
    const auto link = make_link(text);
    if (!link) FAIL(link.error().text());
    CHECK((*link)->name() == name);
    CHECK((*link)->descriptor() == -1);  // nothing is open
    CHECK((*make_link(name))->name() == name);
  }
}

TEST_CASE("a serial link has the line that its options say", "[hw][link][text]") {
  hw::link::LinkOptions options;
  options.line = {38400};
  CHECK((*make_link("/dev/ttyUSB0", options))->byte_time() == Approx(10.0 / 38400));
}

TEST_CASE("a recording runs on the clock of the options", "[hw][link][text]") {
  const TempFolder folder;
  folder.write("log", "# orca byte log 1\n0.000000 open\n1.000000 in 0a\n");
  TimePoint time{};
  hw::link::LinkOptions options;
  options.now = [&] { return time; };
  const auto link = make_link("replay:" + folder.file("log"), options);
  must_open(**link);
  CHECK(read_some(**link).empty());
  time += 1s;
  CHECK(read_some(**link) == Bytes{0x0A});
}

TEST_CASE("a text that is no link is refused with what is wrong and how one is written", "[hw][link][text]") {
  const std::vector<std::pair<std::string, std::string>> wrong{{"", "names no kind of link"},
                                                               {"ttyUSB0", "names no kind of link"},
                                                               {"tpc:host:1", "there is no kind \"tpc\""},
                                                               {":x", "there is no kind \"\""},
                                                               {"serial:", "nothing follows serial:"},
                                                               {"replay:", "nothing follows replay:"},
                                                               {"emulated:tcp:", "\"\" is no port"},
                                                               {"listen:", "nothing follows listen:"},
                                                               {"listen:x", "\"x\" is no port"},
                                                               {"listen::1", "needs a port, or an address"},
                                                               {"tcp:host", "needs a host and a port"},
                                                               {"tcp::4000", "needs a host and a port"},
                                                               {"tcp:::1:4000", "IPv6 address in brackets"},
                                                               {"tcp:[::1]", "needs a host and a port"},
                                                               {"tcp:[host]:1", "needs a host and a port"},
                                                               {"tcp:host:", "\"\" is no port"},
                                                               {"tcp:host:0", "\"0\" is no port"},
                                                               {"tcp:host:65536", "\"65536\" is no port"},
                                                               {"tcp:host:-1", "\"-1\" is no port"},
                                                               {"tcp:host:80x", "\"80x\" is no port"},
                                                               {"/dev/tty\nUSB0", "line break"},
                                                               {std::string("/dev/a\0b", 8), "zero"}};
  for (const auto& [text, reason] : wrong) {
    const auto link = make_link(text);
    if (link) FAIL("it is taken: " << text);
    CHECK(link.error().code == Code::invalid_argument);
    CHECK_THAT(link.error().message, Contains(reason) && Contains("a link is serial:/dev/ttyUSB0"));
  }
}

TEST_CASE("two names of one serial device have one real place", "[hw][link][text]") {
  const TempFolder folder;
  const std::string device = folder.write("ttyUSB0", "");
  const std::string lasting = folder.file("usb-FTDI-if00");
  std::filesystem::create_symlink(device, lasting);
  CHECK(hw::link::real_place(lasting) == hw::link::real_place("serial:" + device));
  CHECK(hw::link::real_place(folder.file("nobody")) == folder.file("nobody"));
  CHECK(hw::link::real_place("emulated:pioneer") == "emulated:pioneer");
}
