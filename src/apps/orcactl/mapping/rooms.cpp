// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "rooms.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <map>
#include <numbers>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

#include "orca/base/portable_math.hpp"
#include "orca/navigation/distance_transform.hpp"
#include "orca/navigation/grid_search.hpp"

namespace orca::orcactl::mapping {
namespace {

using nav::Cell;
using nav::FloorGrid;
using nav::Lattice;

constexpr double kWidest = 1.3;      // [m] of a passage
constexpr double kNarrowest = 0.5;   // [m] likewise
constexpr double kFurniture = 2.5;   // [m] long at most
constexpr double kLeastCore = 1.0;   // [m2] of a room, where kWidest fits
constexpr double kKeepOff = 0.15;    // [m] of a way, from walls
constexpr double kAtPassage = 0.35;  // [m] within which it need not
constexpr double kFarthest = 5.0;    // [m] from walls that matters
constexpr std::size_t kMostCells = std::size_t{1} << 24U;
constexpr std::uint32_t kNoRoom = 0;

constexpr std::array kSides{Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}};

// Calls `visit(index)` for the neighbours of a cell that a lattice holds: the four beside it, or all eight.
template <typename Visit>
void for_neighbours(const Lattice& lattice, std::size_t index, bool eight, Visit visit) {
  const Cell cell = lattice.cell_of(index);
  for (int row = -1; row <= 1; ++row)
    for (int column = -1; column <= 1; ++column) {
      const bool is_beside = (row == 0) != (column == 0);
      const Cell next{cell.column + column, cell.row + row};
      if ((is_beside || (eight && row != 0 && column != 0)) && lattice.holds(next))
        visit(lattice.index(next));
    }
}

// Returns the cells that hang together with `first` and with each other, and marks them in `seen`.
template <typename Belongs>
std::vector<std::size_t> patch_of(const Lattice& lattice, std::size_t first, bool eight,
                                  std::vector<std::uint8_t>& seen, Belongs belongs) {
  std::vector<std::size_t> patch{first};
  seen[first] = 1;
  for (std::size_t i = 0; i < patch.size(); ++i)
    for_neighbours(lattice, patch[i], eight, [&](std::size_t next) {
      if (seen[next] != 0 || !belongs(next)) return;
      seen[next] = 1;
      patch.push_back(next);
    });
  return patch;
}

bool is_furniture(const Lattice& lattice, const std::vector<std::size_t>& patch) {
  Cell low = lattice.cell_of(patch.front());
  Cell high = low;
  for (const std::size_t index : patch) {
    const Cell cell = lattice.cell_of(index);
    low = {std::min(low.column, cell.column), std::min(low.row, cell.row)};
    high = {std::max(high.column, cell.column), std::max(high.row, cell.row)};
  }
  const bool is_at_edge =
      low.column == 0 || low.row == 0 || high.column + 1 == lattice.columns || high.row + 1 == lattice.rows;
  const int longest = 1 + std::max(high.column - low.column, high.row - low.row);
  return !is_at_edge && longest * lattice.side <= kFurniture;
}

// A place where two rooms meet, between a cell of the one and a cell of the other.
struct Border {
  Vec2 place;
  Vec2 across;  // from the first room into the second, of length 1
};

class Divider {
 public:
  explicit Divider(const FloorGrid& map)
      : map_(map), lattice_(map.lattice), rooms_of_(lattice_.size(), kNoRoom) {}

  Division run() {
    find_walls();
    const int reach = static_cast<int>(std::ceil(kFarthest / lattice_.side)) + 1;
    squared_ = transform_(walls_, lattice_.columns, lattice_.rows, reach);
    find_cores();
    spread();
    measure_rooms();
    find_passages();
    find_legs();
    return std::move(division_);
  }

 private:
  void find_walls() {
    walls_.resize(lattice_.size());
    for (std::size_t i = 0; i < walls_.size(); ++i) walls_[i] = map_.free(lattice_.cell_of(i)) ? 0 : 1;
    std::vector<std::uint8_t> seen(lattice_.size());
    for (std::size_t i = 0; i < walls_.size(); ++i) {
      if (walls_[i] == 0 || seen[i] != 0) continue;
      const auto patch =
          patch_of(lattice_, i, true, seen, [this](std::size_t at) { return walls_[at] != 0; });
      if (!is_furniture(lattice_, patch)) continue;
      for (const std::size_t at : patch) walls_[at] = 0;
    }
  }

  // Returns the distance [m] of a cell's middle from the next wall.
  [[nodiscard]] double room_at(std::size_t index) const {
    return lattice_.side * (std::sqrt(static_cast<double>(squared_[index])) - 0.5);
  }

  // A room is where no passage is so wide.
  void find_cores() {
    std::vector<std::uint8_t> seen(lattice_.size());
    const auto is_core = [this](std::size_t index) { return room_at(index) > 0.5 * kWidest; };
    for (std::size_t i = 0; i < lattice_.size(); ++i) {
      if (seen[i] != 0 || !is_core(i)) continue;
      const auto core = patch_of(lattice_, i, false, seen, is_core);
      if (static_cast<double>(core.size()) * lattice_.side * lattice_.side < kLeastCore) continue;
      division_.rooms.emplace_back();
      for (const std::size_t at : core) rooms_of_[at] = static_cast<std::uint32_t>(division_.rooms.size());
    }
  }

  // Gives each cell to the room from which it is reached with most space.
  void spread() {
    using Entry = std::tuple<std::int32_t, std::uint64_t, std::size_t>;  // space, turn, cell
    std::priority_queue<Entry> open;
    std::uint64_t turn = UINT64_MAX;  // of equal cells the first one comes first
    for (std::size_t i = 0; i < rooms_of_.size(); ++i)
      if (rooms_of_[i] != kNoRoom) open.emplace(squared_[i], turn--, i);
    while (!open.empty()) {
      const std::size_t at = std::get<2>(open.top());
      open.pop();
      for_neighbours(lattice_, at, false, [&](std::size_t next) {
        if (rooms_of_[next] != kNoRoom || walls_[next] != 0) return;
        rooms_of_[next] = rooms_of_[at];
        open.emplace(squared_[next], turn--, next);
      });
    }
  }

  void measure_rooms() {
    std::vector<std::int32_t> most(division_.rooms.size(), -1);
    for (std::size_t i = 0; i < rooms_of_.size(); ++i) {
      if (rooms_of_[i] == kNoRoom) continue;
      const std::size_t room = rooms_of_[i] - 1U;
      division_.rooms[room].area += lattice_.side * lattice_.side;
      if (squared_[i] <= most[room]) continue;
      most[room] = squared_[i];
      division_.rooms[room].middle = lattice_.middle_of(lattice_.cell_of(i));
    }
  }

  void find_passages() {
    std::map<std::array<std::size_t, 2>, std::vector<Border>> borders;
    for (std::size_t i = 0; i < rooms_of_.size(); ++i)
      for (const Cell step : {kSides[0], kSides[1]}) add_border(i, step, borders);
    for (auto& [rooms, all] : borders)
      while (!all.empty()) add_passage(rooms, take_cluster(all));
  }

  void add_border(std::size_t index, Cell step,
                  std::map<std::array<std::size_t, 2>, std::vector<Border>>& borders) const {
    const Cell cell = lattice_.cell_of(index);
    const Cell next{cell.column + step.column, cell.row + step.row};
    if (!lattice_.holds(next)) return;
    const std::uint32_t here = rooms_of_[index];
    const std::uint32_t there = rooms_of_[lattice_.index(next)];
    if (here == kNoRoom || there == kNoRoom || here == there) return;
    const double sign = here < there ? 1.0 : -1.0;
    const Vec2 way{double(step.column), double(step.row)};
    borders[{std::min(here, there) - 1U, std::max(here, there) - 1U}].push_back(
        {lattice_.middle_of(cell) + 0.5 * lattice_.side * way, sign * way});
  }

  // Takes the first border, and all that hang together with it.
  std::vector<Border> take_cluster(std::vector<Border>& all) const {
    std::vector<Border> cluster{all.back()};
    all.pop_back();
    for (std::size_t i = 0; i < cluster.size(); ++i) {
      const auto is_apart = [&](const Border& other) {
        return norm(other.place - cluster[i].place) > 2.0 * lattice_.side;
      };
      const auto near = std::partition(all.begin(), all.end(), is_apart);
      cluster.insert(cluster.end(), near, all.end());
      all.erase(near, all.end());
    }
    return cluster;
  }

  void add_passage(const std::array<std::size_t, 2>& rooms, const std::vector<Border>& borders) {
    Vec2 middle, across;
    for (const Border& border : borders) {
      middle = middle + 1.0 / static_cast<double>(borders.size()) * border.place;
      across = across + border.across;
    }
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (const Border& border : borders) {
      const Vec2 off = border.place - middle;
      xx += off.x * off.x, xy += off.x * off.y, yy += off.y * off.y;
    }
    const Vec2 along = direction(0.5 * portable::atan2(2.0 * xy, xx - yy));
    double low = 0.0, high = 0.0;
    for (const Border& border : borders) {
      low = std::min(low, dot(border.place - middle, along));
      high = std::max(high, dot(border.place - middle, along));
    }
    const double width = high - low + lattice_.side;
    if (width < kNarrowest || width > kWidest + 2.0 * lattice_.side) return;
    const Vec2 normal = cross(along, across) > 0.0 ? Vec2{-along.y, along.x} : Vec2{along.y, -along.x};
    division_.passages.push_back(
        {middle + 0.5 * (low + high) * along, portable::atan2(normal.y, normal.x), width, rooms});
  }

  void find_legs() {
    nav::GridSearch search(nav::kShortest);
    for (std::size_t room = 0; room < division_.rooms.size(); ++room) {
      std::vector<std::size_t> doors;
      for (std::size_t i = 0; i < division_.passages.size(); ++i)
        if (leads_to(division_.passages[i], room)) doors.push_back(i);
      if (doors.size() < 2) continue;
      const std::vector<std::uint16_t> costs = costs_in(room, doors);
      for (std::size_t i = 0; i + 1 < doors.size(); ++i) {
        const Cell from = lattice_.cell_at(division_.passages[doors[i]].middle);
        search.flood(lattice_, costs, from, from, UINT32_MAX);
        for (std::size_t k = i + 1; k < doors.size(); ++k) add_leg(search, doors[i], doors[k], room);
      }
    }
  }

  [[nodiscard]] static bool leads_to(const Passage& passage, std::size_t room) {
    return passage.rooms[0] == room || passage.rooms[1] == room;
  }

  [[nodiscard]] std::vector<std::uint16_t> costs_in(std::size_t room,
                                                    const std::vector<std::size_t>& doors) const {
    std::vector<std::uint16_t> costs(lattice_.size());
    for (std::size_t i = 0; i < costs.size(); ++i)
      if (rooms_of_[i] == room + 1 && room_at(i) >= kKeepOff) costs[i] = nav::kPlainCost;
    for (const std::size_t door : doors) {
      const Vec2 middle = division_.passages[door].middle;
      const Cell at = lattice_.cell_at(middle);
      const int around = static_cast<int>(std::ceil(kAtPassage / lattice_.side));
      for (int row = at.row - around; row <= at.row + around; ++row)
        for (int column = at.column - around; column <= at.column + around; ++column)
          if (const Cell cell{column, row};
              map_.free(cell) && norm(lattice_.middle_of(cell) - middle) < kAtPassage)
            costs[lattice_.index(cell)] = nav::kPlainCost;
    }
    return costs;
  }

  void add_leg(const nav::GridSearch& search, std::size_t from, std::size_t to, std::size_t room) {
    const Vec2 end = division_.passages[to].middle;
    const std::uint32_t cost = search.cost_from(lattice_.index(lattice_.cell_at(end)));
    if (cost == UINT32_MAX) return;
    const double length =
        lattice_.side * cost / (static_cast<double>(nav::kShortest.straight) * nav::kPlainCost);
    division_.legs.push_back({from, to, room, std::max(length, norm(end - division_.passages[from].middle))});
  }

  const FloorGrid& map_;
  const Lattice& lattice_;
  std::vector<std::uint8_t> walls_;  // not 0: no floor, but furniture is
  nav::DistanceTransform transform_;
  std::span<const std::int32_t> squared_;  // distances from walls [cells^2]
  std::vector<std::uint32_t> rooms_of_;    // of each cell: the room's index and 1
  Division division_;
};

template <typename... Numbers>
std::string printed(const char* form, Numbers... numbers) {
  char text[200];
  std::snprintf(text, sizeof text, form, numbers...);
  return text;
}

std::string door_text(const Division& division, std::size_t number, const Pose2& X_WM) {
  const Passage& door = division.passages[number];
  const Vec2 place = X_WM * door.middle;
  const long degrees = std::lround(wrapped(X_WM.yaw + door.direction) * 180.0 / std::numbers::pi);
  return printed("  <door name=\"door_%zu\" x=\"%.2f m\" y=\"%.2f m\" yaw=\"%ld deg\" width=\"%.2f m\"",
                 number + 1, place.x, place.y, degrees, door.width) +
         printed(" from=\"room_%zu\" into=\"room_%zu\"/>\n", door.rooms[0] + 1, door.rooms[1] + 1);
}

std::string leg_text(const Division& division, const RoomLeg& leg) {
  constexpr double kStraight = 1.05;  // times as long: not worth a length
  const double straight = norm(division.passages[leg.to].middle - division.passages[leg.from].middle);
  const std::string length =
      leg.length > kStraight * straight ? printed(" length=\"%.2f m\"", leg.length + 0.005) : "";
  return printed("  <leg from=\"door_%zu\" to=\"door_%zu\" in=\"room_%zu\"", leg.from + 1, leg.to + 1,
                 leg.room + 1) +
         length + "/>\n";
}

}  // namespace

Result<Division> divide(const FloorGrid& map) {
  if (map.lattice.size() >= kMostCells)
    return fail(Code::invalid_argument, "the map has " + std::to_string(map.lattice.size()) +
                                            " cells; expected fewer than " + std::to_string(kMostCells) +
                                            ": give it larger cells");
  return Divider(map).run();
}

std::string ways_text(const Division& division, const Pose2& X_WM, const std::string& name) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<!-- A proposal, made from a map: give rooms and doors "
      "their names, and remove what "
      "is no door.\n";
  for (std::size_t i = 0; i < division.rooms.size(); ++i) {
    const Vec2 middle = X_WM * division.rooms[i].middle;
    text += printed("     room_%zu: %.0f m2 around %.2f %.2f\n", i + 1, division.rooms[i].area, middle.x,
                    middle.y);
  }
  text += "-->\n<ways name=\"" + name + "\" version=\"1\">\n";
  for (std::size_t i = 0; i < division.passages.size(); ++i) text += door_text(division, i, X_WM);
  for (const RoomLeg& leg : division.legs) text += leg_text(division, leg);
  return text + "</ways>\n";
}

}  // namespace orca::orcactl::mapping
