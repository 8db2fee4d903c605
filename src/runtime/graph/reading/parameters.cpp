// SPDX-License-Identifier: LGPL-3.0-or-later
#include "parameters.hpp"

#include <algorithm>
#include <variant>
#include <vector>

#include "codes.hpp"
#include "orca/base/text.hpp"
#include "values.hpp"

namespace orca::graph {
namespace {

void report_unknown(const Node& node, const Node& param, const Contract& contract, Report& report) {
  std::vector<std::string> names;
  for (const ParamContract& known : contract.params) names.push_back(known.name);
  const std::string name = param.value("name");
  report.error(codes::kUnknownParameter, param.place("name"),
               node.title() + ": there is no parameter " + in_quotes(name) + "; " + contract.type +
                   " has: " + listed(names) + report.hint(name, names));
}

bool names_file_here(const ParamContract& declared) {
  const auto is_relative = [](const std::string& path) { return !path.empty() && path.front() != '/'; };
  if (!declared.file) return false;
  if (const auto* const one = std::get_if<std::string>(&declared.default_value)) return is_relative(*one);
  const auto* const list = std::get_if<std::vector<std::string>>(&declared.default_value);
  return list != nullptr && std::ranges::any_of(*list, is_relative);
}

class ParamReader {
 public:
  ParamReader(const Node& node, const Contract& contract, Report& report)
      : node_(node), contract_(contract), report_(report) {
    for (const ParamContract& declared : contract.params) {
      result_.values[declared.name] = declared.default_value;
      if (names_file_here(declared)) result_.here[declared.name] = declared.default_value;
    }
  }

  ReadParams read() {
    for (const Node& child : node_.children)
      if (child.is("param")) read_one(child);
    if (some_nameless_)
      for (const ParamContract& declared : contract_.params)
        if (!named_.contains(declared.name)) result_.unread.insert(declared.name);
    return std::move(result_);
  }

 private:
  void read_one(const Node& param) {
    const std::string name = param.value("name");
    const ParamContract* declared = contract_.param(name);
    if (declared == nullptr) {
      some_nameless_ = true;
      if (param.known("name") != nullptr && param.known("value") != nullptr)
        report_unknown(node_, param, contract_, report_);
      return;
    }
    named_.insert(name);
    const Text* value = param.known("value");
    auto read = value == nullptr ? std::nullopt
                                 : read_value(*value, *declared,
                                              node_.title() + ": parameter " + in_quotes(name), report_);
    if (read) {
      result_.values[name] = std::move(*read);
    } else {
      result_.unread.insert(name);
    }
  }

  const Node& node_;
  const Contract& contract_;
  Report& report_;
  ReadParams result_;
  std::set<std::string> named_;
  bool some_nameless_ = false;  // a parameter without a name, or with one that the contract does not have
};

}  // namespace

ReadParams read_params(const Node& node, const Contract& contract, Report& report) {
  return ParamReader(node, contract, report).read();
}

const xml::Position& place_of_param(const Node& node, const std::string& param) {
  for (const Node& child : node.children)
    if (child.is("param") && child.value("name") == param) return child.place("value");
  return node.position;
}

}  // namespace orca::graph
