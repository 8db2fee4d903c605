// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "map_saving.hpp"

#include <algorithm>
#include <cstdio>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "asking.hpp"
#include "client.hpp"
#include "mapping/rooms.hpp"
#include "offering.hpp"
#include "orca/base/text.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/system.hpp"
#include "orca/maps/map_file.hpp"
#include "table.hpp"

namespace orca::orcactl {
namespace {

// The port that serves the map, unless the command names it.
Result<std::string> port_of(Client& client) {
  std::vector<std::string> ports;
  for (const std::string& port : names_of(client, "names", "port"))
    if (port.ends_with(".OccupancyGridQuery")) ports.push_back(port);
  if (ports.size() == 1) return ports.front();
  if (ports.empty())
    return fail(Code::not_found,
                "no part of the system has a port OccupancyGridQuery; name the port that answers with a map: "
                "orcactl map "
                "save NAME PORT");
  return fail(Code::invalid_argument, "several parts of the system have a map: " + listed(ports) +
                                          "; name one: orcactl map save NAME PORT");
}

Result<ObjectPtr<idl::OccupancyGrid>> fetch(Client& client, const std::string& port, Duration limit) {
  Result<ObjectLoan> reply = ask_port(client, port, make_object(object_type<idl::Ask>()), limit);
  if (!reply) return reply.error();
  const std::string type(reply->type().name);
  ObjectPtr<idl::OccupancyGrid> map = object_cast<idl::OccupancyGrid>(std::move(*reply).seal());
  if (!map)
    return fail(Code::invalid_argument, port + " answers with " + type + ", not with an OccupancyGrid");
  return map;
}

std::size_t percent_known(const idl::OccupancyGrid& map) {
  const auto unknown =
      static_cast<std::size_t>(std::ranges::count_if(map.cells(), [](int cell) { return cell > 100; }));
  return 100 * (map.cells().size() - unknown) / std::max<std::size_t>(1, map.cells().size());
}

Status save(Client& client, const apps::Call& call) {
  const std::string& name = call.words[1];
  const Result<std::string> port =
      call.words.size() > 2 ? Result<std::string>(call.words[2]) : port_of(client);
  if (!port) return port.error();
  const auto map = fetch(client, *port, call.duration("--timeout").value_or(kAnswerLimit));
  if (!map) return map.error();
  if (Status written = maps::write_map(**map, name); !written.ok()) return written;
  std::fprintf(stderr, "orcactl: %s: %u x %u cells of %g m, %zu %% of them known\n", printable(name).c_str(),
               (*map)->columns(), (*map)->rows(), (*map)->resolution(), percent_known(**map));
  return ok();
}

bool is_name(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const auto fits = [&](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_'; };
  return !text.empty() && is_letter(text.front()) && std::ranges::all_of(text, fits);
}

// Prints the topological map that the rooms of a map suggest.
Status propose_ways(const apps::Call& call) {
  if (call.words.size() > 2)
    return fail(Code::invalid_argument, "map ways takes a map's file only: orcactl map ways office.yaml");
  const Result<idl::OccupancyGrid> map = maps::read_map(call.words[1]);
  if (!map) return map.error();
  const Pose2 X_WM{0.0, 0.0, map->corner().orientation()};
  nav::FloorGrid grid;
  grid.lattice = {seen_from(X_WM, Vec2{map->corner().x(), map->corner().y()}), map->resolution(),
                  static_cast<int>(map->columns()), static_cast<int>(map->rows())};
  grid.cells.assign(map->cells().begin(), map->cells().end());
  const Result<mapping::Division> division = mapping::divide(grid);
  if (!division) return division.error();
  if (division->passages.empty())
    return fail(Code::not_found, "no doors found in " + call.words[1] +
                                     ": its free floor has no opening from 0.5 m to 1.3 m between two rooms "
                                     "of more than 1 m2; look whether the resolution of the map is right, or "
                                     "write the doors by hand (README "
                                     "of RouteServer)");
  print(mapping::ways_text(*division, X_WM, is_name(map->name()) ? map->name() : "ways"));
  return ok();
}

}  // namespace

ExitCode handle_map(const apps::Call& call) {
  if (call.words.front() == "ways") {
    const Status proposed = propose_ways(call);
    return proposed.ok() ? ExitCode::done : report({proposed.error()});
  }
  if (call.words.front() != "save")
    return report(
        {fail(Code::invalid_argument, "map expects save or ways, not " + in_quotes(call.words.front())),
         ExitCode::usage});
  std::variant<Client, Failure> connected = Client::connect(call);
  if (auto* const failure = std::get_if<Failure>(&connected)) return report(*failure);
  const Status saved = save(std::get<Client>(connected), call);
  return saved.ok() ? ExitCode::done : report({saved.error()});
}

}  // namespace orca::orcactl
