// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/graph/graph.hpp"

namespace orca::graph {

/// One difference in a part of a graph.
struct FieldChange {
  std::string field;   ///< "type", "priority", "param stop_distance", "port motion", ...
  std::string before;  ///< As print() writes it, in SI; empty: it did not exist.
  std::string after;   ///< Empty: it does not exist any more.
  friend bool operator==(const FieldChange&, const FieldChange&) = default;
};

/// One part of a graph that was added, removed or changed.
struct Change {
  enum class Kind { added, removed, changed };
  enum class Part { graph, machine, process, hardware, component, group, connection };
  Kind kind = Kind::changed;
  Part part = Part::graph;
  std::string name;                 ///< For a connection: "avoid.motion to fuser.motion".
  std::vector<FieldChange> fields;  ///< For a changed part, sorted by field; empty for others.
  friend bool operator==(const Change&, const Change&) = default;
};

/// Returns the changes that lead from one graph to another, sorted by part and name. Only the meaning counts:
/// the order of parts, the layout of the files and the default profile, whose content is merged already,
/// do not.
/// @return nothing if both describe the same system.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<Change> diff(const Graph& before, const Graph& after);

/// Returns what a change is about, for people: "+ component goto", "~ graph".
[[nodiscard]] std::string title(const Change& change);

/// Returns one line per change, for people: "+ component goto", "  ~ param stop_distance: 0.5 -> 0.6".
[[nodiscard]] std::string diff_text(const std::vector<Change>& changes);

/// Returns the same for programs: an array of {kind, part, name, fields: [{field, before, after}]}.
[[nodiscard]] std::string diff_json(const std::vector<Change>& changes);

}  // namespace orca::graph
