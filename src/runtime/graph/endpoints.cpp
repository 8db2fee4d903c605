// SPDX-License-Identifier: LGPL-3.0-or-later
#include "endpoints.hpp"

#include "checks.hpp"
#include "codes.hpp"
#include "naming.hpp"
#include "orca/xml/names.hpp"

namespace orca::graph {
namespace {

std::string ports_of(const Contract& contract) {
  std::vector<std::string> in;
  std::vector<std::string> out;
  for (const PortContract& port : contract.ports) (is_from_end(port) ? out : in).push_back(port.name);
  if (in.empty() && out.empty()) return "no ports";
  std::string result;
  if (!in.empty()) result = "in: " + xml::listed(in);
  if (!out.empty()) result += (result.empty() ? "out: " : "; out: ") + xml::listed(out);
  return result;
}

void report_bad_form(const Node& connection, const char* attribute, const Model& model, Report& report) {
  const Text& text = *connection.find(attribute);
  const CheckedComponent* component = model.component(text.value);
  std::string message =
      std::string(attribute) + ": " + in_quotes(text.value) + " is no port: write component.port";
  if (component != nullptr && component->contract && component->ports_known) {
    message += "; " + in_quotes(text.value) + " has " + ports_of(*component->contract);
  }
  report.error(codes::kBadPort, text.position, message);
}

void find_port(Endpoint& end, const CheckedComponent& component, const xml::Position& place, Report& report) {
  const Contract& contract = *component.contract;
  end.port = contract.port(end.ref.port);
  if (end.port != nullptr) return;
  std::vector<std::string> names;
  for (const PortContract& port : contract.ports) names.push_back(port.name);
  end.guessed = report.nearest(end.ref.port, names);
  report.error(codes::kUnknownPort, place,
               "component " + in_quotes(end.ref.component) + ": port " + in_quotes(end.ref.port) +
                   " does not exist; " + in_quotes(end.ref.component) + " has " + ports_of(contract) +
                   xml::did_you_mean(end.guessed));
}

}  // namespace

Endpoint resolve_endpoint(const Node& connection, const char* attribute, const Model& model, Report& report) {
  Endpoint end;
  const Text* text = connection.known(attribute);
  if (text == nullptr) return end;
  const std::size_t dot = text->value.rfind('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == text->value.size()) {
    report_bad_form(connection, attribute, model, report);
    return end;
  }
  end.ref = {text->value.substr(0, dot), text->value.substr(dot + 1)};
  if (!check_component_exists(end.ref.component, text->position, in_quotes(text->value), model, report))
    return end;
  const CheckedComponent& component = *model.component(end.ref.component);
  if (component.contract && component.ports_known) find_port(end, component, text->position, report);
  return end;
}

bool is_from_end(const PortContract& port) {
  return (port.pattern == Pattern::push) == (port.role == Role::server);
}

std::string described(const PortContract& port) {
  const std::string what =
      std::string(to_string(port.pattern)) + to_string(port.role) + " of " + port.type.name;
  return port.reply ? what + " answered by " + port.reply->name : what;
}

std::string described(const Endpoint& end) {
  return in_quotes(end.ref.text()) + " (" + described(*end.port) + ")";
}

}  // namespace orca::graph
