// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>
#include <vector>

#include "orca/base/hash.hpp"
#include "orca/batch/experiment.hpp"
#include "orca/xml/document.hpp"

namespace orca::batch {
namespace {

void add(const std::vector<Setting>& settings, Fnv1a& hash) {
  for (const Setting& setting : settings) hash.add_text(setting.text());
  hash.add_text("");
}

}  // namespace

std::string identity_of(const Experiment& experiment) {
  Fnv1a hash;
  hash.add_text(experiment.name);
  hash.add_u64(static_cast<std::uint64_t>(experiment.until.count()));
  add(experiment.settings, hash);
  for (const Variant& variant : experiment.variants) {
    hash.add_text(variant.name);
    const Result<std::string> graph = xml::read_bytes(variant.graph);
    hash.add_text(graph ? *graph : variant.graph);
    add(variant.settings, hash);
  }
  return std::to_string(hash.value());
}

}  // namespace orca::batch
