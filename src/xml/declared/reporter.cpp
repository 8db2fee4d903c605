// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/reporter.hpp"

#include <utility>

#include "orca/xml/names.hpp"

namespace orca::xml {

void Reporter::error(const char* code, const Position& position, std::string message) {
  out_.error(code, position, std::move(message));
}

std::optional<std::string> Reporter::nearest(std::string_view word, std::span<const std::string> candidates) {
  if (hints_left_ == 0) return std::nullopt;
  --hints_left_;
  return nearest_name(word, candidates);
}

std::string Reporter::hint(std::string_view word, std::span<const std::string> candidates) {
  return did_you_mean(nearest(word, candidates));
}

}  // namespace orca::xml
