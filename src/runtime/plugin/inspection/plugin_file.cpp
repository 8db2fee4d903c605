// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plugin_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <optional>

#include "elf_file.hpp"
#include "object_types_of.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/base/input_file.hpp"
#include "orca/base/text.hpp"
#include "orca/component/manifest.hpp"
#include "plugin_layouts.hpp"
#include "telltale_bytes.hpp"
#include "virtual_time.hpp"

namespace orca::plugin {
namespace {

constexpr std::string_view kManifest = "orca_plugin_manifest";
constexpr const char* kRecipe = "; build it with orca_add_component()";

// Lists a few of the names, each shortened if it is long.
std::string shortly_listed(std::vector<std::string> names) {
  constexpr std::size_t kMost = 4;
  constexpr std::size_t kLongest = 80;
  for (std::string& name : names)
    if (name.size() > kLongest) name = name.substr(0, kLongest) + "...";
  return listed(names, kMost);
}

constexpr std::streamoff kMaxPluginBytes = 1'000'000'000;

Result<std::vector<std::byte>> bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) throw_if_exhausted(errno);
  if (!file) return fail(Code::not_found, std::string("cannot be read: ") + std::strerror(errno), path);
  const std::streamoff size = file.tellg();
  if (size > kMaxPluginBytes)
    return fail(Code::invalid_argument, "has " + std::to_string(size) + " bytes; a plugin has at most 1 GB",
                path);
  std::vector<std::byte> bytes(static_cast<std::size_t>(std::max<std::streamoff>(size, 0)));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), size);
  if (file.gcount() != size) return fail(Code::data_loss, "cannot be read to its end", path);
  remember_input_file(path);
  return bytes;
}

// Returns by what a plugin gives the process a function of its own that outlives it; empty: the symbol does not. Functions of atexit()
// are called when their library is unloaded.
std::string ending_by(const ElfSymbol& symbol) {
  const std::string unless = "; use the destructor of the component, or atexit()";
  if (symbol.defined) return {};
  if (symbol.name == "on_exit") return "when that ends, by on_exit()" + unless;
  if (symbol.name == "__cxa_at_quick_exit") return "when that ends, by at_quick_exit()" + unless;
  if (symbol.name == "pthread_key_create" || symbol.name == "tss_create")
    return "when one of its threads ends, by " + std::string(symbol.name) +
           "(); make the variable a member of the component";
  return {};
}

void check_endings(const ElfFile& elf, std::vector<std::string>& faults) {
  for (const ElfSymbol& symbol : elf.symbols())
    if (const std::string ending = ending_by(symbol); !ending.empty())
      faults.push_back("could crash the process after it was unloaded, " + ending);
}

}  // namespace

Result<PluginFile> PluginFile::read(const std::string& path) {
  Result<std::vector<std::byte>> bytes = bytes_of(path);
  if (!bytes) return bytes.error();
  Result<PluginFile> file = parse(std::move(bytes).value());
  if (!file) return fail(file.error().code, file.error().message, path);
  return file;
}

Result<PluginFile> PluginFile::parse(std::vector<std::byte> bytes) {
  Result<ElfFile> elf = ElfFile::parse(std::move(bytes));
  if (!elf) return elf.error();
  return PluginFile(std::move(elf).value());
}

const ElfSymbol* PluginFile::manifest() const {
  for (const ElfSymbol& symbol : elf_.symbols())
    if (symbol.defined && symbol.name == kManifest) return &symbol;
  return nullptr;
}

std::vector<std::string> PluginFile::faults(const KnownType& known) const {
  std::vector<std::string> faults;
  if (manifest() == nullptr)
    return {"is not an Orca plugin: it exports no " + std::string(kManifest) + kRecipe};
  check_manifest(faults);
  if (!faults.empty()) return faults;  // the rest of the file follows other rules
  check_layouts(faults);
  check_recipe(faults);
  for (std::string& fault : type_faults(elf_, known)) faults.push_back(std::move(fault));
  return faults;
}

void PluginFile::check_manifest(std::vector<std::string>& faults) const {
  struct Head {
    std::uint32_t abi_version, size;
  } head{};
  const auto bytes = elf_.at_address(manifest()->address, sizeof head);
  if (!bytes) return faults.push_back("is damaged: its manifest is not in the file");
  std::memcpy(&head, bytes->data(), sizeof head);
  const std::string versions = "was built for plugin ABI " + std::to_string(head.abi_version) +
                               " (manifest of " + std::to_string(head.size) + " bytes), but this is ABI " +
                               std::to_string(kAbiVersion) + " (" + std::to_string(sizeof(Manifest)) +
                               " bytes)";
  if (head.abi_version < kAbiVersion) {
    faults.push_back(versions + ": the plugin is older; build it again with this Orca");
  } else if (head.abi_version > kAbiVersion) {
    faults.push_back(
        versions +
        ": the plugin is newer; use the Orca that it was built with, or build it again with this one");
  } else if (head.size != sizeof(Manifest)) {
    faults.push_back(versions +
                     ": its headers were changed without a new version; build it again with this Orca");
  }
}

void PluginFile::check_layouts(std::vector<std::string>& faults) const {
  const auto section = elf_.section("orca_plugin_layouts");
  const std::string_view theirs =
      section ? std::string_view(reinterpret_cast<const char*>(section->data()), section->size()) : "";
  std::uint64_t hash = 0;
  const auto bytes = elf_.at_address(manifest()->address + offsetof(Manifest, layout_hash), sizeof hash);
  if (!bytes) return faults.push_back("is damaged: its manifest is not in the file");
  std::memcpy(&hash, bytes->data(), sizeof hash);
  if (std::optional<std::string> fault = layout_fault(theirs, hash, our_layouts()))
    faults.push_back(*std::move(fault));
}

void PluginFile::check_recipe(std::vector<std::string>& faults) const {
  std::vector<std::string> unique, exported;
  bool thread_exit = false;
  for (const ElfSymbol& symbol : elf_.symbols()) {
    if (symbol.defined && symbol.unique) unique.push_back(demangled(symbol.name));
    if (symbol.defined && !symbol.unique && symbol.name != kManifest)
      exported.push_back(demangled(symbol.name));
    thread_exit = thread_exit || (!symbol.defined && symbol.name.starts_with("__cxa_thread_atexit"));
  }
  if (!unique.empty())
    faults.push_back("could never be unloaded: it has symbols that are unique in the process, " +
                     shortly_listed(unique) + kRecipe);
  if (!exported.empty())
    faults.push_back(
        "exports more than its manifest, so others could bind to it: " + shortly_listed(exported) + kRecipe);
  if (thread_exit)
    faults.push_back(
        "could never be unloaded: it has a thread_local variable with a destructor (__cxa_thread_atexit); "
        "make the variable a member of the component");
  check_endings(elf_, faults);
}

std::vector<std::string> PluginFile::notes(std::string_view mark) const {
  std::vector<std::string> found;
  const auto section = elf_.section("orca_clock_notes");
  std::string_view notes =
      section ? std::string_view(reinterpret_cast<const char*>(section->data()), section->size()) : "";
  while (!notes.empty()) {
    const std::string_view one = notes.substr(0, notes.find('\0'));
    if (one.starts_with(mark)) found.emplace_back(one.substr(mark.size()));
    notes.remove_prefix(std::min(notes.size(), one.size() + 1));
  }
  return found;
}

std::vector<std::string> PluginFile::virtual_time_faults() const {
  const std::vector<std::string> steady_only = notes("steady only: ");
  std::vector<std::string> faults;
  for (const std::string& reason : steady_only)
    faults.push_back("runs with the steady clock only (--clock steady): " + reason);
  if (!faults.empty()) return faults;
  std::vector<std::string> allowed = notes("allows ");
  for (std::string& note : allowed) note = note.substr(0, note.find(": "));
  const auto judge = [&](const std::string& name, std::string_view symbol) {
    const auto use = unfit_for_virtual_time(symbol);
    if (use && std::ranges::find(allowed, name) == allowed.end())
      faults.push_back("uses " + name + ", which " + use->does + "; use " + use->instead);
  };
  for (const ElfSymbol& symbol : elf_.symbols()) {
    const std::string name = demangled(symbol.name);
    if (!symbol.defined) judge(name.substr(0, name.find('(')), symbol.name);
  }
  for (const std::string_view telltale : telltales()) judge(std::string(telltale), function_like(telltale));
  return faults;
}

std::vector<std::string_view> PluginFile::telltales() const {
  std::vector<std::string_view> found;
  const auto add = [&found](const std::vector<std::string_view>& more) {
    for (const std::string_view name : more)
      if (std::ranges::find(found, name) == found.end()) found.push_back(name);
  };
  for (const ElfFile::Bytes code : elf_.loaded_parts(true)) add(telltale_instructions(code));
  for (const ElfFile::Bytes part : elf_.loaded_parts(false)) add(telltale_paths(part));
  return found;
}

bool PluginFile::may_start_threads() const {
  return std::ranges::any_of(
      elf_.symbols(), [](const ElfSymbol& symbol) { return !symbol.defined && starts_threads(symbol.name); });
}

}  // namespace orca::plugin
