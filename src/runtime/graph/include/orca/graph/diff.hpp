// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/graph/graph.hpp"

namespace orca::graph {

/// One thing about a part of a graph that is not what it was.
struct FieldChange {
  std::string field;   ///< "type", "priority", "param stop_distance", "port motion", ...
  std::string before;  ///< As print() writes it, in SI; empty: it was not there.
  std::string after;   ///< Empty: it is not there any more.
  friend bool operator==(const FieldChange&, const FieldChange&) = default;
};

/// One part of a graph that was added, removed or changed.
struct Change {
  enum class Kind { added, removed, changed };
  enum class Part { graph, hardware, component, connection };
  Kind kind = Kind::changed;
  Part part = Part::graph;
  std::string name;                 ///< Of a connection: "avoid.motion to fuser.motion".
  std::vector<FieldChange> fields;  ///< Of a changed part, sorted by field; empty for others.
  friend bool operator==(const Change&, const Change&) = default;
};

/// What leads from one graph to another, by meaning: neither the order of parts counts, nor how the files
/// were written, nor the default profile, whose content is merged already. Sorted by part and name.
/// @return nothing if both describe the same system.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<Change> diff(const Graph& before, const Graph& after);

/// One line per change, for people: "+ component goto", "  ~ param stop_distance: 0.5 -> 0.6".
[[nodiscard]] std::string diff_text(const std::vector<Change>& changes);

/// The same for programs: an array of {kind, part, name, fields: [{field, before, after}]}.
[[nodiscard]] std::string diff_json(const std::vector<Change>& changes);

}  // namespace orca::graph
