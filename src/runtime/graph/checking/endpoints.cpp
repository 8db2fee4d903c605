// SPDX-License-Identifier: LGPL-3.0-or-later
#include "endpoints.hpp"

#include "orca/base/text.hpp"
#include "orca/xml/names.hpp"
#include "ports.hpp"
#include "reading/codes.hpp"
#include "reading/command_line.hpp"

namespace orca::graph {
namespace {

// A name that should be that of a port.
struct WrittenPort {
  const std::string& name;
  const xml::Position& place;
  std::string title;      // of the attribute or option that names it
  std::string component;  // its component as a message begins with it
};

void report_bad_form(const WrittenPort& written, const Model& model, Report& report) {
  const CheckedComponent* component = model.component(written.name);
  std::string message = written.title + ": " + in_quotes(written.name) + " is no port: write component.port";
  if (component != nullptr && component->contract && component->ports_known) {
    message += "; " + in_quotes(written.name) + " has " + ports_of(*component->contract);
  }
  report.error(codes::kBadPort, written.place, message);
}

// Reports that the graph has disabled or renamed the port; returns false if it has not.
bool report_changed_port(Endpoint& end, const CheckedComponent& component, const xml::Position& place,
                         Report& report) {
  const std::string port = "component " + in_quotes(end.ref.component) + ": port " + in_quotes(end.ref.port);
  if (const auto off = component.disabled.find(end.ref.port); off != component.disabled.end()) {
    report.error(codes::kPortDisabled, place,
                 port + " is disabled at " + off->second.text() + "; enable it there to connect it");
    return true;
  }
  const auto renaming = component.renamed.find(end.ref.port);
  if (renaming == component.renamed.end()) return false;
  const auto& [name, where] = renaming->second;
  report.error(codes::kUnknownPort, place,
               port + " is called " + in_quotes(name) + " in this graph, see " + where.text() + "; write " +
                   in_quotes(end.ref.component + "." + name));
  end.guessed = name;
  return true;
}

void find_port(Endpoint& end, const CheckedComponent& component, const xml::Position& place, Report& report) {
  const Contract& contract = *component.contract;
  const PortContract* const refused = component.refused_port(end.ref.port);
  end.port = contract.port(end.ref.port);
  if (end.port != nullptr) {
    end.perhaps = refused;
  } else if (refused != nullptr) {
    end.ref.port = refused->name;
    end.port = refused;
  }
  if (end.port != nullptr || report_changed_port(end, component, place, report)) return;
  if (component.refused_names.contains(end.ref.port))
    return;  // of a port that does not exist, which is reported
  std::vector<std::string> names;
  for (const PortContract& port : contract.ports) names.push_back(port.name);
  end.guessed = report.nearest(end.ref.port, names);
  report.error(codes::kUnknownPort, place,
               "component " + in_quotes(end.ref.component) + ": port " + in_quotes(end.ref.port) +
                   " does not exist; " + in_quotes(end.ref.component) + " has " + ports_of(contract) +
                   xml::did_you_mean(end.guessed));
}

Endpoint resolve(const WrittenPort& written, const Model& model, Report& report) {
  Endpoint end;
  const std::size_t dot = written.name.rfind('.');
  if (dot == std::string::npos || dot == 0 || dot + 1 == written.name.size()) {
    report_bad_form(written, model, report);
    return end;
  }
  end.ref = {written.name.substr(0, dot), written.name.substr(dot + 1)};
  if (!check_component_exists(end.ref.component, written.place, written.component, model, report)) return end;
  const CheckedComponent& component = *model.component(end.ref.component);
  if (component.contract && component.ports_known) find_port(end, component, written.place, report);
  return end;
}

}  // namespace

Endpoint resolve_endpoint(const Node& connection, const char* attribute, const Model& model, Report& report) {
  const Text* text = connection.known(attribute);
  if (text == nullptr) return {};
  return resolve({text->value, text->position, attribute, in_quotes(text->value)}, model, report);
}

void check_recorded_port(const std::string& name, const Model& model, Report& report) {
  (void)resolve({name, command_line(), "--record", shown_option("--record", name)}, model, report);
}

bool is_from_end(const PortContract& port) {
  return (port.pattern == Pattern::push) == (port.role == Role::server);
}

bool fit_together(const PortContract& a, const PortContract& b) {
  if (a.pattern != b.pattern || a.role == b.role) return false;
  return is_from_end(a) ? is_a(a.type, b.type) : is_a(b.type, a.type);
}

std::string described(const Endpoint& end) {
  return in_quotes(end.ref.text()) + " (" + described(*end.port) + ")";
}

}  // namespace orca::graph
