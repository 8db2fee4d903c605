// SPDX-License-Identifier: LGPL-3.0-or-later
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "orca/batch/experiment.hpp"
#include "results/metric.hpp"

namespace orca::batch {

std::string Contrast::text() const {
  const std::string pair = first + " - " + second + ", " + metric + ": ";
  switch (asked.claim) {
    case Claim::difference: return pair + "difference";
    case Claim::not_worse: return pair + "not worse by " + margin;
    case Claim::equal: return pair + "equal within " + margin;
  }
  return pair;
}

std::vector<Contrast> questions_of(const Experiment& experiment) {
  if (!experiment.contrasts.empty()) return experiment.contrasts;
  std::set<std::string> variants;
  for (const Variant& variant : experiment.variants) variants.insert(variant.name);
  std::vector<Contrast> all;
  for (const std::string& metric : experiment.metrics)
    for (auto first = variants.begin(); first != variants.end(); ++first)
      for (auto second = std::next(first); second != variants.end(); ++second)
        all.push_back({.first = *first, .second = *second, .metric = metric});
  return all;
}

}  // namespace orca::batch
