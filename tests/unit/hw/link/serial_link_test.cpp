// SPDX-License-Identifier: GPL-3.0-or-later
// A serial line: rates, settings, who has it, and adapters that go and come back. Pseudo terminals play the ports.
#include <catch2/catch.hpp>

#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "line_settings.hpp"
#include "serial_line.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::Line;
using hw::link::Parity;
using hw::link::PtyLink;
using hw::link::SerialLink;

namespace {

// What an interactive terminal is set to: it echoes, edits lines and obeys XOFF.
void make_interactive(int terminal) {
  termios2 settings{};
  REQUIRE(ioctl(terminal, TCGETS2, &settings) == 0);
  settings.c_lflag = ECHO | ICANON | ISIG;
  settings.c_iflag = IXON | ICRNL;
  settings.c_oflag = OPOST | ONLCR;
  settings.c_cflag = CS8 | CREAD | B19200;
  REQUIRE(ioctl(terminal, TCSETS2, &settings) == 0);
}

termios2 settings_of(int terminal) {
  termios2 settings{};
  REQUIRE(ioctl(terminal, TCGETS2, &settings) == 0);
  return settings;
}

// The device's side of a port, open, and a by-id folder.
struct Terminal {
  Terminal() { must_open(device); }
  // Returns the options for a serial link to it.
  [[nodiscard]] hw::link::SerialOptions options(std::uint32_t baud = 9600) const {
    return serial_at(folder, device.device(), baud);
  }
  const TempFolder folder;
  PtyLink device;
};

}  // namespace

TEST_CASE("a serial line has any rate, also one that no list of the system's has", "[hw][link][serial]") {
  Terminal terminal;
  for (const std::uint32_t baud : {9600U, 38400U, 500'000U, 123'456U}) {
    SerialLink link(terminal.options(baud));
    must_open(link);
    REQUIRE(terminal.device.line().has_value());
    CHECK(terminal.device.line()->baud == baud);
    CHECK(link.byte_time() == Approx(10.0 / baud));
    CHECK(terminal.device.byte_time() == Approx(10.0 / baud));
  }
}

TEST_CASE("the rate can be changed while the line is open, and is kept for the next time",
          "[hw][link][serial]") {
  Terminal terminal;
  SerialLink link(terminal.options(9600));
  must_open(link);
  REQUIRE(link.set_line({500'000}).ok());
  CHECK(terminal.device.line()->baud == 500'000);
  must_write(link, bytes_of("still works"));
  CHECK(text_of(read_bytes(terminal.device, 11)) == "still works");
  link.close();
  must_open(link);
  CHECK(terminal.device.line()->baud == 500'000);
}

TEST_CASE("a rate that no port has is refused, and the old one stays", "[hw][link][serial]") {
  Terminal terminal;
  SerialLink link(terminal.options(9600));
  must_open(link);
  for (const std::uint32_t baud : {0U, 49U, 4'000'001U}) {
    const Status set = link.set_line({baud});
    REQUIRE_FALSE(set.ok());
    CHECK(set.error().code == Code::invalid_argument);
    CHECK_THAT(set.error().text(), Contains(std::to_string(baud) + " baud") && Contains("50 to 4000000"));
  }
  CHECK(terminal.device.line()->baud == 9600);
  SerialLink never(terminal.options(0));
  link.close();
  CHECK(error_of_opening(never).code == Code::invalid_argument);
}

TEST_CASE("a parity bit makes a byte longer", "[hw][link][serial]") {
  CHECK(Line{9600, Parity::none}.byte_time() == Approx(1.0416667e-3));
  CHECK(Line{9600, Parity::even}.byte_time() == Approx(1.1458333e-3));
  Terminal terminal;
  SerialLink link({terminal.device.device(), {9600, Parity::even}, terminal.folder.file("serial")});
  must_open(link);  // Linux keeps no parity for pseudo terminals, and that is no error
  CHECK(link.byte_time() == Approx(11.0 / 9600));
}

TEST_CASE("an XOFF from the device does not stop what goes to it", "[hw][link][serial]") {
  Terminal terminal;
  make_interactive(terminal.device.descriptor());
  SerialLink link(terminal.options());
  must_open(link);
  must_write(terminal.device, {0x13});
  CHECK(read_bytes(link, 1) == Bytes{0x13});
  must_write(link, bytes_of("goes on"));
  CHECK(text_of(read_bytes(terminal.device, 7)) == "goes on");
}

TEST_CASE("the port is as it was when the link has closed it", "[hw][link][serial]") {
  Terminal terminal;
  make_interactive(terminal.device.descriptor());
  const termios2 before = settings_of(terminal.device.descriptor());
  SerialLink link(terminal.options(500'000));
  must_open(link);
  CHECK((settings_of(terminal.device.descriptor()).c_lflag & (ECHO | ICANON)) == 0U);
  link.close();
  const termios2 after = settings_of(terminal.device.descriptor());
  CHECK(after.c_lflag == before.c_lflag);
  CHECK(after.c_iflag == before.c_iflag);
  CHECK(after.c_oflag == before.c_oflag);
  CHECK(after.c_cflag == before.c_cflag);
  CHECK(after.c_ospeed == before.c_ospeed);
}

TEST_CASE("a port has one link at a time, and a program is told if the other one is its own",
          "[hw][link][serial]") {
  Terminal terminal;
  SerialLink first(terminal.options());
  must_open(first);
  SerialLink second(terminal.options(500'000));
  const Error refused = error_of_opening(second);
  CHECK(refused.code == Code::unavailable);
  CHECK_THAT(refused.message, Contains("in use by this program itself, for another device"));
  CHECK(terminal.device.line()->baud == 9600);  // the second attempt changed nothing
  must_write(first, bytes_of("mine"));
  CHECK(text_of(read_bytes(terminal.device, 4)) == "mine");
  first.close();
  must_open(second);
}

TEST_CASE("a port that another program has locked is refused with that program's number",
          "[hw][link][serial]") {
  Terminal terminal;
  int ready[2] = {-1, -1};
  int done[2] = {-1, -1};
  REQUIRE(pipe(ready) == 0);
  REQUIRE(pipe(done) == 0);
  const pid_t child = fork();
  if (child == 0) {
    char byte = 0;
    close(done[1]);
    const int number = ::open(terminal.device.device().c_str(), O_RDWR | O_NOCTTY);
    const bool locked = flock(number, LOCK_EX | LOCK_NB) == 0 && write(ready[1], "r", 1) == 1;
    _exit(locked && read(done[0], &byte, 1) == 0 ? 0 : 1);  // until the test closes the pipe, or dies
  }
  close(done[0]);
  char byte = 0;
  REQUIRE(read(ready[0], &byte, 1) == 1);
  SerialLink link(terminal.options());
  const Error refused = error_of_opening(link);
  CHECK(refused.code == Code::unavailable);
  CHECK_THAT(refused.message, Contains("(process " + std::to_string(child) + ")"));
  CHECK_THAT(refused.message, !Contains("(process " + std::to_string(getpid()) + ")"));
  close(done[1]);
  int status = -1;
  CHECK(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
  must_open(link);
  close(ready[0]);
  close(ready[1]);
}

TEST_CASE("other programs cannot open the port while a link has it, unless they are root's",
          "[hw][link][serial]") {
  Terminal terminal;
  SerialLink link(terminal.options());
  must_open(link);
  const Descriptor other = open_plainly(terminal.device.device());
  int exclusive = -1;
  if (!other) {
    CHECK(errno == EBUSY);
  } else {
    CHECK(geteuid() == 0);
    CHECK(ioctl(other.number(), TIOCGEXCL, &exclusive) == 0);
    CHECK(exclusive == 1);
    CHECK(flock(other.number(), LOCK_EX | LOCK_NB) != 0);
  }
  link.close();
  const Descriptor later = open_plainly(terminal.device.device());
  REQUIRE(later);
  CHECK(ioctl(later.number(), TIOCGEXCL, &exclusive) == 0);
  CHECK(exclusive == 0);
}

TEST_CASE("closing waits for the last words at the line's rate, but not for a device that is stuck",
          "[hw][link][serial]") {
  Terminal terminal;
  SerialLink link(terminal.options(9600));
  const auto time_to_close = [&] {
    const auto begin = std::chrono::steady_clock::now();
    link.close();
    return std::chrono::steady_clock::now() - begin;
  };
  CHECK(soon([&] {  // a busy machine may take longer now and then
    must_open(link);
    return time_to_close() < 20ms;
  }));
  must_open(link);
  must_write(link, Bytes(24, 0x55));
  CHECK(time_to_close() > 20ms);  // 24 bytes of 10 bits take 25 ms at 9600 baud
  must_open(link);
  while (link.write(Bytes(64, 0x55)).ok()) continue;
  CHECK(link.pending() > 0);
  const auto stuck = time_to_close();
  CHECK(stuck >= 50ms);
  CHECK(stuck < 5s);
}

TEST_CASE("a line that is held back is told after half a second, and what waited does not go out later",
          "[hw][link][serial]") {
  Terminal terminal;
  const Descriptor port = open_plainly(terminal.device.device());
  SerialLink link(terminal.options());
  must_open(link);
  must_write(link, bytes_of("before "));
  CHECK(text_of(read_bytes(terminal.device, 7)) == "before ");
  REQUIRE(ioctl(port.number(), TCXONC, TCOOFF) == 0);
  must_write(link, bytes_of("late"));
  CHECK(read_some(link).empty());
  std::optional<Error> told;
  REQUIRE(soon([&] {
    const Result<std::size_t> count = link.read(std::span<std::uint8_t>{});
    if (!count) told = count.error();
    return told.has_value();
  }));
  CHECK(told->code == Code::deadline_exceeded);
  CHECK_THAT(told->message, Contains("takes nothing any more, 4 bytes wait; is the line held back"));
  CHECK(link.write(bytes_of("refused")).error().code == Code::deadline_exceeded);
  link.close();
  REQUIRE(ioctl(port.number(), TCXONC, TCOON) == 0);
  must_open(link);
  must_write(link, bytes_of("after"));
  CHECK(text_of(read_bytes(terminal.device, 5)) == "after");
}

TEST_CASE("a line that is slow, but takes what it gets, is not told as held back", "[hw][link][serial]") {
  Terminal terminal;
  const Descriptor port = open_plainly(terminal.device.device());
  SerialLink link(terminal.options());
  must_open(link);
  const TimePoint end = steady_now() + 1500ms;
  while (steady_now() < end) {  // now and then some bytes go, and never all
    must_write(link, Bytes(8, 0x55));
    REQUIRE(ioctl(port.number(), TCXONC, TCOOFF) == 0);
    must_write(link, Bytes(8, 0x55));
    std::this_thread::sleep_for(200ms);
    REQUIRE(ioctl(port.number(), TCXONC, TCOON) == 0);
    REQUIRE(link.flush().ok());
    (void)read_some(terminal.device);
  }
  CHECK(link.pending() == 0);
}

TEST_CASE("an adapter that is unplugged is told as gone, and found again where it comes back",
          "[hw][link][serial]") {
  const TempFolder folder;
  const std::string number = folder.file("ttyUSB0");  // what the system calls whoever comes first
  FakeAdapter adapter(folder, "usb-Orca_Scout_0001");
  adapter.plug_in();
  std::filesystem::create_symlink(adapter.device().device(), number);
  SerialLink link(serial_at(folder, number));
  must_open(link);
  CHECK(link.path() == adapter.device().device());
  adapter.unplug();
  std::filesystem::remove(number);
  CHECK(error_of_reading(link) == Code::unavailable);
  link.close();
  CHECK(link.path().empty());
  CHECK(error_of_opening(link).code == Code::not_found);
  CHECK_THAT(error_of_opening(link).message, Contains("Is the adapter plugged in?"));

  FakeAdapter stranger(folder, "usb-Other_0002");  // takes the number that has become free
  stranger.plug_in();
  std::filesystem::create_symlink(stranger.device().device(), number);
  const Error taken = error_of_opening(link);
  CHECK(taken.code == Code::not_found);
  CHECK_THAT(taken.message, Contains(number + " is another device now") && Contains("usb-Orca_Scout_0001"));

  adapter.plug_in();
  must_open(link);
  CHECK(link.path() == adapter.device().device());
  must_write(link, bytes_of("found"));
  CHECK(text_of(read_bytes(adapter.device(), 5)) == "found");
}

TEST_CASE("an adapter can be named by its name in by-id or by its place in by-path", "[hw][link][serial]") {
  const TempFolder folder;
  FakeAdapter adapter(folder, "usb-Orca_Laser_0002");
  adapter.plug_in();
  std::filesystem::create_directories(folder.path() / "serial" / "by-path");
  std::filesystem::create_symlink(adapter.device().device(),
                                  folder.path() / "serial" / "by-path" / "pci-0000:00:14.0-usb-0:1:1.0");
  for (const std::string& name :
       {std::string("usb-Orca_Laser_0002"), std::string("pci-0000:00:14.0-usb-0:1:1.0"), adapter.id_path()}) {
    SerialLink link(serial_at(folder, name));
    must_open(link);
    CHECK(link.path() == adapter.device().device());
  }
}

TEST_CASE("who names a socket by its path means what is plugged in there now", "[hw][link][serial]") {
  const TempFolder folder;
  const std::filesystem::path socket = folder.path() / "serial" / "by-path" / "usb-0:1";
  std::filesystem::create_directories(socket.parent_path());
  SerialLink link(serial_at(folder, socket.string()));
  for (const std::string& id : {std::string("usb-Old_0001"), std::string("usb-New_0002")}) {
    FakeAdapter adapter(folder, id);
    adapter.plug_in();
    std::filesystem::create_symlink(adapter.device().device(), socket);
    must_open(link);
    must_write(link, bytes_of("hello"));
    CHECK(text_of(read_bytes(adapter.device(), 5)) == "hello");
    link.close();
    std::filesystem::remove(socket);
  }
}

TEST_CASE("a copy of the process does not keep a port that was closed", "[hw][link][serial]") {
  Terminal terminal;
  SerialLink link(terminal.options());
  must_open(link);
  int done[2] = {-1, -1};
  REQUIRE(pipe(done) == 0);
  const pid_t copy = fork();
  if (copy == 0) {
    char byte = 0;
    close(done[1]);
    _exit(read(done[0], &byte, 1) == 0 ? 0 : 1);  // until the test closes the pipe, or dies
  }
  close(done[0]);
  link.close();
  must_open(link);
  close(done[1]);
  int status = -1;
  CHECK(waitpid(copy, &status, 0) == copy);
  CHECK(status == 0);
}

TEST_CASE("what a device sent before the link was opened is not read", "[hw][link][serial]") {
  Terminal terminal;
  must_write(terminal.device, bytes_of("boot message"));
  SerialLink link(terminal.options());
  must_open(link);
  must_write(terminal.device, bytes_of("reply"));
  CHECK(text_of(read_bytes(link, 5)) == "reply");
}
