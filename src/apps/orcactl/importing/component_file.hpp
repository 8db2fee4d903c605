// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/xml/diagnostics.hpp"

namespace orca::orcactl::importing {

/// A service that a component exports, as its file names it.
struct Service {
  std::string name;      ///< Of the port: "OdometryPush".
  bool is_named = true;  ///< Whether others find it by that name.
};

/// A ring of sonars. What the file does not say is empty.
struct Ring {
  std::string name;
  std::string vendor;
  std::optional<double> count;
  std::optional<double> pitch;        ///< [rad] From one sonar to the next.
  std::optional<double> first_angle;  ///< [rad]
  std::optional<double> half_lobe;    ///< [rad]
  std::optional<double> period;       ///< [s] From one reading to the next.
};

/// The content of a component's file of the thesis (9.5, Appendix A), in SI units. A plain value.
struct ComponentFile {
  std::string component;
  std::string context;  ///< The root of its names.
  std::vector<Service> services;
  std::string library;  ///< Of its hardware; empty: it has none.
  std::string robot;
  std::string vendor;
  std::string model;
  std::string drive;                     ///< "differential"
  std::optional<double> radius;          ///< [m]
  std::optional<double> bumper_radius;   ///< [m]
  std::optional<double> max_speed;       ///< [m/s]
  std::optional<double> max_turn_rate;   ///< [rad/s]
  std::optional<double> steer_gain;      ///< [1/s]
  std::optional<double> big_turn_angle;  ///< [rad]
  std::optional<double> big_turn_speed;  ///< [m/s]
  std::vector<Ring> rings;
};

/// Reads such a file. It may be in ISO-8859-1, name a DTD, and have end tags that close nothing, as the thesis prints it.
/// @param file_name  for the places of messages.
/// @param out        receives errors (what cannot be read) and warnings (what has no equivalent in Orca), all of them.
/// @return what could be read; of no use if there are errors.
/// @source Lengths are in mm, angles of sonars in tenths of a degree, other angles in rad, times in s: figures of the Nomad Scout in
///         Appendix A have these units.
/// @thread pure function; any thread.
[[nodiscard]] ComponentFile read_component_file(std::string text, const std::string& file_name,
                                                xml::Diagnostics& out);

/// Returns a graph with that component and its hardware, and the element `<orca>` of the robot's file as a comment.
/// @param file_name  for people.
/// @param out        receives warnings of what is left to do.
/// @thread pure function; any thread.
[[nodiscard]] std::string graph_text(const ComponentFile& file, const std::string& file_name,
                                     xml::Diagnostics& out);

}  // namespace orca::orcactl::importing
