// SPDX-License-Identifier: LGPL-3.0-or-later
#include "layout.hpp"

#include <vector>

namespace orca::graph {
namespace {

struct Field {
  std::string_view name;
  std::string_view type;
};

Field field(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {text, ""};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

// The fields of a layout that holds any: what is between its outermost braces, cut at the commas that no
// bracket encloses. A unit's braces hold no colon.
std::vector<Field> fields_of(std::string_view layout) {
  std::vector<Field> fields;
  const std::size_t open = layout.find('{');
  const std::size_t close = layout.rfind('}');
  if (open == std::string_view::npos || layout.find(':') == std::string_view::npos) return fields;
  int depth = 0;
  std::size_t start = open + 1;
  for (std::size_t i = start; i <= close; ++i) {
    const char c = layout[i];
    if (i == close || (c == ',' && depth == 0)) {
      fields.push_back(field(layout.substr(start, i - start)));
      start = i + 1;
    }
    depth += c == '{' || c == '(' || c == '<' ? 1 : c == '}' || c == ')' || c == '>' ? -1 : 0;
  }
  return fields;
}

std::string quoted(std::string_view text) { return '"' + std::string(text) + '"'; }

std::string difference_of_field(const std::string& path, std::string_view from, std::string_view to);

std::string difference_of_fields(const std::string& prefix, const std::vector<Field>& from,
                                 const std::vector<Field>& to) {
  for (std::size_t i = 0; i < from.size() || i < to.size(); ++i) {
    if (i >= to.size())
      return "the field " + quoted(prefix + std::string(from[i].name)) + " is only at the from end";
    if (i >= from.size())
      return "the field " + quoted(prefix + std::string(to[i].name)) + " is only at the to end";
    if (from[i].name != to[i].name) {
      return "the field " + quoted(prefix + std::string(from[i].name)) + " at the from end is " +
             quoted(prefix + std::string(to[i].name)) + " at the to end";
    }
    if (from[i].type != to[i].type)
      return difference_of_field(prefix + std::string(from[i].name), from[i].type, to[i].type);
  }
  return "its fields differ";
}

std::string difference_of_field(const std::string& path, std::string_view from, std::string_view to) {
  const std::vector<Field> inner_from = fields_of(from);
  const std::vector<Field> inner_to = fields_of(to);
  if (!inner_from.empty() && !inner_to.empty() &&
      from.substr(0, from.find('{')) == to.substr(0, to.find('{')))
    return difference_of_fields(path + ".", inner_from, inner_to);
  return "the field " + quoted(path) + " is " + quoted(from) + " at the from end and " + quoted(to) +
         " at the to end";
}

}  // namespace

std::string layout_difference(std::string_view from, std::string_view to) {
  return difference_of_fields("", fields_of(from), fields_of(to));
}

}  // namespace orca::graph
