// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/layout.hpp"

#include <vector>

#include "orca/base/text.hpp"

namespace orca {
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

// Returns the fields of a layout: the text between its outermost braces, cut at the commas that no bracket
// encloses. None if it has no fields; the braces of a unit hold no colon.
std::vector<Field> fields_of(std::string_view layout) {
  const std::size_t open = layout.find('{');
  const std::size_t close = layout.rfind('}');
  if (open == std::string_view::npos || close == std::string_view::npos || close < open ||
      layout.find(':') == std::string_view::npos)
    return {};
  std::vector<Field> fields;
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

// Returns the type that a layout "NAME:PARENT{...}" extends.
std::string parent_of(std::string_view layout) {
  const std::string_view parent = field(layout.substr(0, layout.find('{'))).type;
  return parent.empty() ? "OrcaObject" : std::string(parent);
}

// A walk through both layouts up to the first difference.
class Comparison {
 public:
  explicit Comparison(const LayoutEnds& ends) : from_(ends.from), to_(ends.to) {}

  [[nodiscard]] std::string of_fields(const std::string& prefix, const std::vector<Field>& from,
                                      const std::vector<Field>& to) const {
    for (std::size_t i = 0; i < from.size() || i < to.size(); ++i) {
      if (i >= to.size()) return only(prefix, from[i], from_);
      if (i >= from.size()) return only(prefix, to[i], to_);
      if (from[i].name != to[i].name) {
        return "the field " + in_quotes(prefix + std::string(from[i].name)) + " " + from_ + " is " +
               in_quotes(prefix + std::string(to[i].name)) + " " + to_;
      }
      if (from[i].type != to[i].type)
        return of_field(prefix + std::string(from[i].name), from[i].type, to[i].type);
    }
    return "its fields differ";
  }

 private:
  static std::string only(const std::string& prefix, const Field& field, const std::string& end) {
    return "the field " + in_quotes(prefix + std::string(field.name)) + " is only " + end;
  }

  [[nodiscard]] std::string of_field(const std::string& path, std::string_view from,
                                     std::string_view to) const {
    const std::vector<Field> inner_from = fields_of(from);
    const std::vector<Field> inner_to = fields_of(to);
    if (!inner_from.empty() && !inner_to.empty() &&
        from.substr(0, from.find('{')) == to.substr(0, to.find('{')))
      return of_fields(path + ".", inner_from, inner_to);
    return "the field " + in_quotes(path) + " is " + in_quotes(from) + " " + from_ + " and " + in_quotes(to) +
           " " + to_;
  }

  std::string from_;
  std::string to_;
};

}  // namespace

std::string layout_difference(std::string_view from, std::string_view to, const LayoutEnds& ends) {
  const std::string parents[] = {parent_of(from), parent_of(to)};
  if (parents[0] != parents[1])
    return "it extends " + parents[0] + " " + std::string(ends.from) + " and " + parents[1] + " " +
           std::string(ends.to);
  return Comparison(ends).of_fields("", fields_of(from), fields_of(to));
}

}  // namespace orca
