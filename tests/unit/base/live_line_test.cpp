// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/live_line.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <array>
#include <string>
#include <vector>

#include "orca/base/log.hpp"

using namespace orca;

namespace {

// A pipe in place of a terminal.
class Output {
 public:
  Output() { REQUIRE(pipe2(ends_.data(), O_CLOEXEC | O_NONBLOCK) == 0); }
  ~Output() {
    LiveLine::erase();
    for (const int end : ends_) close(end);
  }

  [[nodiscard]] int terminal() const { return ends_[1]; }
  // Returns what has been written since the last call.
  [[nodiscard]] std::string news() const {
    std::array<char, 65536> bytes{};
    const ssize_t count = read(ends_[0], bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(std::max<ssize_t>(count, 0))};
  }
  // Fills it until it takes no more, as a terminal does after Ctrl-S.
  void stop() const {
    const std::array<char, 4096> bytes{};
    while (write(ends_[1], bytes.data(), bytes.size()) > 0) continue;
  }

 private:
  std::array<int, 2> ends_{};
};

}  // namespace

TEST_CASE("a live line replaces itself and can be erased, once", "[base][live_line]") {
  const Output output;
  LiveLine::show(output.terminal(), "1 s");
  CHECK(output.news() == "\r1 s\x1b[K");
  LiveLine::show(output.terminal(), "2 s");
  CHECK(output.news() == "\r2 s\x1b[K");
  LiveLine::erase();
  CHECK(output.news() == "\r\x1b[K");
  LiveLine::erase();
  CHECK(output.news().empty());
}

TEST_CASE("a live line is not there while anybody else writes", "[base][live_line]") {
  const Output output;
  LiveLine::show(output.terminal(), "1 s");
  (void)output.news();
  {
    const LiveLine::Pause one;
    CHECK(output.news() == "\r\x1b[K");
    {
      const LiveLine::Pause other;
      LiveLine::show(output.terminal(), "2 s");
    }
    LiveLine::show(output.terminal(), "3 s");
    CHECK(output.news().empty());
  }
  LiveLine::show(output.terminal(), "4 s");
  CHECK(output.news() == "\r4 s\x1b[K");
}

TEST_CASE("a line of the log erases a live line first", "[base][live_line]") {
  const Output output;
  LiveLine::show(output.terminal(), "1 s");
  (void)output.news();
  log::info("test", "a line of the log");
  CHECK(output.news() == "\r\x1b[K");
}

TEST_CASE("a terminal that takes no output makes nobody wait", "[base][live_line]") {
  const Output output;
  output.stop();
  LiveLine::show(output.terminal(), "1 s");
  CHECK(output.news().find("1 s") == std::string::npos);
}

TEST_CASE("somebody else hears when the first pause begins and when the last one ends", "[base][live_line]") {
  std::vector<bool> heard;
  LiveLine::on_pause([&](bool begins) { heard.push_back(begins); });
  {
    const LiveLine::Pause outer;
    const LiveLine::Pause inner;
  }
  CHECK(heard == std::vector<bool>{true, false});
  LiveLine::on_pause(nullptr);
  { const LiveLine::Pause unheard; }
  CHECK(heard.size() == 2);
}
