// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/index.hpp"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "orca/base/input_file.hpp"
#include "orca/base/text.hpp"

namespace orca::plugin {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t kMaxBytes = 1'000'000;  // of a list of types; real ones have a hundred

// Returns what to do about the libraries of these folders that have no list of types beside them; empty if there are none. Whoever copies
// a plugin to a robot forgets the list.
std::string hint_at_lists(const std::vector<std::string>& folders) {
  std::error_code error;
  for (const std::string& folder : folders)
    for (const auto& entry : fs::directory_iterator(folder, error)) {
      const fs::path list = fs::path(entry.path()).replace_extension(".types");
      if (entry.path().extension() == ".so" && !fs::exists(list, error))
        return "; " + entry.path().string() +
               " is not looked into, since it has no list of its types beside it: copy " +
               list.filename().string() + ", too";
    }
  return {};
}

}  // namespace

void PluginIndex::add(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    folders_.push_back(folder);
    read_folder(folder);
  }
}

void PluginIndex::refresh() {
  searched_.clear();
  place_by_type_.clear();
  object_libraries_.clear();
  object_types_.clear();
  for (const std::string& folder : folders_) read_folder(folder);
}

void PluginIndex::read_folder(const std::string& folder) {
  std::error_code error;
  std::vector<fs::path> lists;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".types") lists.push_back(entry.path());
  searched_.push_back(folder + (error ? " (no such folder)" : ""));
  std::sort(lists.begin(), lists.end());
  for (fs::path list : lists) {
    std::istringstream lines(read_input_file(list.string(), kMaxBytes).value_or(""));
    const std::string file = list.replace_extension(".so").string();
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line);
      std::string kind, type, text;
      if (!(words >> kind >> type)) continue;
      std::getline(words >> std::ws, text);
      if (kind == "object")
        add_object_type(type, {file, text});
      else
        add_type(type, {kind == "hardware" ? PluginKind::hardware : PluginKind::component, file, {}, text});
    }
  }
}

void PluginIndex::add_type(const std::string& type, const Place& place) {
  const auto [known, is_new] = place_by_type_.emplace(type, place);
  const bool same_folder = fs::path(known->second.file).parent_path() == fs::path(place.file).parent_path();
  if (!is_new && same_folder && known->second.file != place.file) known->second.rival = place.file;
}

void PluginIndex::add_object_type(const std::string& type, const ObjectPlace& place) {
  object_types_.emplace(type, place);
  if (std::ranges::find(object_libraries_, place.library) == object_libraries_.end())
    object_libraries_.push_back(place.library);
}

Result<std::string> PluginIndex::file_of(const std::string& type) const {
  const auto found = place_by_type_.find(type);
  if (found != place_by_type_.end() && !found->second.rival.empty())
    return fail(Code::already_exists, "two plugins hold the type " + in_quotes(type) + ": " +
                                          found->second.file + " and " + found->second.rival +
                                          "; give one of them another type name, or remove it");
  if (found != place_by_type_.end()) return found->second.file;
  std::string places;
  for (const std::string& place : searched_) places += (places.empty() ? "" : ", ") + place;
  return fail(Code::not_found,
              "no plugin holds the type \"" + type + "\"; searched: " + places + hint_at_lists(folders_));
}

std::string PluginIndex::text_of(const std::string& type) const {
  const auto found = place_by_type_.find(type);
  return found == place_by_type_.end() ? "" : found->second.text;
}

std::vector<std::string> PluginIndex::types(PluginKind kind) const {
  std::vector<std::string> names;
  for (const auto& [type, place] : place_by_type_)
    if (place.kind == kind) names.push_back(type);
  return names;
}

}  // namespace orca::plugin
