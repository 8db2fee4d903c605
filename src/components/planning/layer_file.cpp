// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/planning/layer_file.hpp"

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::planning {
namespace {

using xml::AttributeRule;
using xml::ElementRule;
using xml::ValueRule;
using Kind = nav::FloorZone::Kind;

constexpr const char* kEmptyZone = "L008";
constexpr const char* kVersion = "L009";

constexpr ValueRule kText{};
constexpr ValueRule kName{.form = ValueRule::Form::name};
constexpr ValueRule kBoolean{.form = ValueRule::Form::boolean};
constexpr ValueRule kLength{
    .form = ValueRule::Form::number, .unit = "m", .min = 0.0, .max = 1000.0, .above_min = true};
constexpr ValueRule kSpeed{
    .form = ValueRule::Form::number, .unit = "m/s", .min = 0.0, .max = 10.0, .above_min = true};

constexpr AttributeRule kNamed{"name", true, "for people", kName};
constexpr AttributeRule kFrom{"from", true, "one corner, or the start of a lane: x and y", kText};
constexpr AttributeRule kTo{"to", true, "the other corner, or the end of a lane", kText};
constexpr std::array kLayerHas{kNamed, AttributeRule{"version", true, "1", kText}};
constexpr std::array kKeepOutHas{kNamed, kFrom, kTo};
constexpr std::array kSlowHas{kNamed, kFrom, kTo, AttributeRule{"speed", true, "largest", kSpeed}};
constexpr std::array kLaneHas{kNamed, kFrom, kTo, AttributeRule{"width", true, "of the lane", kLength},
                              AttributeRule{"one_way", false, "from its start to its end only", kBoolean}};
constexpr ElementRule kKeepOut{.name = "keep_out", .attributes = kKeepOutHas};
constexpr ElementRule kSlow{.name = "slow", .attributes = kSlowHas};
constexpr ElementRule kLane{.name = "lane", .attributes = kLaneHas};
constexpr std::array<const ElementRule*, 3> kZones{&kKeepOut, &kSlow, &kLane};
constexpr ElementRule kLayer{.name = "layer", .attributes = kLayerHas, .children = kZones};
constexpr std::array<const ElementRule*, 4> kElements{&kLayer, &kKeepOut, &kSlow, &kLane};
constexpr xml::FileRules kFile{"a layer", kElements, {"L002", "L002", "L003", "L004", "L006", "L005"}};

// Returns the rectangle between two corners, or along a line of some width.
std::optional<nav::FloorZone> zone_of(const xml::Attributes& element, Kind kind) {
  const auto from = element.numbers("from", 2);
  const auto to = element.numbers("to", 2);
  const auto width = kind == Kind::lane ? element.number("width") : std::optional(0.0);
  const auto speed = kind == Kind::slow ? element.number("speed") : std::optional(0.0);
  const auto one_way = element.has("one_way") ? element.text("one_way") : std::optional<std::string>("false");
  const auto name = element.name("name");
  if (!from || !to || !width || !speed || !one_way || !name) return std::nullopt;
  const Vec2 a{(*from)[0], (*from)[1]};
  const Vec2 way = Vec2{(*to)[0], (*to)[1]} - a;
  const Vec2 middle = a + 0.5 * way;
  nav::FloorZone zone{kind,
                      *name,
                      {middle.x, middle.y, 0.0},
                      0.5 * std::fabs(way.x),
                      0.5 * std::fabs(way.y),
                      *speed,
                      *one_way == "true"};
  if (kind == Kind::lane) {
    zone.middle.yaw = portable::atan2(way.y, way.x);
    zone.half_length = 0.5 * norm(way);
    zone.half_width = 0.5 * *width;
  }
  if (zone.half_length > 0.0 && zone.half_width > 0.0) return zone;
  return element.refuse_at("to", kEmptyZone,
                           "the zone has no area; \"from\" and \"to\" are opposite corners, "
                           "or the ends of a lane");
}

nav::FloorRules rules_of(const xml::Element& root, xml::Reporter& reporter) {
  const xml::Attributes layer(root, kLayer, kFile, reporter);
  if (const auto version = layer.text("version"); version && *version != "1")
    layer.error_at("version", kVersion,
                   "this Orca reads layers of version \"1\", found \"" + *version + "\"");
  std::vector<nav::FloorZone> zones;
  for (const auto& [child, rule] : layer.children()) {
    const Kind kind = rule == &kKeepOut ? Kind::keep_out : rule == &kSlow ? Kind::slow : Kind::lane;
    if (auto zone = zone_of(layer.of_child(*child, *rule), kind)) zones.push_back(std::move(*zone));
  }
  return nav::FloorRules(std::move(zones));
}

}  // namespace

Result<nav::FloorRules> read_layer(const std::string& file) {
  xml::Diagnostics diagnostics;
  xml::Reporter reporter(diagnostics);
  nav::FloorRules rules;
  if (const auto document = xml::read_file(file, diagnostics)) {
    if (document->root.name() == kLayer.name) {
      rules = rules_of(document->root, reporter);
    } else {
      reporter.error("L001", document->root.position(),
                     "the root element is <" + document->root.name() +
                         ">; a layer begins with <layer name=\"...\" version=\"1\">");
    }
  }
  if (diagnostics.has_errors()) return fail(Code::invalid_argument, diagnostics.text());
  return rules;
}

}  // namespace orca::planning
