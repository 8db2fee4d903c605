// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plugin_layouts.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <vector>

#include "orca/base/hash.hpp"
#include "orca/component/generated/plugin_layouts.hpp"

namespace orca::plugin {
namespace {

constexpr const char* kRemedy = "; build it again with this Orca";
constexpr std::size_t kMostNamed = 4;

using Hashes = std::map<std::string_view, std::string_view>;  // by type, both as written

Hashes read(std::string_view layouts) {
  Hashes hashes;
  while (!layouts.empty()) {
    const std::string_view line = layouts.substr(0, layouts.find('\0'));
    layouts.remove_prefix(std::min(layouts.size(), line.size() + 1));
    const auto blank = line.rfind(' ');
    if (blank != std::string_view::npos) hashes.emplace(line.substr(0, blank), line.substr(blank + 1));
  }
  return hashes;
}

std::string difference(std::string_view type, std::string_view theirs, const std::string& ours) {
  return std::string(type) + " (" + std::string(theirs) + " in the plugin, " + ours + " in this Orca)";
}

std::vector<std::string> differences_between(const Hashes& theirs, const Hashes& ours) {
  std::vector<std::string> differences;
  for (const auto& [type, built_for] : theirs) {
    const auto same = ours.find(type);
    if (same == ours.end()) {
      differences.push_back(difference(type, built_for, "none"));
    } else if (same->second != built_for) {
      differences.push_back(difference(type, built_for, std::string(same->second)));
    }
  }
  return differences;
}

std::string listed(const std::vector<std::string>& differences) {
  std::string all;
  for (std::size_t i = 0; i < differences.size() && i < kMostNamed; ++i)
    all += (i == 0 ? "" : ", ") + differences[i];
  if (differences.size() > kMostNamed)
    all += " and " + std::to_string(differences.size() - kMostNamed) + " more";
  return all;
}

}  // namespace

// Without the zero that ends the array, after that of the last line.
std::string_view our_layouts() { return {detail::plugin_layouts.data(), detail::plugin_layouts.size() - 1}; }

std::uint64_t hash_of_layouts(std::string_view layouts) {
  Fnv1a sum;
  sum.add(std::as_bytes(std::span(layouts)));
  return sum.value();
}

std::optional<std::string> layout_fault(std::string_view theirs, std::optional<std::uint64_t> hash,
                                        std::string_view ours) {
  if (theirs.ends_with(std::string_view("\0\0", 2))) theirs.remove_suffix(1);  // of the array
  if (theirs.find(' ') == std::string_view::npos)
    return std::string("does not say for which layouts it was built: it has no section orca_plugin_layouts") +
           "; build it with orca_add_component()";
  if (hash && hash_of_layouts(theirs) != *hash)
    return "is damaged: its list of layouts does not have the hash that its manifest gives; build it again";
  if (theirs == ours) return std::nullopt;
  const std::vector<std::string> differences = differences_between(read(theirs), read(ours));
  if (differences.empty()) return std::nullopt;
  return "was built for other layouts of what crosses the plugin boundary: " + listed(differences) + kRemedy;
}

}  // namespace orca::plugin
