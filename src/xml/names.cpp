// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/names.hpp"

#include <algorithm>
#include <vector>

namespace orca::xml {
namespace {

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

// Three rows of the table are enough: swapping two neighbours looks two rows back. Anything beyond `limit`
// counts as limit + 1, which ends hopeless comparisons early.
std::size_t distance(std::string_view a, std::string_view b, std::size_t limit) {
  if (std::max(a.size(), b.size()) - std::min(a.size(), b.size()) > limit) return limit + 1;
  std::vector<std::size_t> before(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    if (*std::min_element(row.begin(), row.end()) > limit) return limit + 1;
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

bool one_begins_the_other(std::string_view a, std::string_view b) {
  constexpr std::size_t kTelling = 3;
  return std::min(a.size(), b.size()) >= kTelling && (a.starts_with(b) || b.starts_with(a));
}

}  // namespace

std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> candidates) {
  if (word.empty()) return std::nullopt;
  const std::string wanted = lower(word);
  const std::string* best = nullptr;
  const std::string* longer_or_shorter = nullptr;
  std::size_t best_distance = (wanted.size() + 1) / 3 + 1;
  for (const std::string& candidate : candidates) {
    const std::string other = lower(candidate);
    if (longer_or_shorter == nullptr && one_begins_the_other(wanted, other)) longer_or_shorter = &candidate;
    const std::size_t d = distance(wanted, other, best_distance - 1);
    if (d >= best_distance) continue;
    best = &candidate;
    best_distance = d;
    if (d == 0) break;
  }
  if (best == nullptr) best = longer_or_shorter;
  return best == nullptr ? std::nullopt : std::optional(*best);
}

std::string did_you_mean(const std::optional<std::string>& nearest) {
  return nearest ? "; did you mean \"" + *nearest + "\"?" : "";
}

}  // namespace orca::xml
