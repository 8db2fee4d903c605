// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "component_file.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <span>

#include "orca/base/result.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/number.hpp"
#include "prolog.hpp"

namespace orca::orcactl::importing {
namespace {

using xml::Element;

constexpr double kMillimetre = 1e-3;
constexpr double kTenthOfDegree = std::numbers::pi / 1800.0;

// An element or attribute that holds a text or a number, and where that belongs.
template <class Owner>
struct Text {
  std::string_view name;
  std::string Owner::*member;
};
template <class Owner>
struct Number {
  std::string_view name;
  std::optional<double> Owner::*member;
  double unit = 1.0;  // in SI
};

constexpr std::array kTexts{
    Text<ComponentFile>{"componentName", &ComponentFile::component},
    Text<ComponentFile>{"rootContextName", &ComponentFile::context},
    Text<ComponentFile>{"library", &ComponentFile::library},
    Text<ComponentFile>{"name", &ComponentFile::robot},
    Text<ComponentFile>{"vendor", &ComponentFile::vendor},
    Text<ComponentFile>{"model", &ComponentFile::model},
};
constexpr std::array kNumbers{
    Number<ComponentFile>{"radius", &ComponentFile::radius, kMillimetre},
    Number<ComponentFile>{"bumper_radius", &ComponentFile::bumper_radius, kMillimetre},
    Number<ComponentFile>{"maxspeed", &ComponentFile::max_speed, kMillimetre},
    Number<ComponentFile>{"max_steerspeed", &ComponentFile::max_turn_rate},
    Number<ComponentFile>{"steergain", &ComponentFile::steer_gain},
    Number<ComponentFile>{"big_turnangle", &ComponentFile::big_turn_angle},
    Number<ComponentFile>{"big_turnspeed", &ComponentFile::big_turn_speed, kMillimetre},
};
constexpr std::array kRingNumbers{
    Number<Ring>{"number_of_sonars", &Ring::count},
    Number<Ring>{"dphi", &Ring::pitch, kTenthOfDegree},
    Number<Ring>{"angle_sonar0_x_axis", &Ring::first_angle, kTenthOfDegree},
    Number<Ring>{"half_lobe_angle", &Ring::half_lobe, kTenthOfDegree},
};
// Elements that only hold others.
constexpr std::array<std::string_view, 8> kFolders{"hardware", "robot",         "sensors", "actuators",
                                                   "actuator", "actuator_type", "drive",   "sensor_type"};

std::string own_text(const Element& e) { return std::string(xml::trimmed(e.text())); }

template <class Range>
auto* find(const Range& range, std::string_view name) {
  const auto found = std::ranges::find(range, name, &Range::value_type::name);
  return found == range.end() ? nullptr : &*found;
}

// The reader of one file. Elements are known by their names, whatever they are in, because the thesis's own file ends some early.
class Reader {
 public:
  explicit Reader(xml::Diagnostics& out) : out_(out) {}

  void read(const Element& e) {
    const std::string& name = e.name();
    if (const auto* text = find(kTexts, name)) {
      file_.*text->member = own_text(e);
    } else if (const auto* number = find(kNumbers, name)) {
      file_.*number->member = value(own_text(e), e.text_position(), name, number->unit);
    } else if (std::ranges::count(kFolders, name) > 0) {
      read_all(e);
    } else if (const auto way = ways().find(name); way != ways().end()) {
      (this->*way->second)(e);
    } else {
      out_.warning("I002", e.position(),
                   "the element <" + name + "> is not known; it is left out, with all that is in it");
    }
  }
  void read_all(const Element& e) {
    for (const Element& child : e.children()) read(child);
  }
  [[nodiscard]] ComponentFile take() { return std::move(file_); }

 private:
  using Way = void (Reader::*)(const Element&);
  static const std::map<std::string_view, Way>& ways() {
    static const std::map<std::string_view, Way> all{{"context", &Reader::read_context},
                                                     {"server", &Reader::read_server},
                                                     {"sensor", &Reader::read_sensor},
                                                     {"sonar-ring", &Reader::read_ring},
                                                     {"update_interval", &Reader::read_interval},
                                                     {"drive_type", &Reader::read_drive_type},
                                                     {"dspeed", &Reader::read_speed_step}};
    return all;
  }

  std::optional<double> value(const std::string& text, const xml::Position& position, const std::string& name,
                              double unit) {
    const Result<double> number = xml::parse_number(text);
    if (number) return *number * unit;
    out_.error("I004", position, name + ": " + number.error().message);
    return std::nullopt;
  }

  void without_equivalent(const xml::Position& position, const std::string& text) {
    out_.warning("I001", position, text);
  }

  void read_context(const Element& e) {
    const xml::Attribute* const name = e.attribute("name");
    without_equivalent(e.position(),
                       "the context " + in_quotes(name != nullptr ? name->value : "") +
                           " has no equivalent: ports are named COMPONENT.PORT, without contexts");
    read_all(e);
  }

  void read_server(const Element& e) {
    Service service;
    for (const Element& part : e.children())
      for (const Element& entry : part.children()) {
        const std::string text = own_text(entry);
        if (part.name() == "NameService" && entry.name() == "nsName") service.name = text;
        if (part.name() == "NameService" && entry.name() == "use") service.is_named = text != "false";
        if (part.name() == "TraderService" && entry.name() == "use" && text == "true")
          without_equivalent(
              part.position(),
              "a trader that is told of " + in_quotes(service.name) +
                  " has no equivalent: each port can be sought by its type (docs/connections.md, "
                  "\"What a port seeks\"); only more than that needs a <property>");
      }
    if (service.name.empty())
      return without_equivalent(e.position(), "a server without nsName is no port that others can name");
    file_.services.push_back(service);
  }

  Ring& ring() {
    if (file_.rings.empty()) file_.rings.emplace_back();
    return file_.rings.back();
  }

  void read_sensor(const Element& e) {
    file_.rings.emplace_back();
    if (const xml::Attribute* const id = e.attribute("id")) ring().name = id->value;
    for (const Element& child : e.children())
      if (child.name() == "vendor")
        ring().vendor = own_text(child);
      else
        read(child);
  }

  void read_ring(const Element& e) {
    for (const xml::Attribute& a : e.attributes())
      if (const auto* number = find(kRingNumbers, a.name))
        ring().*number->member = value(a.value, a.value_position, a.name, number->unit);
      else
        without_equivalent(a.position, a.name + "=" + in_quotes(a.value) +
                                           " has no equivalent: the driver knows how its device counts");
  }

  void read_interval(const Element& e) {
    ring().period = value(own_text(e), e.text_position(), e.name(), 1.0);
  }

  void read_drive_type(const Element& e) {
    if (!e.children().empty()) file_.drive = e.children().front().name();
  }

  void read_speed_step(const Element& e) {
    without_equivalent(e.position(),
                       "dspeed " + own_text(e) +
                           " has no equivalent: it does not say in which time the speed may change so much; "
                           "give max_acceleration to the driver or in the robot's file");
  }

  xml::Diagnostics& out_;
  ComponentFile file_;
};

}  // namespace

ComponentFile read_component_file(std::string text, const std::string& file_name, xml::Diagnostics& out) {
  const auto document = xml::read_text(made_strict(std::move(text), file_name, out), file_name, out);
  if (!document) return {};
  if (document->root.name() != "component") {
    out.error("I005", document->root.position(),
              "this is no component's file of the thesis: it begins with <" + document->root.name() +
                  ">, not with <component>");
    return {};
  }
  Reader reader(out);
  reader.read_all(document->root);
  ComponentFile file = reader.take();
  if (file.component.empty())
    out.error("I005", document->root.position(), "the component has no <componentName>");
  return file;
}

}  // namespace orca::orcactl::importing
