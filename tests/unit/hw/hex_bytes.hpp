// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "orca/hw/framing/scanner.hpp"

/// Bytes of serial protocols in tests, written as in the protocols' pages.
namespace orca::hw::test {

using Bytes = std::vector<std::uint8_t>;

/// Returns the bytes of e.g. "FA FB 03".
[[nodiscard]] inline Bytes hex(const std::string& text) {
  Bytes bytes;
  std::istringstream in(text);
  for (unsigned value = 0; in >> std::hex >> value;) bytes.push_back(static_cast<std::uint8_t>(value));
  return bytes;
}

/// Returns what hex() reads.
[[nodiscard]] inline std::string text_of(std::span<const std::uint8_t> bytes) {
  constexpr char kDigits[] = "0123456789ABCDEF";
  std::string text;
  for (const std::uint8_t byte : bytes) {
    if (!text.empty()) text += ' ';
    text += kDigits[byte / 16];
    text += kDigits[byte % 16];
  }
  return text;
}

[[nodiscard]] inline Bytes joined(std::initializer_list<Bytes> parts) {
  Bytes all;
  for (const Bytes& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

/// The frames that a scanner finds, as texts.
class FrameList {
 public:
  explicit FrameList(const framing::Protocol& protocol) : scanner_(protocol) {}
  void hear(const Bytes& bytes) { scanner_.feed(bytes, note_); }
  void give_up() { scanner_.give_up(note_); }
  [[nodiscard]] const std::vector<std::string>& frames() const { return frames_; }
  [[nodiscard]] const framing::Statistics& statistics() const { return scanner_.statistics(); }

 private:
  framing::Scanner scanner_;
  std::vector<std::string> frames_;
  const std::function<void(const framing::Frame&)> note_ = [this](const framing::Frame& frame) {
    frames_.push_back(text_of(frame.bytes));
  };
};

/// Returns the frames in those bytes, which arrive at once.
[[nodiscard]] inline std::vector<std::string> frames_in(const framing::Protocol& protocol,
                                                        const Bytes& bytes) {
  FrameList list(protocol);
  list.hear(bytes);
  return list.frames();
}

}  // namespace orca::hw::test
