// SPDX-License-Identifier: LGPL-3.0-or-later
#include "elf_file.hpp"

#include <cxxabi.h>
#include <elf.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <tuple>

#include "elf_extent.hpp"

namespace orca::plugin {
namespace {

#if defined(__x86_64__)
constexpr Elf64_Half kMachine = EM_X86_64;
#elif defined(__aarch64__)
constexpr Elf64_Half kMachine = EM_AARCH64;
#else
#error "name this machine's ELF number here"
#endif

// Limits above those of any real file, so that a hostile file costs no time.
constexpr Elf64_Half kMostSegments = 128;
constexpr std::size_t kMostVersions = 10'000;
constexpr std::size_t kLongestText = 64 * 1024;

Error refuse(const std::string& what) { return fail(Code::invalid_argument, what); }

Error cut_short(const std::string& what, std::uint64_t end, std::size_t size) {
  return refuse("is damaged or cut short: " + what + " reaches to byte " + std::to_string(end) +
                ", but the file has " + std::to_string(size) + " bytes; build or copy it again");
}

std::string kind_of(Elf64_Half type) {
  switch (type) {
    case ET_REL: return "an object file that is not linked yet";
    case ET_EXEC: return "a program";
    case ET_CORE: return "a memory dump";
    default: return "an ELF file of kind " + std::to_string(type);
  }
}

}  // namespace

// The entries of the dynamic section that are used here.
struct ElfFile::Dynamic {
  std::uint64_t strings = 0, strings_size = 0, symbols = 0, hash = 0, gnu_hash = 0;
  std::uint64_t versions = 0, version_needs = 0, version_need_count = 0;
  std::uint64_t run_path = 0, r_path = 0, flags = 0;
  std::vector<std::uint64_t> needed;
  struct Table {
    std::uint64_t address = 0, size = 0;
  };
  std::array<Table, 2> relocations;  // of variables, and of functions

  void take(const Elf64_Dyn& entry) {
    const std::uint64_t value = entry.d_un.d_val;
    switch (entry.d_tag) {
      case DT_STRTAB: strings = value; break;
      case DT_STRSZ: strings_size = value; break;
      case DT_SYMTAB: symbols = value; break;
      case DT_HASH: hash = value; break;
      case DT_GNU_HASH: gnu_hash = value; break;
      case DT_VERSYM: versions = value; break;
      case DT_VERNEED: version_needs = value; break;
      case DT_VERNEEDNUM: version_need_count = value; break;
      case DT_RUNPATH: run_path = value; break;
      case DT_RPATH: r_path = value; break;
      case DT_FLAGS_1: flags = value; break;
      case DT_NEEDED: needed.push_back(value); break;
      default: take_relocations(entry);
    }
  }

  void take_relocations(const Elf64_Dyn& entry) {
    const std::uint64_t value = entry.d_un.d_val;
    switch (entry.d_tag) {
      case DT_RELA: relocations[0].address = value; break;
      case DT_RELASZ: relocations[0].size = value; break;
      case DT_JMPREL: relocations[1].address = value; break;
      case DT_PLTRELSZ: relocations[1].size = value; break;
      default: break;
    }
  }
};

Result<ElfFile> ElfFile::parse(std::vector<std::byte> bytes) {
  ElfFile file(std::move(bytes));
  if (Status read = file.read_header(); !read.ok()) return read.error();
  if (Status read = file.read_segments(); !read.ok()) return read.error();
  return file;
}

std::optional<ElfFile::Bytes> ElfFile::at_offset(std::uint64_t offset, std::uint64_t size) const {
  if (offset > bytes_.size() || size > bytes_.size() - offset) return std::nullopt;
  return Bytes(bytes_).subspan(offset, size);
}

std::vector<ElfFile::Bytes> ElfFile::loaded_parts(bool only_code) const {
  std::vector<Bytes> parts;
  for (const Segment& segment : segments_)
    if (const auto bytes = at_offset(segment.offset, segment.size); bytes && (segment.code || !only_code))
      parts.push_back(*bytes);
  return parts;
}

std::optional<ElfFile::Bytes> ElfFile::at_address(std::uint64_t address, std::size_t size) const {
  for (const Segment& segment : segments_) {
    if (address < segment.address || address - segment.address > segment.size) continue;
    const std::uint64_t inside = address - segment.address;
    if (size <= segment.size - inside) return at_offset(segment.offset + inside, size);
  }
  return std::nullopt;
}

template <class T>
std::optional<T> ElfFile::get(std::uint64_t offset) const {
  const auto found = at_offset(offset, sizeof(T));
  if (!found) return std::nullopt;
  T value;
  std::memcpy(&value, found->data(), sizeof(T));
  return value;
}

template <class T>
std::optional<T> ElfFile::get_at(std::uint64_t address) const {
  const auto found = at_address(address, sizeof(T));
  if (!found) return std::nullopt;
  T value;
  std::memcpy(&value, found->data(), sizeof(T));
  return value;
}

std::string_view ElfFile::text(Bytes table, std::uint64_t at) {
  if (at >= table.size()) return {};
  const auto* const start = reinterpret_cast<const char*>(table.data() + at);
  const void* const end = std::memchr(start, 0, std::min(table.size() - at, kLongestText));
  if (end == nullptr) return {};
  return {start, static_cast<std::size_t>(static_cast<const char*>(end) - start)};
}

Status ElfFile::read_header() {
  if (bytes_.size() < SELFMAG || std::memcmp(bytes_.data(), ELFMAG, SELFMAG) != 0)
    return refuse("is no shared library: it does not start with the mark of an ELF file");
  const auto header = get<Elf64_Ehdr>(0);
  if (!header) return cut_short("its header", sizeof(Elf64_Ehdr), bytes_.size());
  if (header->e_ident[EI_CLASS] != ELFCLASS64 || header->e_ident[EI_DATA] != ELFDATA2LSB ||
      header->e_machine != kMachine) {
    return refuse("was built for another kind of machine (ELF machine " + std::to_string(header->e_machine) +
                  ", this is " + std::to_string(kMachine) +
                  ", 64 bits, little-endian); build it for this one");
  }
  if (header->e_type != ET_DYN) return refuse("is no shared library, but " + kind_of(header->e_type));
  if (header->e_phentsize != sizeof(Elf64_Phdr))
    return refuse("is damaged: the entries of its segment table have " + std::to_string(header->e_phentsize) +
                  " bytes, expected " + std::to_string(sizeof(Elf64_Phdr)));
  if (header->e_phnum > kMostSegments)
    return refuse("is damaged: it has " + std::to_string(header->e_phnum) + " segments");
  return ok();
}

Status ElfFile::read_segments() {
  const auto header = get<Elf64_Ehdr>(0);
  std::optional<Elf64_Phdr> dynamic;
  std::vector<Elf64_Phdr> all;
  for (std::uint64_t i = 0; i < header->e_phnum; ++i) {
    const auto segment = get<Elf64_Phdr>(header->e_phoff + i * sizeof(Elf64_Phdr));
    if (!segment)
      return cut_short("its segment table", header->e_phoff + header->e_phnum * sizeof(Elf64_Phdr),
                       bytes_.size());
    all.push_back(*segment);
    if (segment->p_type == PT_DYNAMIC) dynamic = *segment;
    if (segment->p_type == PT_NOTE && build_id_.empty())
      if (const auto notes = at_offset(segment->p_offset, segment->p_filesz))
        build_id_ = build_id_in(*notes, segment->p_align);
    if (segment->p_type != PT_LOAD) continue;
    if (!at_offset(segment->p_offset, segment->p_filesz))
      return cut_short("a segment", segment->p_offset + segment->p_filesz, bytes_.size());
    segments_.push_back(
        {segment->p_vaddr, segment->p_offset, segment->p_filesz, (segment->p_flags & PF_X) != 0});
  }
  if (!dynamic) return refuse("is no shared library: it has no dynamic section");
  if (const auto fault = segment_fault(all))
    return refuse("is damaged: " + *fault + "; build or copy it again");
  return read_dynamic(dynamic->p_offset, dynamic->p_filesz, all);
}

Status ElfFile::read_dynamic(std::uint64_t offset, std::uint64_t size, std::span<const Elf64_Phdr> segments) {
  Dynamic dynamic;
  if (!at_offset(offset, size)) return cut_short("its dynamic section", offset + size, bytes_.size());
  for (std::uint64_t at = 0; at + sizeof(Elf64_Dyn) <= size; at += sizeof(Elf64_Dyn)) {
    const auto entry = get<Elf64_Dyn>(offset + at);
    if (!entry || entry->d_tag == DT_NULL) break;
    dynamic.take(*entry);
  }
  for (const auto& [table, bytes] : dynamic.relocations)
    if (Status checked = check_relocations(table, bytes, segments); !checked.ok()) return checked;
  if ((dynamic.flags & DF_1_PIE) != 0) return refuse("is no shared library, but a program");
  const auto strings = at_address(dynamic.strings, dynamic.strings_size);
  if (!strings) return refuse("is damaged: its table of names is not in the file");
  strings_ = *strings;
  for (const std::uint64_t name : dynamic.needed) needed_.push_back(text(strings_, name));
  search_path_ = text(strings_, dynamic.run_path != 0 ? dynamic.run_path : dynamic.r_path);
  return read_symbols(dynamic);
}

// The dynamic linker writes to each of these places before any code runs.
Status ElfFile::check_relocations(std::uint64_t table, std::uint64_t size,
                                  std::span<const Elf64_Phdr> segments) const {
  for (std::uint64_t at = 0; at + sizeof(Elf64_Rela) <= size; at += sizeof(Elf64_Rela)) {
    const auto entry = get_at<Elf64_Rela>(table + at);
    if (!entry) return refuse("is damaged: its table of relocations is not completely in the file");
    if (!is_writable(segments, entry->r_offset, sizeof(Elf64_Addr)))
      return refuse("is damaged: a relocation at address " + std::to_string(entry->r_offset) +
                    " lies outside of its variables; build or copy it again");
  }
  return ok();
}

Status ElfFile::read_symbols(const Dynamic& dynamic) {
  const Versions versions = read_versions(dynamic);
  const std::size_t count = symbol_count(dynamic);
  for (std::size_t i = 1; i < count; ++i) {  // the first one means "no symbol"
    const auto symbol = get_at<Elf64_Sym>(dynamic.symbols + i * sizeof(Elf64_Sym));
    if (!symbol) return refuse("is damaged: its table of symbols is not completely in the file");
    const unsigned binding = ELF64_ST_BIND(symbol->st_info);
    if (binding == STB_LOCAL) continue;
    ElfSymbol read{text(strings_, symbol->st_name),
                   symbol->st_shndx != SHN_UNDEF,
                   binding == STB_WEAK,
                   binding == STB_GNU_UNIQUE,
                   symbol->st_value,
                   {},
                   {}};
    if (dynamic.versions != 0) {
      const auto version = get_at<Elf64_Half>(dynamic.versions + i * sizeof(Elf64_Half));
      const std::size_t index = version ? *version & 0x7fffU : 0;
      if (index < versions.size()) std::tie(read.version, read.version_of) = versions[index];
    }
    symbols_.push_back(read);
  }
  return ok();
}

// Returns the name of each version and of its library, by the number in the symbols' version entries.
ElfFile::Versions ElfFile::read_versions(const Dynamic& dynamic) const {
  Versions versions;
  std::size_t left = kMostVersions;
  std::uint64_t at = dynamic.version_needs;
  for (std::uint64_t i = 0; at != 0 && i < dynamic.version_need_count && left > 0; ++i) {
    const auto library = get_at<Elf64_Verneed>(at);
    if (!library) break;
    std::uint64_t aux_at = at + library->vn_aux;
    for (std::uint64_t k = 0; k < library->vn_cnt && left > 0; ++k, --left) {
      const auto version = get_at<Elf64_Vernaux>(aux_at);
      if (!version) break;
      const std::size_t index = version->vna_other & 0x7fffU;
      if (index >= versions.size()) versions.resize(index + 1);
      versions[index] = {text(strings_, version->vna_name), text(strings_, library->vn_file)};
      if (version->vna_next == 0) break;
      aux_at += version->vna_next;
    }
    if (library->vn_next == 0) break;
    at += library->vn_next;
  }
  return versions;
}

// Returns the number of symbols, at most as many as the file has room for. The dynamic section does not give
// it, but the hash tables do.
std::size_t ElfFile::symbol_count(const Dynamic& dynamic) const {
  std::size_t count = 0;
  if (dynamic.gnu_hash != 0) {
    count = count_by_gnu_hash(dynamic.gnu_hash);
  } else if (dynamic.hash != 0) {
    if (const auto words = get_at<std::array<Elf64_Word, 2>>(dynamic.hash)) count = (*words)[1];
  }
  return std::min(count, bytes_.size() / sizeof(Elf64_Sym));
}

std::size_t ElfFile::count_by_gnu_hash(std::uint64_t table) const {
  struct Header {
    std::uint32_t buckets, first_symbol, bloom_words, bloom_shift;
  };
  const auto header = get_at<Header>(table);
  if (!header) return 0;
  const std::uint64_t buckets_at = table + sizeof(Header) + std::uint64_t{header->bloom_words} * 8;
  const std::uint64_t chains_at = buckets_at + std::uint64_t{header->buckets} * 4;
  std::uint64_t last = 0;
  for (std::uint64_t i = 0; i < header->buckets; ++i) {
    const auto bucket = get_at<std::uint32_t>(buckets_at + i * 4);
    if (!bucket) return 0;
    last = std::max<std::uint64_t>(last, *bucket);
  }
  if (last < header->first_symbol) return header->first_symbol;  // it defines no symbol
  for (;; ++last) {
    const auto chain = get_at<std::uint32_t>(chains_at + (last - header->first_symbol) * 4);
    if (!chain) return 0;
    if ((*chain & 1U) != 0) return last + 1;
  }
}

std::optional<ElfFile::Bytes> ElfFile::section(std::string_view name) const {
  const auto header = get<Elf64_Ehdr>(0);
  if (!header || header->e_shoff == 0 || header->e_shentsize != sizeof(Elf64_Shdr)) return std::nullopt;
  const auto place = [&](std::uint64_t index) { return header->e_shoff + index * sizeof(Elf64_Shdr); };
  const auto names_section = get<Elf64_Shdr>(place(header->e_shstrndx));
  if (!names_section) return std::nullopt;
  const auto names = at_offset(names_section->sh_offset, names_section->sh_size);
  for (std::uint64_t i = 1; names && i < header->e_shnum; ++i) {  // the first one means "no section"
    const auto section = get<Elf64_Shdr>(place(i));
    if (!section) break;
    if (section->sh_type != SHT_NOBITS && text(*names, section->sh_name) == name)
      return at_offset(section->sh_offset, section->sh_size);
  }
  return std::nullopt;
}

std::string demangled(std::string_view symbol) {
  constexpr std::size_t kLongest = 4096;  // the demangler of the C++ library recurses
  std::string name(symbol);
  if (name.size() > kLongest || !name.starts_with("_Z")) return name;
  int status = 0;
  char* const text = abi::__cxa_demangle(name.c_str(), nullptr, nullptr, &status);
  if (status == 0) name = text;
  std::free(text);
  return name;
}

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
