// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/planning/ways_file.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "orca/xml/attributes.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/reporter.hpp"

namespace orca::planning {
namespace {

using xml::AttributeRule;
using xml::ElementRule;
using xml::ValueRule;

constexpr const char* kDoubleName = "Y007";
constexpr const char* kBadLeg = "Y008";
constexpr const char* kWaysVersion = "Y009";
constexpr const char* kTooManyPoints = "Y010";
constexpr const char* kBadDoor = "Y011";

constexpr std::size_t kMostPoints = 10'000;
constexpr std::size_t kMostLegs = 100'000;
constexpr double kRounding =
    0.01;                         // [m] by which a leg may be shorter than straight, as people write numbers
constexpr double kLeast = 0.001;  // [m] that a leg costs

constexpr ValueRule kAnyText{};
constexpr ValueRule kPointName{.form = ValueRule::Form::name};
constexpr ValueRule kYesOrNo{.form = ValueRule::Form::boolean};
constexpr ValueRule kPosition{.form = ValueRule::Form::number, .unit = "m", .min = -1e5, .max = 1e5};
constexpr ValueRule kYaw{.form = ValueRule::Form::number, .unit = "rad", .min = -10.0, .max = 10.0};
constexpr ValueRule kWidth{
    .form = ValueRule::Form::number, .unit = "m", .min = 0.0, .max = 20.0, .above_min = true};
constexpr ValueRule kLegLength{
    .form = ValueRule::Form::number, .unit = "m", .min = 0.0, .max = 1e5, .above_min = true};

constexpr AttributeRule kNameOf{"name", true, "of the place, or for people", kPointName};
constexpr AttributeRule kX{"x", true, "of the place", kPosition};
constexpr AttributeRule kY{"y", true, "of the place", kPosition};
constexpr std::array kWaysHas{kNameOf, AttributeRule{"version", true, "1", kAnyText}};
constexpr std::array kPlaceHas{kNameOf, kX, kY,
                               AttributeRule{"in", true, "the room that it is in", kPointName}};
constexpr std::array kDoorHas{kNameOf,
                              kX,
                              kY,
                              AttributeRule{"yaw", true, "that leads through it", kYaw},
                              AttributeRule{"width", true, "of the opening", kWidth},
                              AttributeRule{"from", true, "the room from which its yaw leads", kPointName},
                              AttributeRule{"into", true, "the room into which its yaw leads", kPointName}};
constexpr std::array kLegHas{
    AttributeRule{"from", true, "name of a place or door", kPointName},
    AttributeRule{"to", true, "name of another one", kPointName},
    AttributeRule{"in", false, "the room that it leads through, if both ends have two in common", kPointName},
    AttributeRule{"length", false, "that a robot drives; as long as straight", kLegLength},
    AttributeRule{"one_way", false, "whether it leads to \"to\" only", kYesOrNo}};
constexpr ElementRule kPlaceElement{.name = "place", .attributes = kPlaceHas};
constexpr ElementRule kDoorElement{.name = "door", .attributes = kDoorHas};
constexpr ElementRule kLegElement{.name = "leg", .attributes = kLegHas};
constexpr std::array<const ElementRule*, 3> kInWays{&kPlaceElement, &kDoorElement, &kLegElement};
constexpr ElementRule kWaysElement{.name = "ways", .attributes = kWaysHas, .children = kInWays};
constexpr std::array<const ElementRule*, 4> kWaysElements{&kWaysElement, &kPlaceElement, &kDoorElement,
                                                          &kLegElement};
constexpr xml::FileRules kWaysFile{
    "a topological map", kWaysElements, {"Y002", "Y002", "Y003", "Y004", "Y006", "Y005"}};

/// The reader of one file; reports all its errors.
class WaysReader {
 public:
  explicit WaysReader(xml::Reporter& reporter) : reporter_(reporter) {}

  Ways read(const xml::Element& root) {
    const xml::Attributes all(root, kWaysElement, kWaysFile, reporter_);
    ways_.name = all.name("name").value_or("");
    if (const auto version = all.text("version"); version && *version != "1")
      all.error_at("version", kWaysVersion,
                   "this Orca reads topological maps of version \"1\", found \"" + *version + "\"");
    const auto children = all.children();
    for (const auto& [child, rule] : children)
      if (rule != &kLegElement) read_point(all.of_child(*child, *rule), rule == &kDoorElement);
    for (const WayPoint& point : ways_.points) names_.push_back(point.name);
    for (const auto& [child, rule] : children)
      if (rule == &kLegElement) read_leg(all.of_child(*child, *rule));
    if (ways_.points.size() > kMostPoints || ways_.legs.size() > kMostLegs)
      all.error(kTooManyPoints, "a topological map has at most 10000 places and 100000 legs");
    return std::move(ways_);
  }

 private:
  void read_point(const xml::Attributes& element, bool is_door) {
    auto point = is_door ? door_of(element) : place_of(element);
    if (!point) return;
    if (ways_.points.size() <= kMostPoints && ways_.find(point->name))
      return element.error_at(
          "name", kDoubleName,
          "there is a place or door \"" + point->name + "\" already; choose another name");
    ways_.points.push_back(std::move(*point));
  }

  static std::optional<WayPoint> place_of(const xml::Attributes& element) {
    const auto name = element.name("name");
    const auto x = element.number("x");
    const auto y = element.number("y");
    const auto in = element.name("in");
    if (!name || !x || !y || !in) return std::nullopt;
    return WayPoint{.name = *name, .place = {*x, *y}, .rooms = {*in, *in}};
  }

  static std::optional<WayPoint> door_of(const xml::Attributes& element) {
    const auto name = element.name("name");
    const auto x = element.number("x");
    const auto y = element.number("y");
    const auto yaw = element.number("yaw");
    const auto width = element.number("width");
    const auto from = element.name("from");
    const auto into = element.name("into");
    if (!name || !x || !y || !yaw || !width || !from || !into) return std::nullopt;
    if (*from == *into)
      return element.refuse_at("into", kBadDoor, "a door leads from one room into another one");
    return WayPoint{*name, {*x, *y}, Doorway{*yaw, *width}, {*from, *into}};
  }

  [[nodiscard]] std::optional<std::size_t> point_at(const xml::Attributes& leg, const char* attribute) {
    const auto name = leg.name(attribute);
    if (!name) return std::nullopt;
    if (const auto point = ways_.find(*name)) return point;
    leg.error_at(attribute, kBadLeg,
                 "there is no place or door \"" + *name + "\"" + reporter_.hint(*name, names_));
    return std::nullopt;
  }

  void read_leg(const xml::Attributes& element) {
    const auto from = point_at(element, "from");
    const auto to = point_at(element, "to");
    const auto length = element.has("length") ? element.number("length") : std::optional(0.0);
    const auto one_way =
        element.has("one_way") ? element.text("one_way") : std::optional<std::string>("false");
    if (!from || !to || !length || !one_way) return;
    if (*from == *to)
      return element.error_at("to", kBadLeg, "a leg leads to another place than it begins at");
    const double straight = norm(ways_.points[*to].place - ways_.points[*from].place);
    if (element.has("length") && *length < straight - kRounding)
      return element.error_at("length", kBadLeg,
                              "a leg cannot be shorter than straight; leave this out if it is as long");
    const auto room = room_of(element, ways_.points[*from], ways_.points[*to]);
    if (!room) return;
    ways_.legs.push_back({*from, *to, std::max({*length, straight, kLeast}), *one_way == "true",
                          side_of(ways_.points[*from], *room), side_of(ways_.points[*to], *room)});
  }

  // Returns the room that a leg leads through: that which its ends have in common.
  static std::optional<std::string> room_of(const xml::Attributes& leg, const WayPoint& from,
                                            const WayPoint& to) {
    std::vector<std::string> common;
    for (const std::string& room : from.rooms)
      if (std::ranges::find(to.rooms, room) != to.rooms.end() && (common.empty() || common.back() != room))
        common.push_back(room);
    const auto in = leg.has("in") ? leg.name("in") : std::optional(common.empty() ? "" : common.front());
    if (!in) return std::nullopt;
    if (common.empty())
      return leg.refuse_at(
          "to", kBadLeg,
          "\"" + from.name + "\" and \"" + to.name + "\" have no room in common; a leg passes no door");
    if (std::ranges::find(common, *in) == common.end())
      return leg.refuse_at("in", kBadLeg,
                           "it leads from one room to another; give the one that both ends are in");
    if (common.size() > 1 && !leg.has("in"))
      return leg.refuse_at(
          "to", kBadLeg,
          "both doors lead from \"" + common[0] + "\" to \"" + common[1] + "\"; give the attribute \"in\"");
    return in;
  }

  xml::Reporter& reporter_;
  Ways ways_;
  std::vector<std::string> names_;
};

std::optional<Ways> read_document(const std::optional<xml::Document>& document,
                                  xml::Diagnostics& diagnostics) {
  if (!document) return std::nullopt;
  xml::Reporter reporter(diagnostics);
  Ways ways;
  if (document->root.name() == kWaysElement.name) {
    ways = WaysReader(reporter).read(document->root);
  } else {
    reporter.error("Y001", document->root.position(),
                   "the root element is <" + document->root.name() +
                       ">; a topological map begins with <ways name=\"...\" version=\"1\">");
  }
  return diagnostics.has_errors() ? std::nullopt : std::optional(std::move(ways));
}

}  // namespace

Result<Ways> read_ways(const std::string& file) {
  xml::Diagnostics diagnostics;
  auto ways = read_document(xml::read_file(file, diagnostics), diagnostics);
  if (!ways) return fail(Code::invalid_argument, diagnostics.text());
  return std::move(*ways);
}

std::optional<Ways> read_ways_text(std::string_view text, const std::string& file_name,
                                   xml::Diagnostics& diagnostics) {
  return read_document(xml::read_text(text, file_name, diagnostics), diagnostics);
}

}  // namespace orca::planning
