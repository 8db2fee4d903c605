// SPDX-License-Identifier: GPL-3.0-or-later
#include "hosted/recollection.hpp"

#include <catch2/catch.hpp>

#include "orca/idl/object_type.hpp"

using namespace orca;
using namespace orca::supervisor;

namespace {

idl::Alarm alarm(idl::AlarmKind kind, const std::string& source) {
  idl::Alarm alarm;
  alarm.kind(kind);
  alarm.source(source);
  alarm.active(true);
  return alarm;
}

AlarmReport report_of(const idl::Alarm& alarm) {
  AlarmReport report;
  object_type<idl::Alarm>().serialize(&alarm, report.object);
  return report;
}

const Standing& standing_of(const std::vector<Report>& reports) {
  REQUIRE(std::holds_alternative<Standing>(reports.back()));
  return std::get<Standing>(reports.back());
}

}  // namespace

TEST_CASE("the next supervisor hears the last state of everything", "[supervisor][adoption]") {
  Recollection all("base");
  CHECK(all.note_state(Built{{{"scout", "Dewey"}}, {{"orca.Goto", "b1"}}}));
  CHECK(all.note_state(StateChange{"goto", 3, "", true, false, false}));
  CHECK(all.note_state(StateChange{"goto", 4, "no way", true, true, false}));
  CHECK(all.note_state(RestChange{false}));
  CHECK_FALSE(all.note_state(Logged{}));
  const std::vector<Report> reports = all.reports();
  REQUIRE(reports.size() == 4);
  CHECK(std::get<Built>(reports[0]).robots == Pairs{{"scout", "Dewey"}});
  CHECK(std::get<Built>(reports[0]).builds == Pairs{{"orca.Goto", "b1"}});
  CHECK(std::get<StateChange>(reports[1]).failure == "no way");
  CHECK_FALSE(std::get<RestChange>(reports[2]).at_rest);
  CHECK(standing_of(reports).alarms.empty());
}

TEST_CASE("the next supervisor hears which code was exchanged, and how often", "[supervisor][adoption]") {
  Recollection all("base");
  CHECK(all.note_state(ExchangedCode{"avoid", "orca.VfhPlus", "/a/vfh_plus.so", "b2", 1}));
  all.note_params("avoid", {{"clearance", "0.1 m"}});
  CHECK(all.note_state(ExchangedCode{"avoid", "orca.LaserAvoid", "/a/laser_avoid.so", "b3", 2}));
  const std::vector<Report> reports = all.reports();
  const auto* const code = std::get_if<ExchangedCode>(&reports.front());
  REQUIRE(code != nullptr);
  CHECK(code->type == "orca.LaserAvoid");
  CHECK(code->file == "/a/laser_avoid.so");
  CHECK(code->swaps == 2);
  CHECK(
      std::get<Standing>(reports.back()).params.empty());  // the old code's: the new one's are in the report
}

TEST_CASE("alarms stand until they are acknowledged, whoever has raised them", "[supervisor][adoption]") {
  Recollection all("base");
  all.note_told(report_of(alarm(idl::FAILED, "avoid")));
  all.note_alarm(alarm(idl::PROCESS_ENDED, ""), "brain");
  all.note_alarm(alarm(idl::GAVE_UP, ""), "");
  REQUIRE(standing_of(all.reports()).alarms.size() == 3);
  CHECK(standing_of(all.reports()).alarms[0].first == "base");
  CHECK(standing_of(all.reports()).alarms[1].first == "brain");
  all.forget_alarm({"FAILED", "avoid", "brain"});  // another one
  CHECK(standing_of(all.reports()).alarms.size() == 3);
  all.forget_alarm({"FAILED", "avoid", "base"});
  all.forget_alarm({"GAVE_UP", "", ""});
  REQUIRE(standing_of(all.reports()).alarms.size() == 1);
  idl::Alarm left;
  REQUIRE(object_type<idl::Alarm>().deserialize(standing_of(all.reports()).alarms[0].second, &left).ok());
  CHECK(left.kind() == idl::PROCESS_ENDED);
}

TEST_CASE("held motors and changed parameters are known to the next supervisor", "[supervisor][adoption]") {
  Recollection all("base");
  CHECK_FALSE(standing_of(all.reports()).motors_held);
  all.note_held(true);
  all.note_params("avoid", {{"stop_distance", "0.5 m"}, {"speed", "1"}});
  all.note_params("avoid", {{"stop_distance", "0.7 m"}});
  const std::vector<Report> reports = all.reports();
  CHECK(standing_of(reports).motors_held);
  REQUIRE(standing_of(reports).params.size() == 1);
  CHECK(standing_of(reports).params[0].second == Pairs{{"speed", "1"}, {"stop_distance", "0.7 m"}});
  all.note_held(false);
  CHECK_FALSE(standing_of(all.reports()).motors_held);
}
