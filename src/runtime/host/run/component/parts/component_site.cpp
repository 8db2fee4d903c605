// SPDX-License-Identifier: LGPL-3.0-or-later
#include "component_site.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/host/alarm.hpp"

namespace orca::host {
namespace {

[[noreturn]] void refuse_late(const std::string& what, const std::string& name) {
  throw std::logic_error("it makes its " + what + " " + in_quotes(name) +
                         " after its constructor, too late for the graph; make it a member of the class");
}

}  // namespace

void ComponentSite::forget_code() {
  declared_.ports.clear();
  declared_.params.clear();
}

void ComponentSite::declare_port(PortDeclaration declaration) {
  if (closed_) refuse_late("port", declaration.contract.name);
  declaration.contract.name = parts_->settings.name_in_graph(declaration.contract.name);
  declared_.ports.push_back(std::move(declaration));
}

void ComponentSite::declare_param(ParamDeclaration declaration) {
  if (closed_) refuse_late("parameter", declaration.contract.name);
  declared_.params.push_back(std::move(declaration));
}

void ComponentSite::set_default_trigger(const Trigger& trigger) {
  if (trigger.kind == Trigger::Kind::period && trigger.period < std::chrono::microseconds(1))
    throw std::logic_error("its laps start every " + seconds_text(trigger.period) +
                           "; a period is 1 us or longer");
  declared_.trigger = trigger;
  for (std::string& port : declared_.trigger.ports) port = parts_->settings.name_in_graph(port);
}

RandomStream ComponentSite::random(std::string_view stream) const {
  return {parts_->run.seed, parts_->settings.name, stream};
}

void ComponentSite::write_log(log::Level level, std::string_view text) const {
  parts_->write_log(level, text);
}

std::uint64_t ComponentSite::begin_mission() {
  const std::uint64_t mission = ++parts_->run.missions;
  parts_->home.provenance.begin_mission(mission);
  return mission;
}

void ComponentSite::raise_alarm(std::string_view kind, idl::AlarmSeverity severity, std::string_view text) {
  if (!is_own_alarm_kind(kind))
    return write_log(log::Level::error,
                     in_quotes(kind) +
                         " is no kind of alarm that a component may raise: expected a word of "
                         "capitals, digits and '_' that the runtime does not use itself");
  parts_->raise_alarm(std::string(kind), severity, std::string(text));
}

void ComponentSite::clear_alarm(std::string_view kind, std::string_view text) {
  parts_->clear_alarm(std::string(kind), std::string(text));
}

std::vector<idl::Alarm> ComponentSite::take_alarms() {
  return parts_->run.reporter.alarm_news().since(heard_alarms_);
}

std::vector<idl::Alarm> ComponentSite::kept_alarms() const {
  return parts_->run.reporter.alarm_news().kept();
}

bool ComponentSite::may_set(const std::string& component, const std::string& param) const {
  return std::ranges::find(parts_->settings.may_set, component + "." + param) !=
         parts_->settings.may_set.end();
}

bool ComponentSite::may_suspend(const std::string& component) const {
  return std::ranges::find(parts_->settings.may_suspend, component) != parts_->settings.may_suspend.end();
}

// The main task of whoever runs the system looks for it. In a trial nobody does. To let another one go on needs no right.
std::uint64_t ComponentSite::order_peer(const PeerOrder& order) {
  const bool sets = order.kind == PeerOrder::Kind::set;
  const bool may = sets ? may_set(order.component, order.param)
                        : order.kind == PeerOrder::Kind::resume || may_suspend(order.component);
  const std::string what = sets ? order.component + "." + order.param : order.component;
  if (!may)
    return parts_->peer_orders->refuse(fail(
        Code::failed_precondition, "the graph gives no right to " + std::string(sets ? "set " : "suspend ") +
                                       what + "; add " + (sets ? "may_set=" : "may_suspend=") +
                                       in_quotes(what) + " to component " + in_quotes(name())));
  const std::uint64_t number = parts_->peer_orders->begin(order);
  parts_->run.changed();
  return number;
}

}  // namespace orca::host
