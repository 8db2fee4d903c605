// SPDX-License-Identifier: LGPL-3.0-or-later
#include "laps.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>

#include "codes.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/document.hpp"
#include "values.hpp"

namespace orca::graph {
namespace {

using xml::AttributeRule;
using xml::Attributes;
using xml::ElementRule;
using xml::ValueRule;

constexpr double kLongestLap = 86400.0;  // [s]
constexpr ValueRule kTime{.form = ValueRule::Form::number, .unit = "s", .min = 0.0, .max = kLongestLap};

constexpr std::array kMeasured{
    AttributeRule{"name", true, "Name of the component in the graph that was measured."},
    AttributeRule{"type", false, "Its type."}, AttributeRule{"laps", false, "Number of laps."},
    AttributeRule{"mean", false, "Their mean processor time, in seconds."},
    AttributeRule{"quantiles", true,
                  "The shortest, the 5 % quantile and so on up to the longest, in seconds."}};
constexpr std::array kLaps{AttributeRule{"graph", false, "Name of the graph."},
                           AttributeRule{"processor", false, "What was computed with."},
                           AttributeRule{"date", false, "When it was measured."}};
constexpr ElementRule kMeasuredRule{
    .name = "component", .attributes = kMeasured, .text = "The laps of one component."};
constexpr std::array kInLaps{&kMeasuredRule};
constexpr ElementRule kLapsRule{
    .name = "laps", .attributes = kLaps, .children = kInLaps, .text = "The laps of a graph's components."};
constexpr std::array kLapElements{&kLapsRule, &kMeasuredRule};
constexpr xml::FileRules kLapsFile{"a measurement of laps",
                                   kLapElements,
                                   {.unknown_element = codes::kUnknownElement,
                                    .misplaced_element = codes::kMisplacedElement,
                                    .unknown_attribute = codes::kUnknownAttribute,
                                    .missing_attribute = codes::kMissingAttribute,
                                    .stray_text = codes::kStrayText,
                                    .bad_value = codes::kBadValue,
                                    .wrong_unit = codes::kUnit,
                                    .out_of_range = codes::kRange,
                                    .unknown_choice = codes::kChoice}};

// Returns whether a text is meant as a time. The name of a file that begins like a number needs "./" before it.
bool is_number(const std::string& text) {
  const auto is_digit = [&](std::size_t i) {
    return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])) != 0;
  };
  return text.empty() || is_digit(0) || text[0] == '+' || text[0] == '-' || (text[0] == '.' && is_digit(1));
}

std::string name_in_its_graph(const std::string& name) { return name.substr(name.rfind('/') + 1); }

// The search in one measurement for one component.
class LapSearch {
 public:
  LapSearch(const Node& component, const Text& text, Report& report)
      : component_(component), text_(text), report_(report) {}

  LapTime run() {
    LapTime time{resolved_path(text_.value, text_), {}};
    const auto document = xml::read_file(time.file, report_.diagnostics());
    if (!document) return {};
    const xml::Element& root = document->root;
    if (root.name() != kLapsRule.name) {
      report_.error(codes::kWrongRoot, root.position(),
                    "this is <" + root.name() + ">, not <laps>, which deployer --measure-laps FILE writes");
      return {};
    }
    const Attributes laps(root, kLapsRule, kLapsFile, report_);
    for (const auto& [element, rule] : laps.children()) look_at(laps.of_child(*element, *rule), time);
    if (found_) return time;
    report_.error(codes::kBadValue, text_.position,
                  component_.title() + ": takes: " + time.file + " holds no laps of it; it has those of: " +
                      listed(names_) + "; measure them with deployer --measure-laps FILE");
    return {};
  }

 private:
  // A measurement of the whole system goes before one of the graph that is used in it.
  void look_at(const Attributes& measured, LapTime& time) {
    const std::string name = measured.text("name").value_or("");
    names_.push_back(name);
    const std::string wanted = component_.value("name");
    const bool is_whole = name == wanted;
    if (!is_whole && (found_ || name != name_in_its_graph(wanted))) return;
    const auto quantiles = measured.bare_numbers("quantiles", kLapQuantiles);
    if (quantiles) check(measured, *quantiles);
    if (quantiles) time.quantiles = *quantiles;
    found_ = true;
  }

  static void check(const Attributes& measured, const std::vector<double>& quantiles) {
    if (quantiles.front() < 0.0 || quantiles.back() > kLongestLap || !std::ranges::is_sorted(quantiles))
      measured.error_at("quantiles", codes::kRange,
                        "quantiles are times in seconds, none below 0 or below the one before it");
  }

  const Node& component_;
  const Text& text_;
  Report& report_;
  std::vector<std::string> names_;
  bool found_ = false;
};

}  // namespace

LapTime read_lap_time(const Node& component, Report& report) {
  const Text* const text = component.known("takes");
  if (text == nullptr) return {};
  if (!is_number(text->value)) return LapSearch(component, *text, report).run();
  const auto seconds = read_value(*text, kTime, component.title() + ": takes", report);
  if (!seconds || std::get<double>(*seconds) == 0.0) return {};
  return {{}, {std::get<double>(*seconds)}};
}

}  // namespace orca::graph
