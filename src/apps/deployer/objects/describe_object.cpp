// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "describe_object.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>
#include <string_view>

#include "orca/base/json.hpp"
#include "orca/idl/object_library.hpp"

namespace orca::deployer {
namespace {

struct Field {
  std::string name;
  std::string kind;
  std::string unit;
};

// Cuts what stands between the outermost braces of a layout at the commas that no bracket encloses.
std::vector<std::string_view> parts_of(std::string_view layout) {
  std::vector<std::string_view> parts;
  int depth = 0;
  std::size_t start = layout.find('{') + 1;
  for (std::size_t i = start; i < layout.size(); ++i) {
    const char c = layout[i];
    if (depth == 0 && (c == ',' || c == '}')) {
      parts.push_back(layout.substr(start, i - start));
      start = i + 1;
    }
    depth += c == '{' || c == '(' || c == '<' ? 1 : c == '}' || c == ')' || c == '>' ? -1 : 0;
  }
  return parts;
}

// "sequence<my.Spot{...}>" becomes "sequence<my.Spot>".
std::string without_braces(std::string_view kind) {
  std::string text;
  int depth = 0;
  for (const char c : kind) {
    if (c == '{') ++depth;
    if (depth == 0) text += c;
    if (c == '}') --depth;
  }
  return text;
}

Field field_in(std::string_view part) {
  const std::size_t colon = part.find(':');
  const std::size_t unit = part.rfind(" {");
  const bool has_unit = unit != std::string_view::npos && part.find('}', unit) == part.size() - 1;
  Field field{std::string(part.substr(0, colon)), {}, {}};
  if (has_unit) field.unit = part.substr(unit + 2, part.size() - unit - 3);
  field.kind = without_braces(part.substr(colon + 1, has_unit ? unit - colon - 1 : part.npos));
  return field;
}

std::vector<Field> fields_of(const ObjectType& type) {
  std::vector<Field> fields;
  const std::size_t header = parts_of(detail::part_layout("OrcaObject")).size();
  for (const std::string_view part : parts_of(type.layout)) fields.push_back(field_in(part));
  fields.erase(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(std::min(header, fields.size())));
  return fields;
}

std::string hash_text(const ObjectType& type) {
  std::ostringstream out;
  out << std::hex << std::setw(16) << std::setfill('0') << type.layout_hash;
  return out.str();
}

}  // namespace

std::string objects_text(const std::vector<const ObjectType*>& types, const std::string& library) {
  std::ostringstream out;
  for (const ObjectType* const type : types) {
    out << type->name << "#" << hash_text(*type) << "  (object";
    if (type->parent != nullptr) out << ", a " << type->parent->name;
    out << (library.empty() ? "" : ", " + library) << ")\n";
    std::size_t width = 0;
    const std::vector<Field> fields = fields_of(*type);
    for (const Field& field : fields) width = std::max(width, field.name.size());
    for (const Field& field : fields)
      out << "    " << std::left << std::setw(static_cast<int>(width)) << field.name << "  " << field.kind
          << (field.unit.empty() ? "" : " [" + field.unit + "]") << "\n";
  }
  return out.str();
}

std::string objects_json(const std::vector<const ObjectType*>& types, const std::string& library) {
  JsonWriter json;
  json.begin_object();
  json.member("file", library);
  json.key("types").begin_array();
  for (const ObjectType* const type : types) {
    json.begin_object();
    json.member("type", type->name);
    json.member("kind", "object");
    json.member("parent", type->parent != nullptr ? type->parent->name : "");
    json.member("hash", hash_text(*type));
    json.key("fields").begin_array();
    for (const Field& field : fields_of(*type)) {
      json.begin_object();
      json.member("name", field.name);
      json.member("kind", field.kind);
      json.member("unit", field.unit);
      json.end();
    }
    json.end();
    json.end();
  }
  json.end();
  json.end();
  return json.text();
}

}  // namespace orca::deployer
