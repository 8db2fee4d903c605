// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "types.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <vector>

#include "orca/base/json.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"

namespace orca::deployer {
namespace {

struct ListedType {
  std::string type;
  std::string kind;
  std::string file;
  std::string text;
};

// Returns all types, components first, object types of libraries last.
std::vector<ListedType> all_types(const plugin::PluginIndex& index) {
  std::vector<ListedType> result;
  for (const PluginKind kind : {PluginKind::component, PluginKind::hardware})
    for (const std::string& type : index.types(kind))
      result.push_back({type, kind == PluginKind::component ? "component" : "hardware",
                        index.file_of(type).value_or(""), index.text_of(type)});
  for (const auto& [type, place] : index.object_types())
    result.push_back({type, "object", place.library, place.text});
  return result;
}

}  // namespace

std::string types_text(const plugin::PluginIndex& index) {
  const std::vector<ListedType> types = all_types(index);
  std::size_t width = 0;
  for (const ListedType& listed : types) width = std::max(width, listed.type.size());
  std::ostringstream out;
  for (const ListedType& listed : types)
    out << std::left << std::setw(static_cast<int>(width)) << listed.type << "  " << std::setw(9)
        << listed.kind << "  " << listed.file << (listed.text.empty() ? "" : "  ") << printable(listed.text)
        << "\n";
  return out.str();
}

std::string types_json(const plugin::PluginIndex& index) {
  JsonWriter json;
  json.begin_array();
  for (const ListedType& listed : all_types(index)) {
    json.begin_object();
    json.member("type", listed.type);
    json.member("kind", listed.kind);
    json.member("file", listed.file);
    json.member("text", listed.text);
    json.end();
  }
  json.end();
  return json.text();
}

std::string hint_at_type(const std::string& name, const plugin::PluginIndex& index) {
  std::vector<std::string> types;
  std::vector<std::string> short_names;
  for (const ListedType& listed : all_types(index)) {
    types.push_back(listed.type);
    short_names.push_back(listed.type.substr(listed.type.rfind('.') + 1));
  }
  if (const auto near = xml::nearest_name(name, types)) return xml::did_you_mean(near);
  const auto near = xml::nearest_name(name, short_names);
  if (!near) return {};
  const auto at = std::ranges::find(short_names, *near) - short_names.begin();
  return xml::did_you_mean(types[static_cast<std::size_t>(at)]);
}

}  // namespace orca::deployer
