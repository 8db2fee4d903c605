// SPDX-License-Identifier: GPL-3.0-or-later
#include "inspection/telltale_bytes.hpp"

#include <catch2/catch.hpp>

#include <cstddef>
#include <initializer_list>
#include <string>

using namespace orca::plugin;
using Found = std::vector<std::string_view>;

namespace {

std::vector<std::byte> bytes(const std::string& text) {
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

const std::string kNothing(8, '\x90');
const std::string kShift("\x48\xc1\xe2\x20", 4);      // shl rdx, 32
const std::string kSetCarry("\x0f\x92\xc0", 3);       // setc al
const std::string kAddCarry("\x48\x83\xd0\x00", 4);   // adc rax, 0
const std::string kSubtractCarry("\x83\xdf\x00", 3);  // sbb edi, 0

}  // namespace

#if defined(__x86_64__)
TEST_CASE("an instruction that reads a clock or draws a number is found with what compilers put behind it",
          "[plugin][virtual]") {
  const auto found = [](const std::string& code) { return telltale_instructions(bytes(code)); };
  const std::string clock("\x0f\x31", 2);
  const std::string clock_in_order("\x0f\x01\xf9", 3);
  const std::string number("\x48\x0f\xc7\xf0", 4);
  const std::string seed("\x0f\xc7\xf9", 3);
  CHECK(found(kNothing + clock + kNothing + kShift) == Found{"rdtsc"});
  CHECK(found(clock_in_order + kShift) == Found{"rdtscp"});
  CHECK(found(number + kNothing + kSetCarry) == Found{"rdrand"});
  CHECK(found(seed + kSetCarry) == Found{"rdseed"});
  CHECK(found(seed + kAddCarry) == Found{"rdseed"});
  CHECK(found(number + kNothing + kSubtractCarry) == Found{"rdrand"});
  CHECK(found(clock + kShift + seed + kSetCarry + clock + kShift) == Found{"rdtsc", "rdseed"});
}

TEST_CASE("bytes that look like such an instruction by chance are not taken for it", "[plugin][virtual]") {
  const auto found = [](const std::string& code) { return telltale_instructions(bytes(code)); };
  const std::string clock("\x0f\x31", 2);
  CHECK(found("").empty());
  CHECK(found(clock).empty());
  CHECK(found(clock + kNothing + kNothing + kNothing + kNothing + kShift).empty());
  CHECK(found(clock + std::string("\x48\xc1\xe2\x21", 4)).empty());  // a shift by 33
  CHECK(found(std::string("\x0f\xc7\x08", 3) + kSetCarry).empty());  // cmpxchg8b
  const std::string seed("\x0f\xc7\xf9", 3);
  CHECK(found(seed + std::string("\x83\xd0\x01", 3)).empty());    // adc eax, 1
  CHECK(found(seed + std::string("\x83\xc0\x00", 3)).empty());    // add eax, 0
  CHECK(found(seed + std::string("\x83\xd0", 2)).empty());        // cut off
  CHECK(found(std::string("\x0f\x01\xf8", 3) + kShift).empty());  // swapgs
  // The way back to a constant or a function.
  CHECK(found(std::string("\xf2\x0f\x10\x3d\x0f\xc7\xfe\xff", 8) + kSetCarry).empty());
  CHECK(found(std::string("\xe8\x0f\xc7\xfe\xff", 5) + kSetCarry).empty());
  CHECK(found(std::string("\x0d\x79\x0f\xc7\xff", 5) + kSetCarry).empty());  // 3.7 MB back
  CHECK(found(std::string("\x48\x8d\x05\x0f\x31\xfe\xff", 7) + kShift).empty());
}
#endif

TEST_CASE("a path is found by its beginning, wherever it stands", "[plugin][virtual]") {
  CHECK(telltale_paths(bytes("a/dev/urandom")) == Found{"/dev/urandom"});
  CHECK(telltale_paths(bytes("/dev/ra|/dev/ura|/proc/self")) == Found{"/dev/urandom", "/proc/"});
  CHECK(telltale_paths(bytes("/dev/random /dev/hwrng")) == Found{"/dev/random", "/dev/hwrng"});
  CHECK(telltale_paths(bytes("/dev/ttyS0 /processes /dev/")).empty());
}

TEST_CASE("a telltale is judged like the function that does the same", "[plugin][virtual]") {
  CHECK(function_like("rdtsc") == "clock_gettime");
  CHECK(function_like("rdtscp") == "clock_gettime");
  CHECK(function_like("rdrand") == "getrandom");
  CHECK(function_like("/dev/urandom") == "getrandom");
  CHECK(function_like("/proc/") == "getpid");
}
