// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/graph/laps.hpp"

#include <cstdio>

#include "orca/xml/document.hpp"

namespace orca::graph {
namespace {

std::string lap_text(double time) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", time);
  return text;
}

std::string measured_attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + xml::escaped(value) + "\"";
}

}  // namespace

std::string laps_text(const LapMeasurement& measurement) {
  std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<laps" +
                     measured_attribute("graph", measurement.graph) +
                     measured_attribute("processor", measurement.processor) +
                     measured_attribute("date", measurement.date) + ">\n";
  for (const MeasuredLaps& one : measurement.components) {
    std::string quantiles;
    for (const double time : one.quantiles) quantiles += (quantiles.empty() ? "" : " ") + lap_text(time);
    text += "  <component" + measured_attribute("name", one.component) +
            measured_attribute("type", one.type) + measured_attribute("laps", std::to_string(one.laps)) +
            measured_attribute("mean", lap_text(one.mean)) + "\n             " +
            measured_attribute("quantiles", quantiles) + "/>\n";
  }
  return text + "</laps>\n";
}

}  // namespace orca::graph
