// SPDX-License-Identifier: LGPL-3.0-or-later
#include "elf_extent.hpp"

#include <algorithm>

namespace orca::plugin {
namespace {

constexpr std::uint64_t kPage = 4096;                       // the smallest; linkers choose this or a multiple
constexpr std::uint64_t kLargest = std::uint64_t{1} << 32;  // [bytes] from the first to the last address

std::uint64_t page_end(std::uint64_t address) { return (address + kPage - 1) / kPage * kPage; }

// Returns whether a part of the address space lies in one that is loaded, which may be rounded up to whole pages.
bool is_within(const Elf64_Phdr& part, std::uint64_t size, const Elf64_Phdr& loaded) {
  const std::uint64_t end = page_end(loaded.p_vaddr + loaded.p_memsz);
  return part.p_vaddr >= loaded.p_vaddr && part.p_vaddr <= end && size <= end - part.p_vaddr;
}

std::string between(const Elf64_Phdr& segment) {
  return "from address " + std::to_string(segment.p_vaddr) + " on, " + std::to_string(segment.p_memsz) +
         " bytes";
}

// @param end  of the segments before it.
std::optional<std::string> load_fault(const Elf64_Phdr& segment, std::uint64_t end) {
  if (segment.p_vaddr > kLargest || segment.p_memsz > kLargest || segment.p_filesz > segment.p_memsz)
    return "a segment is larger than any library, or than its place in memory (" + between(segment) + ")";
  if (segment.p_vaddr % kPage != segment.p_offset % kPage)
    return "a segment begins elsewhere in a page than in the file (" + between(segment) + ")";
  if (segment.p_vaddr / kPage * kPage < end)
    return "a segment lies before the end of another one (" + between(segment) + ")";
  return std::nullopt;
}

const char* name_of(Elf64_Word type) {
  switch (type) {
    case PT_DYNAMIC: return "its dynamic section";
    case PT_GNU_RELRO: return "what becomes read-only once it is loaded";
    case PT_GNU_EH_FRAME: return "its table of exceptions";
    case PT_NOTE: return "its notes";
    case PT_TLS: return "its thread-local variables";
    default: return nullptr;
  }
}

// Checks what lies in a segment that is loaded.
std::optional<std::string> part_fault(const Elf64_Phdr& part, std::span<const Elf64_Phdr> segments) {
  const char* const name = name_of(part.p_type);
  if (name == nullptr) return std::nullopt;
  const bool is_tls = part.p_type == PT_TLS;  // in memory each thread has its own, elsewhere
  if (is_tls && part.p_filesz == 0 && part.p_memsz <= kLargest) return std::nullopt;
  const auto holds = [&](const Elf64_Phdr& loaded) {
    if (loaded.p_type != PT_LOAD || !is_within(part, is_tls ? part.p_filesz : part.p_memsz, loaded))
      return false;
    if (part.p_type == PT_GNU_RELRO) return (loaded.p_flags & PF_W) != 0;
    return part.p_vaddr - loaded.p_vaddr == part.p_offset - loaded.p_offset;
  };
  if (std::ranges::none_of(segments, holds) || part.p_memsz > kLargest)
    return std::string(name) + " does not lie in what is loaded of it (" + between(part) + ")";
  return std::nullopt;
}

}  // namespace

std::optional<std::string> segment_fault(std::span<const Elf64_Phdr> segments) {
  std::uint64_t end = 0;
  for (const Elf64_Phdr& segment : segments) {
    if (segment.p_type != PT_LOAD) continue;
    if (auto fault = load_fault(segment, end)) return fault;
    end = page_end(segment.p_vaddr + segment.p_memsz);
  }
  for (const Elf64_Phdr& part : segments)
    if (auto fault = part_fault(part, segments)) return fault;
  return std::nullopt;
}

bool is_writable(std::span<const Elf64_Phdr> segments, std::uint64_t address, std::uint64_t size) {
  return std::ranges::any_of(segments, [&](const Elf64_Phdr& segment) {
    return segment.p_type == PT_LOAD && (segment.p_flags & PF_W) != 0 && address >= segment.p_vaddr &&
           size <= segment.p_memsz && address - segment.p_vaddr <= segment.p_memsz - size;
  });
}

}  // namespace orca::plugin
