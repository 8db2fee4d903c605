// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/experiment.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "orca/base/hash.hpp"
#include "orca/xml/number.hpp"

namespace orca::batch {

Duration Failing::time(std::uint64_t seed) const {
  if (!latest) return at;
  Fnv1a hash;
  hash.add_text(component);
  if (!world.empty()) hash.add_text(world);
  hash.add_u64(seed);
  std::mt19937_64 random(hash.value());
  const double share = static_cast<double>(random() >> 11) * 0x1.0p-53;  // from 0 to below 1
  return at + std::chrono::milliseconds(std::llround(share * 1e3 * to_seconds(*latest - at)));
}

std::string Failing::order(std::uint64_t seed) const {
  return component + "=" + how + "@" + xml::number_text(to_seconds(time(seed))) + "s";
}

std::string Failing::text() const {
  std::string text = component + "=" + how + "@" + xml::number_text(to_seconds(at)) + "s";
  if (latest) text += ".." + xml::number_text(to_seconds(*latest)) + "s";
  return text;
}

Run Experiment::run(std::size_t number) const {
  const std::size_t variant = number % variants.size();
  const std::size_t place = number / variants.size();
  return {variant, place / seeds.size(), seeds[place % seeds.size()]};
}

std::optional<std::size_t> Experiment::number_of(const std::string& variant, const std::string& world,
                                                 std::uint64_t seed) const {
  const auto its_variant = std::ranges::find(variants, variant, &Variant::name);
  const auto its_world = std::ranges::find(worlds, world, &World::name);
  const auto its_seed = std::ranges::find(seeds, seed);
  if (its_variant == variants.end() || its_world == worlds.end() || its_seed == seeds.end())
    return std::nullopt;
  const auto place = static_cast<std::size_t>(its_world - worlds.begin()) * seeds.size() +
                     static_cast<std::size_t>(its_seed - seeds.begin());
  return place * variants.size() + static_cast<std::size_t>(its_variant - variants.begin());
}

std::vector<std::string> Experiment::settings_of(const Run& run) const {
  std::vector<std::string> texts;
  for (const std::vector<Setting>* some :
       {&settings, &worlds[run.world].settings, &variants[run.variant].settings})
    for (const Setting& setting : *some) texts.push_back(setting.text());
  return texts;
}

const std::vector<Goal>& Experiment::goals_of(const Run& run) const {
  const std::vector<Goal>& of_world = worlds[run.world].goals;
  return of_world.empty() ? goals : of_world;
}

}  // namespace orca::batch
