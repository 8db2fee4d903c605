// SPDX-License-Identifier: LGPL-3.0-or-later
#include "telltale_bytes.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

namespace orca::plugin {
namespace {

constexpr std::size_t kBehind = 24;  // [bytes] where compilers use the result

// The beginning of a path is enough: a compiler may keep the rest apart, as the operand of an instruction.
struct Path {
  std::string_view name;
  std::string_view beginning;
  std::string_view like;
};
constexpr std::array<Path, 4> kPaths{{{"/dev/random", "/dev/ran", "getrandom"},
                                      {"/dev/urandom", "/dev/ura", "getrandom"},
                                      {"/dev/hwrng", "/dev/hwr", "getrandom"},
                                      {"/proc/", "/proc/", "getpid"}}};

#if defined(__x86_64__)
std::uint8_t at(std::string_view code, std::size_t place) {
  return place < code.size() ? static_cast<std::uint8_t>(code[place]) : 0;
}

// shl REGISTER, 32: the upper half of the clock, which comes in two registers.
bool is_shift_by_32(std::string_view code, std::size_t place) {
  const std::uint8_t prefix = at(code, place);
  return (prefix == 0x48 || prefix == 0x49) && at(code, place + 1) == 0xc1 &&
         (at(code, place + 2) & 0xf8) == 0xe0 && at(code, place + 3) == 32;
}

// cmovc, jc, setc and their opposites: the carry flag says whether there was a number.
bool jumps_or_moves_by_carry(std::string_view code, std::size_t place) {
  const std::uint8_t second = at(code, place + 1) & 0xfe;
  return at(code, place) == 0x0f && (second == 0x42 || second == 0x82 || second == 0x92);
}

// adc REGISTER, 0 and sbb REGISTER, 0: the flag as a number, added or subtracted.
bool adds_carry(std::string_view code, std::size_t place) {
  return at(code, place) == 0x83 && (at(code, place + 1) & 0xf0) == 0xd0 && place + 2 < code.size() &&
         at(code, place + 2) == 0;
}

bool asks_for_carry(std::string_view code, std::size_t place) {
  return jumps_or_moves_by_carry(code, place) || adds_carry(code, place);
}

template <class Follows>
bool is_followed(std::string_view code, std::size_t end, Follows follows) {
  for (std::size_t place = end; place < end + kBehind; ++place)
    if (follows(code, place)) return true;
  return false;
}

// Returns whether the bytes from a place on are the way back to a constant (%rip) or a function (call, jmp), as far as 16 MB.
bool is_way_back(std::string_view code, std::size_t place) {
  const auto is_relative = [&](std::size_t back) {
    const std::uint8_t before = place < back ? 0 : at(code, place - back);
    return (before & 0xc7) == 0x05 || before == 0xe8 || before == 0xe9;
  };
  // The byte is the first or the second of four, the last of which is the sign.
  return (is_relative(1) && at(code, place + 3) == 0xff) || (is_relative(2) && at(code, place + 2) == 0xff);
}

// Returns the instruction that begins at the byte 0x0f; empty: none of those.
std::string_view instruction_at(std::string_view code, std::size_t place) {
  const std::uint8_t second = at(code, place + 1);
  const std::uint8_t third = at(code, place + 2);
  if (is_way_back(code, place)) return "";
  if (second == 0x31) return is_followed(code, place + 2, is_shift_by_32) ? "rdtsc" : "";
  if (second == 0x01 && third == 0xf9) return is_followed(code, place + 3, is_shift_by_32) ? "rdtscp" : "";
  if (second == 0xc7 && third >= 0xf0 && is_followed(code, place + 3, asks_for_carry))
    return third < 0xf8 ? "rdrand" : "rdseed";
  return "";
}
#endif

std::string_view text(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

std::vector<std::string_view> telltale_instructions([[maybe_unused]] std::span<const std::byte> code) {
  std::vector<std::string_view> found;
#if defined(__x86_64__)
  const std::string_view all = text(code);
  for (std::size_t place = all.find('\x0f'); place != std::string_view::npos;
       place = all.find('\x0f', place + 1)) {
    const std::string_view name = instruction_at(all, place);
    if (!name.empty() && std::ranges::find(found, name) == found.end()) found.push_back(name);
  }
#endif
  return found;
}

std::vector<std::string_view> telltale_paths(std::span<const std::byte> bytes) {
  std::vector<std::string_view> found;
  for (const Path& path : kPaths)
    if (text(bytes).find(path.beginning) != std::string_view::npos) found.push_back(path.name);
  return found;
}

std::string_view function_like(std::string_view telltale) {
  for (const Path& path : kPaths)
    if (path.name == telltale) return path.like;
  return telltale.starts_with("rdtsc") ? "clock_gettime" : "getrandom";
}

}  // namespace orca::plugin
