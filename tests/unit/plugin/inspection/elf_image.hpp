// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <elf.h>

#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "../places.hpp"
#include "inspection/plugin_file.hpp"
#include "temp_folder.hpp"

namespace orca::test {

/// Libraries that were made for the tests of ElfFile.
inline const std::string kSamples = kForTests + "/bad/samples";
inline std::string sample(const std::string& name) { return kSamples + "/" + name + ".so"; }

/// The bytes of a shared library, to be changed in its tables and parsed.
class ElfImage {
 public:
  explicit ElfImage(const std::string& path) {
    const std::string text = read_text(path);
    if (text.size() < sizeof(Elf64_Ehdr)) throw std::runtime_error("no library: " + path);
    bytes_.resize(text.size());
    std::memcpy(bytes_.data(), text.data(), text.size());
  }

  Elf64_Ehdr& header() { return at<Elf64_Ehdr>(0); }
  std::span<Elf64_Phdr> segments() { return {&at<Elf64_Phdr>(header().e_phoff), header().e_phnum}; }
  Elf64_Phdr& segment(Elf64_Word type) {
    for (Elf64_Phdr& segment : segments())
      if (segment.p_type == type) return segment;
    throw std::runtime_error("no such segment");
  }
  Elf64_Phdr& last_loaded() {
    Elf64_Phdr* last = &segment(PT_LOAD);
    for (Elf64_Phdr& segment : segments())
      if (segment.p_type == PT_LOAD) last = &segment;
    return *last;
  }
  std::span<Elf64_Dyn> dynamic() {
    const Elf64_Phdr& place = segment(PT_DYNAMIC);
    return {&at<Elf64_Dyn>(place.p_offset), place.p_filesz / sizeof(Elf64_Dyn)};
  }
  Elf64_Dyn& dynamic(Elf64_Sxword tag) {
    for (Elf64_Dyn& entry : dynamic())
      if (entry.d_tag == tag) return entry;
    throw std::runtime_error("no such entry");
  }
  bool has(Elf64_Sxword tag) {
    return std::ranges::any_of(dynamic(), [&](const Elf64_Dyn& entry) { return entry.d_tag == tag; });
  }
  /// Turns an entry into one that ElfFile has no use for.
  void remove(Elf64_Sxword tag) { dynamic(tag).d_tag = DT_DEBUG; }

  /// Returns the T at an offset, or at an address in the first segment, where both are the same.
  template <class T>
  T& at(std::uint64_t offset) {
    if (offset + sizeof(T) > bytes_.size()) throw std::runtime_error("beyond the file");
    return *reinterpret_cast<T*>(bytes_.data() + offset);
  }

  /// Adds bytes to the end of the file, in a loaded segment of their own.
  /// @return their address.
  std::uint64_t append(std::span<const std::byte> more) {
    const std::uint64_t offset = bytes_.size();
    bytes_.insert(bytes_.end(), more.begin(), more.end());
    constexpr std::uint64_t kFarAway = 0x7000'0000;
    segment(PT_GNU_STACK) = {PT_LOAD, PF_R, offset, kFarAway + offset, 0, more.size(), more.size(), 1};
    return kFarAway + offset;
  }
  /// Replaces the first place where some bytes occur by as many others.
  void replace(const std::string& from, const std::string& to) {
    const auto* const first = reinterpret_cast<const std::byte*>(from.data());
    const auto place = std::search(bytes_.begin(), bytes_.end(), first, first + from.size());
    if (place == bytes_.end() || to.size() != from.size()) throw std::runtime_error("cannot be replaced");
    std::memcpy(&*place, to.data(), to.size());
  }
  void resize(std::size_t size) { bytes_.resize(size); }

  [[nodiscard]] std::size_t size() const { return bytes_.size(); }
  [[nodiscard]] std::span<const std::byte> bytes(std::uint64_t offset, std::uint64_t size) const {
    return std::span(bytes_).subspan(offset, size);
  }

  /// Parses a copy, which must be a good library; or which must not: returns why.
  [[nodiscard]] plugin::ElfFile parsed() const {
    auto file = plugin::ElfFile::parse(bytes_);
    if (!file) FAIL("refused: " << file.error().text());
    return std::move(file).value();
  }
  [[nodiscard]] plugin::PluginFile plugin() const {
    auto file = plugin::PluginFile::parse(bytes_);
    if (!file) FAIL("refused: " << file.error().text());
    return std::move(file).value();
  }
  [[nodiscard]] std::string refusal() const {
    const auto file = plugin::ElfFile::parse(bytes_);
    if (file) return "it is accepted";
    CHECK(file.error().code == Code::invalid_argument);
    return file.error().message;
  }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace orca::test
