// SPDX-License-Identifier: LGPL-3.0-or-later
#include "number_list.hpp"

#include <charconv>
#include <optional>
#include <set>
#include <string>

#include "orca/base/text.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::batch {
namespace {

std::optional<std::uint64_t> number_in(std::string_view text) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

struct Range {
  std::uint64_t first, last;
};

Result<Range> range_in(std::string_view word) {
  const std::size_t dash = word.find('-');
  const auto first = number_in(word.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : number_in(word.substr(dash + 1));
  if (!first || !last)
    return fail(Code::invalid_argument,
                in_quotes(word) + " is neither a number nor a range; write for example 1-20 50");
  if (*last < *first)
    return fail(Code::invalid_argument,
                in_quotes(word) + " goes down; write the smaller number of a range first");
  return Range{*first, *last};
}

}  // namespace

Result<std::vector<std::uint64_t>> read_number_list(std::string_view text) {
  std::vector<std::uint64_t> numbers;
  std::set<std::uint64_t> known;
  for (const std::string_view word : xml::words(text)) {
    const Result<Range> range = range_in(word);
    if (!range) return range.error();
    if (range->last - range->first >= kMostNumbers - numbers.size())
      return fail(Code::invalid_argument, "there are more than 1,000,000 numbers");
    for (std::uint64_t i = 0; i <= range->last - range->first; ++i) {
      if (!known.insert(range->first + i).second)
        return fail(Code::invalid_argument, std::to_string(range->first + i) + " is given twice");
      numbers.push_back(range->first + i);
    }
  }
  if (numbers.empty()) return fail(Code::invalid_argument, "there is no number; write for example 1-20 50");
  return numbers;
}

}  // namespace orca::batch
