// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/text.hpp"
#include "orca/component.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/system.hpp"
#include "orca/sim/world_file.hpp"
#include "orca/xml/names.hpp"

namespace {

/// A server that knows where the named places of a world file are, drawn ones included. Who asks for them knows names
/// only: a map of a real building can answer in its place.
class PlaceServer final : public orca::Component {
 public:
  explicit PlaceServer(orca::ComponentHost& host) : Component(host) {}

 private:
  orca::Status configure() override {
    if (world_file_->empty())
      return world_file_.refuse("it is not set; name a world, e.g. \"../sim/worlds/office.xml\"");
    orca::xml::Diagnostics diagnostics;
    std::optional<orca::sim::WorldModel> world = orca::sim::read_world(*world_file_, {}, diagnostics);
    if (diagnostics.has_errors()) return world_file_.refuse(diagnostics.sorted().front().text());
    places_ = std::move(world->places);
    return orca::ok();
  }

  // It only answers.
  orca::Outcome work() override { return orca::done(); }

  orca::Result<orca::Loan<orca::idl::GoalPoint>> on_ask(const orca::ObjectPtr<orca::idl::Ask>& ask) {
    const auto place = std::ranges::find(places_, ask->about(), &orca::sim::Place::name);
    if (place == places_.end()) return unknown(ask->about());
    auto answer = orca::make_object<orca::idl::GoalPoint>();
    answer->name() = place->name;
    answer->coordinate().point().x(place->pose.x);
    answer->coordinate().point().y(place->pose.y);
    answer->orientation().orientation().yaw(place->pose.yaw);
    return answer;
  }

  [[nodiscard]] orca::Error unknown(const std::string& name) const {
    std::vector<std::string> names;
    for (const orca::sim::Place& place : places_) names.push_back(place.name);
    return orca::fail(orca::Code::not_found,
                      orca::in_quotes(name) + " is no place of " + *world_file_ +
                          "; places: " + orca::listed(names) +
                          orca::xml::did_you_mean(orca::xml::nearest_name(name, names)));
  }

  orca::QueryServer<orca::idl::Ask, orca::idl::GoalPoint> question_{
      *this,
      "PlaceQuery",
      &PlaceServer::on_ask,
      {.text = "Where a place is: about is its name; the answer holds coordinate and orientation."}};
  orca::Param<std::string> world_file_{
      *this,
      "world",
      "",
      {.file = true,
       .fixed = true,
       .text = "World with the places: .xml, .csv or .csv.gz; FILE#7 is number 7 of those in the file."}};

  std::vector<orca::sim::Place> places_;
};

}  // namespace

ORCA_COMPONENT(PlaceServer, "orca.PlaceServer")
