// SPDX-License-Identifier: LGPL-3.0-or-later
#include "build_id.hpp"

#include <elf.h>

#include <algorithm>
#include <cstring>
#include <string_view>

namespace orca::plugin {
namespace {

constexpr std::string_view kOwner{"GNU\0", 4};  // of a note, with the zero at its end
constexpr std::size_t kMostIdBytes = 64;        // [bytes] that are shown; real ones have 8 to 32

std::uint64_t padded(std::uint64_t size, std::uint64_t align) {
  const std::uint64_t step = align == 8 ? 8 : 4;
  return (size + step - 1) / step * step;
}

std::string hexadecimal(std::span<const std::byte> bytes) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : bytes) {
    text += kDigits[std::to_integer<std::size_t>(byte >> 4)];
    text += kDigits[std::to_integer<std::size_t>(byte & std::byte{15})];
  }
  return text;
}

}  // namespace

std::string build_id_in(std::span<const std::byte> notes, std::uint64_t align) {
  Elf64_Nhdr head{};
  while (notes.size() >= sizeof head) {
    std::memcpy(&head, notes.data(), sizeof head);
    const std::uint64_t text_at = padded(sizeof head + std::uint64_t{head.n_namesz}, align);
    if (text_at > notes.size() || head.n_descsz > notes.size() - text_at) return {};
    const std::string_view owner(reinterpret_cast<const char*>(notes.data()) + sizeof head, head.n_namesz);
    if (head.n_type == NT_GNU_BUILD_ID && owner == kOwner)
      return hexadecimal(notes.subspan(text_at, std::min<std::size_t>(head.n_descsz, kMostIdBytes)));
    notes = notes.subspan(std::min<std::uint64_t>(padded(text_at + head.n_descsz, align), notes.size()));
  }
  return {};
}

}  // namespace orca::plugin
