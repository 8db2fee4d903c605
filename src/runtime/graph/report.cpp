// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.hpp"

#include "orca/xml/names.hpp"

namespace orca::graph {

void Report::error(const char* code, const xml::Position& position, std::string message) {
  out_.error(code, position, std::move(message));
}

void Report::warning(const char* code, const xml::Position& position, std::string message) {
  out_.warning(code, position, std::move(message));
}

void Report::line(const xml::Position& position, std::string finished_line) {
  out_.line(position, std::move(finished_line));
}

std::optional<std::string> Report::nearest(std::string_view word, std::span<const std::string> candidates) {
  if (hints_left_ == 0) return std::nullopt;
  --hints_left_;
  return xml::nearest_name(word, candidates);
}

std::string Report::hint(std::string_view word, std::span<const std::string> candidates) {
  return xml::did_you_mean(nearest(word, candidates));
}

}  // namespace orca::graph
