// SPDX-License-Identifier: GPL-3.0-or-later
// The line DTR, which a pseudo terminal does not have: this program puts itself between the link and the system.
#include <catch2/catch.hpp>

#include <sys/ioctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstdarg>
#include <string>

#include "line_settings.hpp"
#include "orca/hw/link/byte_log.hpp"
#include "orca/hw/link/faulty_link.hpp"
#include "orca/hw/link/logged_link.hpp"
#include "serial_line.hpp"

using namespace orca;
using namespace orca::test;
using hw::link::PtyLink;
using hw::link::SerialLink;

namespace {

// What the port of this test does.
struct ModemLines {
  bool raised = false;
  std::string changes;  // + for each time that DTR was raised, - for lowered
  int refusal = 0;      // errno; 0: it has the line
};
ModemLines modem;

// Returns whether the call was one to change DTR.
bool change_dtr(unsigned long request, const void* argument) {
  const bool raises = request == TIOCMBIS;
  if ((!raises && request != TIOCMBIC) || (*static_cast<const int*>(argument) & TIOCM_DTR) == 0) return false;
  if (modem.refusal == 0) {
    modem.raised = raises;
    modem.changes += raises ? '+' : '-';
  }
  return true;
}

tcflag_t hangs_up(const PtyLink& device) {
  termios2 settings{};
  REQUIRE(ioctl(device.descriptor(), TCGETS2, &settings) == 0);
  return settings.c_cflag & HUPCL;
}

void hang_up_when_closed(const PtyLink& device) {
  termios2 settings{};
  REQUIRE(ioctl(device.descriptor(), TCGETS2, &settings) == 0);
  settings.c_cflag |= HUPCL;
  REQUIRE(ioctl(device.descriptor(), TCSETS2, &settings) == 0);
}

struct Port {
  Port() {
    modem = {};
    must_open(device);
    hang_up_when_closed(device);
  }
  [[nodiscard]] std::unique_ptr<SerialLink> link() const {
    return std::make_unique<SerialLink>(serial_at(folder, device.device()));
  }
  TempFolder folder;
  PtyLink device;
};

}  // namespace

// Takes the place of the system library's.
extern "C" int ioctl(int descriptor, unsigned long request, ...) noexcept {
  va_list more;
  va_start(more, request);
  void* const argument = va_arg(more, void*);
  va_end(more);
  if (!change_dtr(request, argument))
    return static_cast<int>(syscall(SYS_ioctl, descriptor, request, argument));
  errno = modem.refusal;
  return modem.refusal == 0 ? 0 : -1;
}

TEST_CASE("an open serial line raises DTR by itself, and the system may lower it when it is closed",
          "[hw][link][serial]") {
  Port port;
  const auto link = port.link();
  must_open(*link);
  CHECK(modem.changes == "+");
  link->close();
  CHECK(hangs_up(port.device) != 0U);
}

TEST_CASE("DTR can be lowered and raised while the line is open", "[hw][link][serial]") {
  Port port;
  const auto link = port.link();
  must_open(*link);
  REQUIRE(link->set_dtr(false).ok());
  CHECK_FALSE(modem.raised);
  REQUIRE(link->set_dtr(true).ok());
  CHECK(modem.raised);
  CHECK(modem.changes == "+-+");
}

TEST_CASE("a level of DTR that was set before holds from each opening on", "[hw][link][serial]") {
  Port port;
  const auto link = port.link();
  REQUIRE(link->set_dtr(false).ok());
  CHECK(modem.changes.empty());
  for (int times = 0; times < 2; ++times) {
    must_open(*link);
    CHECK_FALSE(modem.raised);
    link->close();
  }
  CHECK(modem.changes == "+-+-");
}

TEST_CASE("a level of DTR that was set outlives the link: the motor that it stops stays off",
          "[hw][link][serial]") {
  Port port;
  const auto link = port.link();
  must_open(*link);
  REQUIRE(link->set_dtr(true).ok());
  link->close();
  CHECK(modem.raised);
  CHECK(hangs_up(port.device) == 0U);
}

TEST_CASE("a port without DTR is none the worse, and one that has gone says so", "[hw][link][serial]") {
  Port port;
  modem.refusal = ENOTTY;
  const auto link = port.link();
  REQUIRE(link->set_dtr(false).ok());
  must_open(*link);
  CHECK(link->set_dtr(true).ok());
  modem.refusal = EIO;
  const Status gone = link->set_dtr(false);
  REQUIRE_FALSE(gone.ok());
  CHECK(gone.error().code == Code::unavailable);
}

TEST_CASE("DTR is reached through a link that logs and one with faults, and the log tells of it",
          "[hw][link][serial]") {
  Port port;
  const std::string file = port.folder.file("bytes");
  {
    hw::link::FaultPlan plan;
    plan.now = steady_now;
    auto log = hw::link::ByteLog::create({.path = file, .now = steady_now}, "port");
    REQUIRE(log);
    hw::link::LoggedLink link(std::make_unique<hw::link::FaultyLink>(port.link(), plan), std::move(*log));
    must_open(link);
    REQUIRE(link.set_dtr(false).ok());
    CHECK_FALSE(modem.raised);
    REQUIRE(link.set_dtr(true).ok());
    CHECK(modem.raised);
  }
  CHECK_THAT(read_text(file), Catch::Contains("DTR lowered") && Catch::Contains("DTR raised"));
}
