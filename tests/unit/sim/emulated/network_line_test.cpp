// SPDX-License-Identifier: GPL-3.0-or-later
// An emulated device at a TCP port, and programs that connect to it.
#include <catch2/catch.hpp>

#include <array>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "network_line.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/hw/link/make_link.hpp"

using namespace orca;
using namespace orca::sim;
using namespace std::chrono_literals;

namespace {

using Bytes = std::vector<std::uint8_t>;

// What a Parrot has been told, by all its hosts.
struct Diary {
  std::uint32_t baud = 1;
  int hosts = 0;   // that are there now
  int others = 0;  // that for_another_host() has made
};

// Says what it hears. It floods who asks it to with 'F'.
class Parrot final : public emulators::Firmware {
 public:
  Parrot(Diary& diary, bool shares) : diary_(diary), shares_(shares) {}

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint) override {
    diary_.baud = baud;
    answer_.insert(answer_.end(), bytes.begin(), bytes.end());
    floods_ = floods_ || bytes[0] == 'F';
  }
  Bytes advance(TimePoint) override {
    if (floods_) answer_.resize(answer_.size() + 50'000);
    return std::exchange(answer_, {});
  }
  void note_host(bool is_there, TimePoint) override {
    if (is_there != has_host_) diary_.hosts += is_there ? 1 : -1;
    has_host_ = is_there;
    floods_ = floods_ && is_there;
  }
  std::unique_ptr<Firmware> for_another_host() override {
    if (!shares_) return nullptr;
    ++diary_.others;
    return std::make_unique<Parrot>(diary_, false);
  }
  void reset(TimePoint) override {}

 private:
  Diary& diary_;
  const bool shares_;
  bool has_host_ = false;
  bool floods_ = false;
  Bytes answer_;
};

/// A Parrot at a port that the system has chosen.
struct Perch {
  explicit Perch(bool shares) : line("127.0.0.1", 0, std::make_unique<Parrot>(diary, shares)) {
    REQUIRE(line.open().ok());
  }
  // Lets the device go on until something holds, at most 5 s.
  template <class Condition>
  bool until(const Condition& condition) {
    for (int i = 0; i < 5000; ++i, std::this_thread::sleep_for(1ms)) {
      has_host = line.exchange(steady_now());
      if (condition()) return true;
    }
    return false;
  }
  std::unique_ptr<hw::link::ByteLink> program() {
    auto link = hw::link::make_link(line.name());
    REQUIRE(link);
    REQUIRE(open_within(**link, 5s).ok());
    return std::move(*link);
  }
  // Returns whether the device says the text, once it has been told.
  bool repeats(hw::link::ByteLink& program, const std::string& text) {
    REQUIRE(program.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}).ok());
    std::string heard;
    return until([&] {
      std::array<std::uint8_t, 64> bytes{};
      const auto count = program.read(bytes);
      heard.append(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(count ? *count : 0));
      return heard == text;
    });
  }

  Diary diary;
  NetworkLine line;
  bool has_host = false;
};

}  // namespace

TEST_CASE("a program finds an emulated device at its TCP port, which has no rate", "[emulated]") {
  Perch perch(false);
  CHECK_FALSE(perch.line.exchange(steady_now()));
  const auto program = perch.program();
  CHECK(perch.repeats(*program, "hello"));
  CHECK(perch.has_host);
  CHECK(perch.diary.baud == 0);
  CHECK(perch.diary.hosts == 1);
}

TEST_CASE("an emulated device notices that a program has gone, and serves the next one", "[emulated]") {
  Perch perch(false);
  for (int i = 0; i < 3; ++i) {
    const auto program = perch.program();
    CHECK(perch.repeats(*program, "one"));
    program->close();
    CHECK(perch.until([&] { return perch.diary.hosts == 0 && !perch.has_host; }));
  }
}

TEST_CASE("of an emulated device with one host at a time, the second program has to wait", "[emulated]") {
  Perch perch(false);
  const auto first = perch.program();
  CHECK(perch.repeats(*first, "first"));
  const auto second = perch.program();
  CHECK(perch.repeats(*first, "again"));
  CHECK(perch.diary.hosts == 1);
  first->close();
  CHECK(perch.repeats(*second, "second"));
}

TEST_CASE("an emulated device that can have several hosts serves 16 at once, and the next one waits",
          "[emulated]") {
  Perch perch(true);
  std::vector<std::unique_ptr<hw::link::ByteLink>> programs;
  for (int i = 0; i < 16; ++i) {
    programs.push_back(perch.program());
    REQUIRE(perch.repeats(*programs.back(), std::to_string(i)));
  }
  CHECK(perch.diary.others == 15);
  const auto late = perch.program();
  for (std::size_t i = 0; i < 16; ++i) CHECK(perch.repeats(*programs[i], "still " + std::to_string(i)));
  CHECK(perch.diary.hosts == 16);
  programs[7]->close();
  CHECK(perch.repeats(*late, "at last"));
  CHECK(perch.diary.others == 15);
}

TEST_CASE("a program that does not read is disconnected, and delays no other", "[emulated]") {
  Perch perch(true);
  const auto lazy = perch.program();
  const auto good = perch.program();
  REQUIRE(perch.repeats(*good, "good"));
  REQUIRE(lazy->write(std::array<std::uint8_t, 1>{'F'}).ok());
  CHECK(perch.until([&] { return perch.diary.hosts == 1; }));
  CHECK(perch.repeats(*good, "still here"));
}

TEST_CASE("two emulated devices cannot have one TCP port, and the first one keeps it", "[emulated]") {
  Perch perch(false);
  Diary diary;
  const std::string name = perch.line.name();
  const auto port = static_cast<std::uint16_t>(std::stoi(name.substr(name.rfind(':') + 1)));
  NetworkLine second("127.0.0.1", port, std::make_unique<Parrot>(diary, false));
  const Status refused = second.open();
  REQUIRE_FALSE(refused.ok());
  CHECK(refused.error().code == Code::already_exists);
  const auto program = perch.program();
  CHECK(perch.repeats(*program, "first"));
  perch.line.close();
  CHECK(second.open().ok());
}
