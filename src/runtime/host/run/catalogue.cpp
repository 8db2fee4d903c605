// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/catalogue.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/hw/link/make_link.hpp"
#include "orca/plugin/object_library.hpp"
#include "orca/ros/twin.hpp"
#include "trial/rehearsal.hpp"

namespace orca::host {
namespace {

void raise_pinned(const std::string& file, const std::string& why, const AlarmSink& sink) {
  const std::string name = std::filesystem::path(file).filename().string();
  const idl::Alarm alarm = make_alarm(idl::PLUGIN_PINNED, name, "", why);
  if (sink) return sink(alarm);
  log_alarm(alarm, name);
}

}  // namespace

PluginCatalogue::PluginCatalogue(plugin::PluginIndex index, ClockKind clock)
    : index_(index), own_index_(std::move(index)), clock_(clock) {
  plugin::load_object_libraries(index_);
}

void PluginCatalogue::add_folders(const std::vector<std::string>& folders) {
  index_.add(folders);
  plugin::load_object_libraries(index_);
}

PluginCatalogue::~PluginCatalogue() { forget_answers(); }

void PluginCatalogue::forget_graph() {
  of_graph_.clear();
  forgot_graph_ = true;
  const std::lock_guard lock(mutex_);
  index_ = own_index_;
}

void PluginCatalogue::forget_answers() {
  hardware_.clear();  // before the code that made them
  of_graph_.clear();
  const std::lock_guard lock(mutex_);
  held_.clear();
}

void PluginCatalogue::expect(const std::vector<std::string>& types) {
  const std::lock_guard lock(mutex_);
  std::set<std::string> files;
  for (const std::string& type : types)
    if (const Result<std::string> file = index_.file_of(type)) files.insert(*file);
  plugin::try_together({files.begin(), files.end()});
}

const TypeEntry* PluginCatalogue::own_type(PluginKind kind, const std::string& type) const {
  for (const TypeEntry* entry : own_types_)
    if (entry->kind == kind && entry->type == type) return entry;
  return nullptr;
}

Result<std::shared_ptr<plugin::PluginLibrary>> PluginCatalogue::library_of(const std::string& type) {
  const Result<std::string> file = index_.file_of(type);
  if (!file) return file.error();
  std::weak_ptr<plugin::PluginLibrary>& known = libraries_[*file];
  if (std::shared_ptr<plugin::PluginLibrary> library = known.lock()) return library;
  Result<std::unique_ptr<plugin::PluginLibrary>> loaded = plugin::PluginLibrary::load(*file);
  if (!loaded) return loaded.error();
  std::shared_ptr<plugin::PluginLibrary> library = std::move(loaded).value();
  library->on_pinned([this, path = *file](const std::string& why) { raise_pinned(path, why, sink_); });
  known = library;
  return library;
}

Result<LoadedType> PluginCatalogue::type_in(std::shared_ptr<plugin::PluginLibrary> library, PluginKind kind,
                                            const std::string& type) {
  if (const TypeEntry* entry = library->find(kind, type)) return LoadedType{std::move(library), entry};
  std::string known;
  for (const TypeEntry* entry : library->types())
    known += (known.empty() ? "" : ", ") + std::string(entry->type) +
             (entry->kind == kind                   ? ""
              : entry->kind == PluginKind::hardware ? " (hardware)"
                                                    : " (a component)");
  return fail(Code::not_found, "the plugin " + library->path() + " has no " +
                                   (kind == PluginKind::component ? "component" : "hardware") + " type \"" +
                                   type + "\"; it has: " + known);
}

void PluginCatalogue::refresh() {
  const std::lock_guard lock(mutex_);
  index_.refresh();
  plugin::load_object_libraries(index_);
}

Result<LoadedType> PluginCatalogue::acquire(PluginKind kind, const std::string& type) {
  if (const TypeEntry* own = own_type(kind, type)) return LoadedType{nullptr, own};
  const std::lock_guard lock(mutex_);
  Result<std::shared_ptr<plugin::PluginLibrary>> library = library_of(type);
  if (!library) return library.error();
  return type_in(std::move(library).value(), kind, type);
}

Result<LoadedType> PluginCatalogue::acquire(plugin::PluginImage image, PluginKind kind,
                                            const std::string& type, plugin::Trial trial) {
  const std::lock_guard lock(mutex_);
  Result<std::unique_ptr<plugin::PluginLibrary>> library =
      plugin::PluginLibrary::load(std::move(image), trial);
  if (!library) return library.error();
  (*library)->on_pinned(
      [this, path = (*library)->path()](const std::string& why) { raise_pinned(path, why, sink_); });
  return type_in(std::move(library).value(), kind, type);
}

Status PluginCatalogue::release(LoadedType type) {
  if (!type.library) return ok();
  const std::lock_guard lock(mutex_);
  const std::string file = type.library->path();
  const std::string mapped_name = type.library->mapped_name();
  const std::weak_ptr<plugin::PluginLibrary> rest = type.library;
  type.library.reset();
  if (!rest.expired() || !plugin::is_mapped(mapped_name)) return ok();
  return fail(Code::failed_precondition,
              "PLUGIN_PINNED: nobody uses this plugin any more, but it cannot be unloaded; is it built with "
              "orca_add_component(), and do its threads end?",
              file);
}

Result<LoadedType> PluginCatalogue::find(PluginKind kind, const std::string& type) {
  Result<LoadedType> loaded = acquire(kind, type);
  if (loaded) held_[type] = *loaded;
  return loaded;
}

Result<Contract> PluginCatalogue::hardware(const std::string& type) {
  const Result<LoadedType> found = find(PluginKind::hardware, type);
  if (!found) return found.error();
  const auto described = plugin::describe_hardware(*found->entry, found->file(), type);
  if (!described) return described.error();
  return (*described)->contract();
}

Result<plugin::DescribedHardware*> PluginCatalogue::described(const graph::HardwareUse& use) {
  if (of_graph_.contains(use.name)) return hardware_.at(use.name).hardware.get();
  const Result<KnownHardware*> made = describe_anew(use);
  if (!made) return made.error();
  return (*made)->hardware.get();
}

Result<PluginCatalogue::KnownHardware*> PluginCatalogue::describe_anew(const graph::HardwareUse& use) {
  const Result<LoadedType> found = find(PluginKind::hardware, use.type);
  if (!found) return found.error();
  auto made = plugin::describe_hardware(*found->entry, found->file(), use.name);
  if (!made) return made.error();
  of_graph_.insert(use.name);
  return &(hardware_[use.name] = {found->entry, std::move(made).value()});
}

Result<PluginCatalogue::KnownHardware*> PluginCatalogue::prepared(const graph::HardwareUse& use) {
  const Result<LoadedType> found = find(PluginKind::hardware, use.type);
  const auto known = hardware_.find(use.name);
  const bool is_of_earlier_graph = known != hardware_.end() && !of_graph_.contains(use.name);
  if (found && is_of_earlier_graph && known->second.entry == found->entry &&
      known->second.params == use.params) {
    of_graph_.insert(use.name);
    return &known->second;
  }
  // A container is prepared only once: a second one of its name, which is an error, gets its own.
  const Result<KnownHardware*> made = describe_anew(use);
  if (!made) return made.error();
  (*made)->params = use.params;
  (*made)->faults = (*made)->hardware->prepare(use.params);
  return *made;
}

std::vector<HardwareFault> PluginCatalogue::validate_hardware(const graph::HardwareUse& use) {
  const Result<KnownHardware*> made = prepared(use);
  if (!made) return {{"", made.error().text()}};
  std::vector<HardwareFault> faults = (*made)->faults;
  const std::string& line = (*made)->hardware->container().line_name();
  if (clock_ == ClockKind::virtual_time && !line.empty() && !hw::link::fits_virtual_time(line))
    faults.push_back(
        {"device", "in virtual time nothing is at the other end of " + in_quotes(line) +
                       "; use emulated:NAME with an orca.hw.Emulated, replay:FILE, or --clock steady"});
  return faults;
}

std::vector<HardwareFault> PluginCatalogue::hardware_conflicts(const graph::HardwareUse& use,
                                                               const graph::HardwareUse& earlier) {
  plugin::DescribedHardware& later = *hardware_.at(use.name).hardware;
  plugin::DescribedHardware& first = *hardware_.at(earlier.name).hardware;
  const std::string& line = later.container().line_name();
  if (!line.empty() && hw::link::real_place(line) == hw::link::real_place(first.container().line_name()))
    return {{"device", "it is that of hardware " + in_quotes(earlier.name) +
                           ", too; each device has a line of its own"}};
  return use.type == earlier.type ? later.conflicts_with(first) : std::vector<HardwareFault>{};
}

Result<Contract> PluginCatalogue::component(const std::string& type, const graph::HardwareUse* hardware) {
  const Result<LoadedType> found = find(PluginKind::component, type);
  if (!found) return found.error();
  hw::HardwareSeat* seat = nullptr;
  if (hardware != nullptr) {
    const Result<plugin::DescribedHardware*> made = described(*hardware);
    if (!made) return made.error();
    seat = &(*made)->seat();
  }
  return plugin::describe_component(*found->entry, found->file(), seat);
}

std::vector<graph::ComponentFault> PluginCatalogue::try_components(const graph::Graph& graph,
                                                                   const graph::Candidates& candidates) {
  if (!std::exchange(forgot_graph_, false)) stood_ = {};
  return rehearse(graph, candidates, *this, clock_, give_up_, stood_);
}

plugin::DescribedHardware* PluginCatalogue::closed_hardware(const graph::HardwareUse& use) {
  return described(use).value_or(nullptr);
}

std::vector<std::string> PluginCatalogue::unfit(PluginKind kind, const std::string& type) {
  const Result<LoadedType> found = find(kind, type);
  if (clock_ == ClockKind::steady || !found || !found->library) return {};
  const std::string file = std::filesystem::path(found->file()).filename().string();
  std::vector<std::string> reasons;
  for (const std::string& fault : found->library->virtual_time_faults())
    reasons.push_back("cannot run in virtual time: " + file + " " + fault);
  return reasons;
}

std::vector<std::string> PluginCatalogue::messages(const std::string& object_type, bool leave) const {
  std::vector<std::string> names;
  const ObjectType* const type = find_object_type(object_type);
  const ros::Twin* const usual = type == nullptr ? nullptr
                                 : leave         ? ros::twin_to_ros(*type)
                                                 : ros::twin_from_ros(*type);
  if (usual == nullptr) return names;
  names.emplace_back(usual->message);
  for (const ros::Twin& twin : ros::twins()) {
    const ros::Twin* const found =
        leave ? ros::twin_to_ros(*type, twin.message) : ros::twin_from_ros(*type, twin.message);
    if (found != nullptr && std::ranges::find(names, twin.message) == names.end())
      names.emplace_back(twin.message);
  }
  return names;
}

std::vector<std::string> PluginCatalogue::type_names(PluginKind kind) const { return index_.types(kind); }

}  // namespace orca::host
