// SPDX-License-Identifier: LGPL-3.0-or-later
#include "generator_reader.hpp"

#include <algorithm>
#include <limits>

namespace orca::sim::detail {
namespace {

constexpr std::size_t kMany = 1'000'000;  // More than any family allows, and says so itself.

// Takes values over into the parameters of a family and remembers whether all were good.
class Values {
 public:
  explicit Values(const Attributes& element) : element_(element) {}

  void length(const char* name, double& to) { take(to, element_.quantity_or(name, "m", Sign::positive, to)); }
  void count(const char* name, std::size_t& to) {
    if (element_.has(name)) take(to, element_.count(name, 0, kMany));
  }
  void share(const char* name, std::optional<double>& to) {
    if (element_.has(name)) take(to, element_.number(name));
  }
  void count(const char* name, std::optional<std::size_t>& to) {
    if (element_.has(name)) take(to, element_.count(name, 0, kMany));
  }
  [[nodiscard]] bool good() const { return good_; }

 private:
  template <class To, class From>
  void take(To& to, const std::optional<From>& from) {
    if (from) to = *from;
    good_ = good_ && from.has_value();
  }

  const Attributes& element_;
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

struct Kind {
  const char* name;
  std::vector<std::string> attributes;
  Family (*read)(Values&);
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> all{{"barn", {"fill", "rounds"}, barn},
                                     {"u_trap", {"width", "depth", "beside"}, u_trap},
                                     {"narrow_doors", {"door", "walls", "spacing", "width"}, narrow_doors},
                                     {"corridor", {"width", "legs", "shortest", "longest"}, corridor},
                                     {"office", {"rooms", "door", "corridor", "furniture"}, office}};
  return all;
}

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds()) names.emplace_back(kind.name);
  return names;
}

}  // namespace

std::optional<std::uint64_t> read_seed(const Attributes& element) {
  const auto seed = element.count("seed", 0, std::numeric_limits<std::int64_t>::max());
  return seed ? std::optional<std::uint64_t>(*seed) : std::nullopt;
}

std::optional<Order> read_generate(const Attributes& element) {
  const auto name = element.choice("kind", kind_names());
  if (!name) return std::nullopt;
  const auto kind = std::ranges::find(kinds(), *name, &Kind::name);
  std::vector<std::string> attributes{"kind", "seed", "radius"};
  attributes.insert(attributes.end(), kind->attributes.begin(), kind->attributes.end());
  element.allow(attributes, {});
  Values values(element);
  Order order{kind->read(values)};
  values.length("radius", order.radius);
  const auto seed = element.has("seed") ? read_seed(element) : std::optional(order.seed);
  if (!seed || !values.good()) return std::nullopt;
  order.seed = *seed;
  return order;
}

}  // namespace orca::sim::detail
