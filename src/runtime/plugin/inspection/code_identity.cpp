// SPDX-License-Identifier: LGPL-3.0-or-later
#include "code_identity.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstddef>
#include <span>

#include "elf_file.hpp"
#include "orca/base/hash.hpp"

namespace orca::plugin {
namespace {

// A search through the libraries that the dynamic linker reports one by one.
struct Search {
  const link_map* wanted;
  CodeIdentity found;
};

std::span<const std::byte> in_memory(const dl_phdr_info& library, const ElfW(Phdr) & segment) {
  return {reinterpret_cast<const std::byte*>(library.dlpi_addr + segment.p_vaddr), segment.p_filesz};
}

// Reads the identity if this is the wanted library. No two libraries have their dynamic section at the same address.
int read_if_wanted(dl_phdr_info* library, std::size_t /*size*/, void* data) {
  Search& search = *static_cast<Search*>(data);
  const std::span segments(library->dlpi_phdr, library->dlpi_phnum);
  bool is_wanted = false;
  for (const auto& segment : segments)
    is_wanted |= segment.p_type == PT_DYNAMIC &&
                 library->dlpi_addr + segment.p_vaddr == reinterpret_cast<ElfW(Addr)>(search.wanted->l_ld);
  if (!is_wanted) return 0;
  Fnv1a hash;
  for (const auto& segment : segments) {
    if (segment.p_type == PT_NOTE && search.found.build_id.empty())
      search.found.build_id = build_id_in(in_memory(*library, segment), segment.p_align);
  }
  if (!search.found.build_id.empty()) return 1;
  for (const auto& segment : segments)
    if (segment.p_type == PT_LOAD && (segment.p_flags & PF_X) != 0) hash.add(in_memory(*library, segment));
  search.found.code_hash = hash.value();
  return 1;
}

}  // namespace

CodeIdentity identity_of(const ElfFile& file) {
  if (!file.build_id().empty()) return {file.build_id(), 0};
  Fnv1a hash;
  for (const ElfFile::Bytes code : file.loaded_parts(true)) hash.add(code);
  return {{}, hash.value()};
}

CodeIdentity identity_in_memory(void* handle) {
  Search search{nullptr, {}};
  if (dlinfo(handle, RTLD_DI_LINKMAP, &search.wanted) == 0) dl_iterate_phdr(read_if_wanted, &search);
  return search.found;
}

}  // namespace orca::plugin
