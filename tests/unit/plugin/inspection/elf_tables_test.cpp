// SPDX-License-Identifier: GPL-3.0-or-later
// Tables that no linker writes: each is refused with the reason, or read as far as it makes sense.
#include <set>

#include "elf_image.hpp"

using namespace orca;
using namespace orca::plugin;
using namespace orca::test;
using Catch::Contains;
using Catch::StartsWith;

namespace {

ElfImage gnu() { return ElfImage(sample("sample_gnu")); }
ElfImage sysv() { return ElfImage(sample("sample_sysv")); }

// Everything that was read, as text.
std::string described(const ElfFile& file) {
  std::string text = std::string(file.search_path()) + "\n";
  for (const std::string_view name : file.needed()) text += std::string(name) + "\n";
  for (const ElfSymbol& symbol : file.symbols())
    text += std::string(symbol.name) + " " + std::to_string(symbol.defined) + std::to_string(symbol.weak) +
            std::to_string(symbol.unique) + " " + std::string(symbol.version) + " " +
            std::string(symbol.version_of) + "\n";
  return text;
}

bool has_versions(const ElfFile& file) {
  return std::ranges::any_of(file.symbols(), [](const ElfSymbol& symbol) { return !symbol.version.empty(); });
}

std::string cut_short(const std::string& what, std::uint64_t end, std::size_t size) {
  return "is damaged or cut short: " + what + " reaches to byte " + std::to_string(end) +
         ", but the file has " + std::to_string(size) + " bytes; build or copy it again";
}

}  // namespace

TEST_CASE("a file without the mark of an ELF file is no shared library", "[plugin][elf]") {
  ElfImage image = gnu();
  image.resize(3);
  CHECK_THAT(image.refusal(), Contains("does not start with the mark of an ELF file"));
  image.resize(0);
  CHECK_THAT(image.refusal(), Contains("does not start with the mark of an ELF file"));
  ElfImage text = gnu();
  text.header().e_ident[EI_MAG1] = 'F';
  CHECK_THAT(text.refusal(), Contains("does not start with the mark of an ELF file"));
}

TEST_CASE("a file that ends within the ELF header is cut short", "[plugin][elf]") {
  for (const std::size_t size : {std::size_t{SELFMAG}, sizeof(Elf64_Ehdr) - 1}) {
    ElfImage image = gnu();
    image.resize(size);
    CHECK(image.refusal() == cut_short("its header", sizeof(Elf64_Ehdr), size));
  }
}

TEST_CASE("a library for another kind of machine is refused, whatever the difference is", "[plugin][elf]") {
  ElfImage image = gnu();
  SECTION("its words") { image.header().e_ident[EI_CLASS] = ELFCLASS32; }
  SECTION("its byte order") { image.header().e_ident[EI_DATA] = ELFDATA2MSB; }
  SECTION("its instructions") { image.header().e_machine = EM_RISCV; }
  CHECK_THAT(image.refusal(), StartsWith("was built for another kind of machine") &&
                                  Contains("ELF machine " + std::to_string(image.header().e_machine) + ","));
}

TEST_CASE("an ELF file that is no library is refused as what it is", "[plugin][elf]") {
  const auto [type, name] =
      GENERATE(table<Elf64_Half, std::string>({{ET_REL, "an object file that is not linked yet"},
                                               {ET_EXEC, "a program"},
                                               {ET_CORE, "a memory dump"},
                                               {Elf64_Half{9}, "an ELF file of kind 9"}}));
  ElfImage image = gnu();
  image.header().e_type = type;
  CHECK(image.refusal() == "is no shared library, but " + name);
}

TEST_CASE("a program that may lie anywhere in memory is refused as a program", "[plugin][elf]") {
  ElfImage image = gnu();
  image.dynamic(DT_RUNPATH) = {DT_FLAGS_1, {DF_1_NOW}};
  CHECK(image.refusal() == "it is accepted");
  image.dynamic(DT_FLAGS_1).d_un.d_val = DF_1_NOW | DF_1_PIE;
  CHECK(image.refusal() == "is no shared library, but a program");
}

TEST_CASE("a segment table of another shape is refused", "[plugin][elf]") {
  ElfImage image = gnu();
  image.header().e_phentsize = sizeof(Elf64_Phdr) + 8;
  CHECK(image.refusal() == "is damaged: the entries of its segment table have 64 bytes, expected 56");
}

TEST_CASE("a library has at most 128 segments", "[plugin][elf]") {
  ElfImage image = gnu();
  const std::vector<Elf64_Phdr> segments(image.segments().begin(), image.segments().end());
  const std::size_t start = image.size();
  image.resize(start + 129 * sizeof(Elf64_Phdr));
  std::memcpy(&image.at<Elf64_Phdr>(start), segments.data(), segments.size() * sizeof(Elf64_Phdr));
  image.header().e_phoff = start;
  image.header().e_phnum = 128;
  CHECK(described(image.parsed()) == described(gnu().parsed()));
  image.header().e_phnum = 129;
  CHECK(image.refusal() == "is damaged: it has 129 segments");
}

TEST_CASE("a segment table that reaches beyond the file is cut short", "[plugin][elf]") {
  ElfImage image = gnu();
  image.header().e_phoff = image.size() - 1;
  const std::uint64_t end = image.size() - 1 + image.header().e_phnum * sizeof(Elf64_Phdr);
  CHECK(image.refusal() == cut_short("its segment table", end, image.size()));
}

TEST_CASE("a loaded segment may reach to the end of the file, and no further", "[plugin][elf]") {
  ElfImage image = gnu();
  Elf64_Phdr& segment = image.last_loaded();
  segment.p_filesz = segment.p_memsz = image.size() - segment.p_offset;
  CHECK(image.refusal() == "it is accepted");
  ++segment.p_filesz;
  CHECK(image.refusal() == cut_short("a segment", image.size() + 1, image.size()));
  segment.p_offset = image.size() + 1;
  segment.p_filesz = 1;
  CHECK(image.refusal() == cut_short("a segment", image.size() + 2, image.size()));
}

TEST_CASE("a library needs a dynamic section that is in the file", "[plugin][elf]") {
  ElfImage image = gnu();
  Elf64_Phdr& section = image.segment(PT_DYNAMIC);
  section.p_filesz = image.size() - section.p_offset + 1;
  CHECK(image.refusal() == cut_short("its dynamic section", image.size() + 1, image.size()));
  section.p_type = PT_NOTE;
  CHECK(image.refusal() == "is no shared library: it has no dynamic section");
}

TEST_CASE("the dynamic section ends at its first empty entry, or at its size", "[plugin][elf]") {
  const std::size_t count = gnu().dynamic().size();
  std::set<std::string> different;
  for (std::size_t end = 0; end < count; ++end) {
    CAPTURE(end);
    ElfImage shorter = gnu();
    shorter.segment(PT_DYNAMIC).p_filesz = end * sizeof(Elf64_Dyn);
    ElfImage ended = gnu();
    ended.dynamic()[end].d_tag = DT_NULL;
    const auto expected =
        ElfFile::parse({shorter.bytes(0, shorter.size()).begin(), shorter.bytes(0, shorter.size()).end()});
    const auto read =
        ElfFile::parse({ended.bytes(0, ended.size()).begin(), ended.bytes(0, ended.size()).end()});
    REQUIRE(read.has_value() == expected.has_value());
    if (read) CHECK(described(*read) == described(*expected));
    different.insert(read ? described(*read) : read.error().message);
  }
  CHECK(different.size() > 5);  // most entries count
}

TEST_CASE("names and symbols that are not in the file are refused", "[plugin][elf]") {
  ElfImage names = gnu();
  names.dynamic(DT_STRTAB).d_un.d_val = 1ULL << 40;
  CHECK(names.refusal() == "is damaged: its table of names is not in the file");
  ElfImage symbols = gnu();
  symbols.dynamic(DT_SYMTAB).d_un.d_val = 1ULL << 40;
  CHECK(symbols.refusal() == "is damaged: its table of symbols is not completely in the file");
}

TEST_CASE("symbols that the library keeps to itself are left out", "[plugin][elf]") {
  ElfImage image = sysv();
  const auto before = image.parsed().symbols().size();
  auto& symbol = image.at<Elf64_Sym>(image.dynamic(DT_SYMTAB).d_un.d_val + sizeof(Elf64_Sym));
  symbol.st_info = ELF64_ST_INFO(STB_LOCAL, STT_FUNC);
  CHECK(image.parsed().symbols().size() == before - 1);
}

TEST_CASE("a name without an end, or outside its table, is empty", "[plugin][elf]") {
  ElfImage image = gnu();
  const std::string first(image.parsed().needed().front());
  REQUIRE_FALSE(first.empty());
  const std::uint64_t name = image.dynamic(DT_NEEDED).d_un.d_val;
  image.dynamic(DT_STRSZ).d_un.d_val = name + first.size() + 1;
  CHECK(image.parsed().needed().front() == first);
  --image.dynamic(DT_STRSZ).d_un.d_val;
  CHECK(image.parsed().needed().front().empty());
  image.dynamic(DT_STRSZ).d_un.d_val = name;
  CHECK(image.parsed().needed().front().empty());
}

TEST_CASE("a name has fewer than 64 KiB", "[plugin][elf]") {
  const auto length = GENERATE(std::size_t{65535}, std::size_t{65536});
  ElfImage image = gnu();
  std::vector<std::byte> names(length, std::byte{'x'});
  names.resize(length + 1000);
  image.dynamic(DT_NEEDED).d_un.d_val = 0;
  image.dynamic(DT_STRSZ).d_un.d_val = names.size();
  image.dynamic(DT_STRTAB).d_un.d_val = image.append(names);
  CHECK(image.parsed().needed().front().size() == (length < 65536 ? length : 0));
}

TEST_CASE("a library without one of its tables of versions has symbols without versions", "[plugin][elf]") {
  REQUIRE(has_versions(gnu().parsed()));
  for (const Elf64_Sxword tag : {DT_VERSYM, DT_VERNEED, DT_VERNEEDNUM}) {
    CAPTURE(tag);
    ElfImage image = gnu();
    image.remove(tag);
    const ElfFile file = image.parsed();
    CHECK(file.symbols().size() == gnu().parsed().symbols().size());
    CHECK_FALSE(has_versions(file));
    for (const ElfSymbol& symbol : file.symbols()) CHECK(symbol.version_of.empty());
  }
  ElfImage elsewhere = gnu();
  elsewhere.dynamic(DT_VERNEED).d_un.d_val = 1ULL << 40;
  CHECK_FALSE(has_versions(elsewhere.parsed()));
}

TEST_CASE("only as many libraries have versions as the dynamic section says", "[plugin][elf]") {
  const auto libraries = [](const ElfFile& file) {
    std::set<std::string> names;
    for (const ElfSymbol& symbol : file.symbols())
      if (!symbol.version_of.empty()) names.emplace(symbol.version_of);
    return names;
  };
  ElfImage image = gnu();
  auto& count = image.dynamic(DT_VERNEEDNUM).d_un.d_val;
  REQUIRE(count >= 2);
  CHECK(libraries(image.parsed()).size() == count);
  count = 1;
  CHECK(libraries(image.parsed()).size() == 1);
  count = 1'000'000;  // more than there are
  CHECK(libraries(image.parsed()) == libraries(gnu().parsed()));
}

TEST_CASE(
    "the versions of a library end with the one that names no next one, whatever their number is said to be",
    "[plugin][elf]") {
  const std::string expected = described(gnu().parsed());
  ElfImage image = gnu();
  image.at<Elf64_Verneed>(image.dynamic(DT_VERNEED).d_un.d_val).vn_cnt = 60'000;
  CHECK(described(image.parsed()) == expected);
}

TEST_CASE("at most 10000 versions are read, of all libraries together", "[plugin][elf]") {
  ElfImage image = gnu();
  constexpr Elf64_Half kOfFirst = 9'999, kOfSecond = 2;
  const auto name = static_cast<Elf64_Word>(image.dynamic(DT_NEEDED).d_un.d_val);
  std::vector<std::byte> table;
  const auto add = [&](const auto& entry) {
    const auto bytes = std::as_bytes(std::span(&entry, 1));
    table.insert(table.end(), bytes.begin(), bytes.end());
  };
  Elf64_Half number = 2;
  for (const Elf64_Half count : {kOfFirst, kOfSecond}) {
    const auto size = static_cast<Elf64_Word>(sizeof(Elf64_Verneed) + count * sizeof(Elf64_Vernaux));
    add(Elf64_Verneed{1, count, name, sizeof(Elf64_Verneed), size});
    for (int i = 0; i < count; ++i) add(Elf64_Vernaux{0, 0, number++, name, sizeof(Elf64_Vernaux)});
  }
  const std::size_t of_symbols = table.size();
  for (const int of_symbol : {0, number - 2, number - 1}) add(static_cast<Elf64_Half>(of_symbol));
  const std::uint64_t address = image.append(table);
  image.dynamic(DT_VERNEED).d_un.d_val = address;
  image.dynamic(DT_VERNEEDNUM).d_un.d_val = 2;
  image.dynamic(DT_VERSYM).d_un.d_val = address + of_symbols;
  const ElfFile file = image.parsed();
  CHECK(file.symbols()[0].version == file.needed().front());
  CHECK(file.symbols()[1].version.empty());
}

TEST_CASE("a library without a hash table, or with one that is not in the file, has no symbols",
          "[plugin][elf]") {
  for (const Elf64_Sxword tag : {DT_GNU_HASH, DT_HASH}) {
    CAPTURE(tag);
    ElfImage image = tag == DT_HASH ? sysv() : gnu();
    REQUIRE_FALSE(image.parsed().symbols().empty());
    image.dynamic(tag).d_un.d_val = 1ULL << 40;
    CHECK(image.parsed().symbols().empty());
    image.remove(tag);
    CHECK(image.parsed().symbols().empty());
  }
}

TEST_CASE("a GNU hash table that reaches beyond the file gives no symbols", "[plugin][elf]") {
  ElfImage image = gnu();
  const std::uint64_t table = image.dynamic(DT_GNU_HASH).d_un.d_val;
  image.at<std::uint32_t>(table + 8) = UINT32_MAX;  // words of its filter
  CHECK(image.parsed().symbols().empty());
  ElfImage chains = gnu();
  const auto buckets = table + 16 + 8ULL * chains.at<std::uint32_t>(table + 8);
  chains.at<std::uint32_t>(buckets) = UINT32_MAX;  // a symbol far beyond the last
  CHECK(chains.parsed().symbols().empty());
}

TEST_CASE("a GNU hash table that leads to no symbol leaves those before its first", "[plugin][elf]") {
  ElfImage image = gnu();
  const std::uint64_t table = image.dynamic(DT_GNU_HASH).d_un.d_val;
  const std::uint64_t buckets = table + 16 + 8ULL * image.at<std::uint32_t>(table + 8);
  for (std::uint32_t i = 0; i < image.at<std::uint32_t>(table); ++i)
    image.at<std::uint32_t>(buckets + 4 * i) = 0;
  const auto symbols = image.parsed();
  CHECK(symbols.symbols().size() == image.at<std::uint32_t>(table + 4) - 1);
  for (const ElfSymbol& symbol : symbols.symbols()) CHECK_FALSE(symbol.defined);
}

TEST_CASE("a library has at most as many symbols as the file has room for", "[plugin][elf]") {
  ElfImage image = sysv();
  image.at<Elf64_Word>(image.dynamic(DT_HASH).d_un.d_val + 4) = UINT32_MAX;
  CHECK(image.refusal() == "is damaged: its table of symbols is not completely in the file");
}

TEST_CASE("a library without a good table of sections has no sections", "[plugin][elf]") {
  const auto has_sections = [](const ElfImage& image) {
    return image.parsed().section(".dynsym").has_value();
  };
  REQUIRE(has_sections(gnu()));
  ElfImage image = gnu();
  SECTION("none") { image.header().e_shoff = 0; }
  SECTION("one of another shape") { image.header().e_shentsize = sizeof(Elf64_Shdr) + 8; }
  SECTION("one beyond the file") { image.header().e_shoff = image.size(); }
  SECTION("one whose names are beyond the table") { image.header().e_shstrndx = 0xff00; }
  SECTION("one without entries") { image.header().e_shnum = 0; }
  CHECK_FALSE(has_sections(image));
}

TEST_CASE("the last section counts, and an entry behind it does not", "[plugin][elf]") {
  ElfImage image = gnu();
  const std::uint64_t last = image.header().e_shoff + (image.header().e_shnum - 1ULL) * sizeof(Elf64_Shdr);
  const auto names =
      image.at<Elf64_Shdr>(image.header().e_shoff + image.header().e_shstrndx * sizeof(Elf64_Shdr));
  const std::string name = &image.at<char>(names.sh_offset + image.at<Elf64_Shdr>(last).sh_name);
  CHECK(image.parsed().section(name));
  --image.header().e_shnum;
  CHECK_FALSE(image.parsed().section(name));
}
