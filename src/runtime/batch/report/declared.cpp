// SPDX-License-Identifier: LGPL-3.0-or-later
#include "declared.hpp"

#include <map>
#include <string>
#include <utility>

#include "orca/base/hash.hpp"
#include "orca/base/text.hpp"
#include "orca/batch/report.hpp"

namespace orca::batch {
namespace {

constexpr std::size_t kListed = 12;

// Returns the names of worlds, or how many each family has where they are many. Two lists of equal length differ by the number at the end.
std::string worlds_text(const std::vector<World>& worlds) {
  std::vector<std::string> names;
  std::map<std::string, std::size_t> families;
  Fnv1a hash;
  for (const World& world : worlds) {
    names.push_back(world.name);
    hash.add_text(world.name);
    ++families[world.family];
  }
  if (names.size() <= kListed) return joined(names, ", ");
  std::vector<std::string> counts;
  for (const auto& [family, count] : families)
    counts.push_back(count == 1 ? family : std::to_string(count) + " of " + family);
  return listed(counts) + "; list " + std::to_string(hash.value() % 10'000);
}

}  // namespace

std::string ranges_text(const std::vector<std::uint64_t>& numbers) {
  std::string text;
  for (std::size_t begin = 0; begin < numbers.size();) {
    std::size_t end = begin + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1) ++end;
    text += (text.empty() ? "" : " ") + std::to_string(numbers[begin]);
    if (end - begin > 1) text += "-" + std::to_string(numbers[end - 1]);
    begin = end;
  }
  return text;
}

std::vector<Declaration> declarations_of(const Experiment& experiment, const std::string& date) {
  std::vector<std::string> contrasts;
  for (const Contrast& contrast : experiment.contrasts) contrasts.push_back(contrast.text());
  if (contrasts.empty()) contrasts.emplace_back("all pairs of variants in all metrics");
  return {{"metrics", joined(experiment.metrics, ", "), date},
          {"contrasts", joined(contrasts, "; "), date},
          {"seeds", ranges_text(experiment.seeds), date},
          {"worlds", worlds_text(experiment.worlds), date}};
}

void add_declarations(std::vector<Declaration> declarations, Document& document) {
  std::erase_if(declarations, [](const Declaration& one) { return one.what == kBuildDeclaration; });
  if (declarations.empty()) return;
  document.add(Heading{"What was declared, and when"});
  std::map<std::string, std::size_t> seen;
  Table table{{"date", "what", "declared"}, {}};
  bool has_changed = false;
  for (const auto& [what, text, date] : declarations) {
    const bool is_change = seen[what]++ > 0;
    has_changed = has_changed || is_change;
    table.rows.push_back({date, what + (is_change ? ", changed" : ""), text});
  }
  document.add(std::move(table));
  document.add(Paragraph{has_changed ? "Not all of it was declared at first. Whoever adds runs or exchanges "
                                       "metrics after a look at results finds "
                                       "more than there is: read claims with that in mind."
                                     : "Nothing was added or exchanged since then."});
}

}  // namespace orca::batch
