// SPDX-License-Identifier: LGPL-3.0-or-later
#include "generator_reader.hpp"

#include <algorithm>

#include "codes.hpp"
#include "orca/base/text.hpp"
#include "orca/robot_file/values.hpp"

namespace orca::sim::detail {

using namespace robot_file::values;

namespace {

// The values of a family's parameters, with a record of whether all were valid.
class Values {
 public:
  explicit Values(const xml::Attributes& element) : element_(element) {}

  void length(const char* name, double& to) { take(to, element_.number_or(name, to)); }
  void count(const char* name, std::size_t& to) {
    if (element_.has(name)) take(to, element_.integer(name));
  }
  void share(const char* name, std::optional<double>& to) {
    if (element_.has(name)) take(to, element_.bare_number(name));
  }
  void count(const char* name, std::optional<std::size_t>& to) {
    if (element_.has(name)) take(to, element_.integer(name));
  }
  [[nodiscard]] bool good() const { return good_; }

 private:
  template <class To, class From>
  void take(To& to, const std::optional<From>& from) {
    set(to, from);
    good_ = good_ && from.has_value();
  }

  const xml::Attributes& element_;
  bool good_ = true;
};

Family barn(Values& values) {
  BarnField f;
  values.share("fill", f.fill);
  values.count("rounds", f.rounds);
  return f;
}

Family u_trap(Values& values) {
  UTrap f;
  values.length("width", f.width);
  values.length("depth", f.depth);
  values.length("beside", f.beside);
  return f;
}

Family narrow_doors(Values& values) {
  NarrowDoors f;
  values.length("door", f.door);
  values.count("walls", f.walls);
  values.length("spacing", f.spacing);
  values.length("width", f.width);
  return f;
}

Family corridor(Values& values) {
  Corridor f;
  values.length("width", f.width);
  values.count("legs", f.legs);
  values.length("shortest", f.shortest);
  values.length("longest", f.longest);
  return f;
}

Family office(Values& values) {
  OfficeFloor f;
  values.count("rooms", f.rooms);
  values.length("door", f.door);
  values.length("corridor", f.corridor);
  values.count("furniture", f.furniture);
  return f;
}

struct GeneratorKind {
  const char* name;
  std::vector<std::string> attributes;
  Family (*read)(Values&);
};

const std::vector<GeneratorKind>& kinds() {
  static const std::vector<GeneratorKind> all{
      {"barn", {"fill", "rounds"}, barn},
      {"u_trap", {"width", "depth", "beside"}, u_trap},
      {"narrow_doors", {"door", "walls", "spacing", "width"}, narrow_doors},
      {"corridor", {"width", "legs", "shortest", "longest"}, corridor},
      {"office", {"rooms", "door", "corridor", "furniture"}, office}};
  return all;
}

// Reports the attributes that only other kinds have. Returns true if there are none.
bool check_attributes(const xml::Attributes& element, const GeneratorKind& kind, xml::Reporter& reporter) {
  std::vector<std::string> names{"kind", "seed", "radius"};
  names.insert(names.end(), kind.attributes.begin(), kind.attributes.end());
  bool good = true;
  for (const auto& [name, attribute] : element.matched()) {
    const bool misspelt = attribute->name != name;  // Reported already.
    if (misspelt || std::ranges::find(names, name) != names.end()) continue;
    reporter.error(world_codes::kUnknownAttribute, attribute->position,
                   "<generate> of kind " + in_quotes(kind.name) + " has no attribute " + in_quotes(name) +
                       "; it has: " + listed(names));
    good = false;
  }
  return good;
}

}  // namespace

std::optional<Order> read_generate(const xml::Attributes& element, xml::Reporter& reporter) {
  const auto name = element.choice("kind");
  if (!name) return std::nullopt;
  const auto kind = std::ranges::find(kinds(), *name, &GeneratorKind::name);
  if (!check_attributes(element, *kind, reporter)) return std::nullopt;
  Values values(element);
  Order order{kind->read(values)};
  values.length("radius", order.radius);
  const auto seed = element.has("seed") ? element.integer("seed") : std::optional<std::int64_t>(order.seed);
  if (!seed || !values.good()) return std::nullopt;
  order.seed = static_cast<std::uint64_t>(*seed);
  return order;
}

}  // namespace orca::sim::detail
