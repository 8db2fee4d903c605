// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/catalogue.hpp"

#include <filesystem>
#include <utility>

namespace orca {

PluginCatalogue::PluginCatalogue(PluginIndex index, ClockKind clock)
    : index_(std::move(index)), clock_(clock) {}

PluginCatalogue::~PluginCatalogue() {
  hardware_.clear();  // before the code that made it
}

Result<PluginLibrary*> PluginCatalogue::library_of(const std::string& type) {
  const Result<std::string> file = index_.file_of(type);
  if (!file) return file.error();
  std::unique_ptr<PluginLibrary>& library = libraries_[*file];
  if (library == nullptr) {
    Result<std::unique_ptr<PluginLibrary>> loaded = PluginLibrary::load(*file);
    if (!loaded) return loaded.error();
    library = std::move(loaded).value();
  }
  return library.get();
}

Result<const TypeEntry*> PluginCatalogue::find(PluginKind kind, const std::string& type) {
  const Result<PluginLibrary*> library = library_of(type);
  if (!library) return library.error();
  if (const TypeEntry* entry = (*library)->find(kind, type)) return entry;
  std::string known;
  for (const TypeEntry* entry : (*library)->types())
    known += (known.empty() ? "" : ", ") + std::string(entry->type);
  return fail(Code::not_found, "the plugin " + (*library)->path() + " has no " +
                                   (kind == PluginKind::component ? "component" : "hardware") + " type \"" +
                                   type + "\"; it has: " + known);
}

Result<Contract> PluginCatalogue::hardware(const std::string& type) {
  const Result<const TypeEntry*> entry = find(PluginKind::hardware, type);
  if (!entry) return entry.error();
  const auto described = describe_hardware(**entry, (*library_of(type))->path(), type);
  if (!described) return described.error();
  return (*described)->contract();
}

Result<DescribedHardware*> PluginCatalogue::described(const graph::HardwareUse& use) {
  const auto known = hardware_.find(use.name);
  if (known != hardware_.end()) return known->second.get();
  const Result<const TypeEntry*> entry = find(PluginKind::hardware, use.type);
  if (!entry) return entry.error();
  auto made = describe_hardware(**entry, (*library_of(use.type))->path(), use.name);
  if (!made) return made.error();
  return hardware_.emplace(use.name, std::move(made).value()).first->second.get();
}

std::vector<HardwareFault> PluginCatalogue::validate_hardware(const graph::HardwareUse& use) {
  const Result<DescribedHardware*> made = described(use);
  if (!made) return {{"", made.error().text()}};
  return (*made)->prepare(use.params);
}

Result<Contract> PluginCatalogue::component(const std::string& type, const graph::HardwareUse* hardware) {
  const Result<const TypeEntry*> entry = find(PluginKind::component, type);
  if (!entry) return entry.error();
  hw::HardwareContainer* container = nullptr;
  if (hardware != nullptr) {
    const Result<DescribedHardware*> made = described(*hardware);
    if (!made) return made.error();
    container = &(*made)->container();
  }
  return describe_component(**entry, (*library_of(type))->path(), container);
}

std::vector<std::string> PluginCatalogue::unfit(PluginKind /*kind*/, const std::string& type) {
  const Result<PluginLibrary*> library = library_of(type);
  if (clock_ == ClockKind::steady || !library) return {};
  std::vector<std::string> reasons;
  for (const std::string& fault : (*library)->virtual_time_faults())
    reasons.push_back("cannot run in virtual time: " +
                      std::filesystem::path((*library)->path()).filename().string() + " " + fault);
  return reasons;
}

std::vector<std::string> PluginCatalogue::type_names(PluginKind kind) const { return index_.types(kind); }

std::vector<std::string> PluginCatalogue::loaded_files() const {
  std::vector<std::string> files;
  for (const auto& [file, library] : libraries_)
    if (library != nullptr) files.push_back(file);
  return files;
}

}  // namespace orca
