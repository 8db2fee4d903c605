// SPDX-License-Identifier: LGPL-3.0-or-later
#include "budget.hpp"

#include <string>
#include <utility>

#include "codes.hpp"

namespace orca::graph {
namespace {

bool take(std::size_t count, std::size_t& left) {
  const bool enough = count <= left;
  left = enough ? left - count : 0;
  return enough;
}

}  // namespace

bool Budget::take_file(const xml::Position& position, Report& report) {
  if (take(1, files_)) return true;
  if (!std::exchange(files_told_, true)) {
    report.error(codes::kExpansion, position,
                 "with this file the graph includes and uses files more than " + std::to_string(kFiles) +
                     " times, which is the limit");
  }
  return false;
}

bool Budget::take_elements(std::size_t count, const xml::Position& position, Report& report) {
  if (take(count, elements_)) return true;
  if (!std::exchange(elements_told_, true)) {
    report.error(codes::kExpansion, position,
                 "with this file the graph has more than " + std::to_string(kElements) +
                     " elements, which is the limit");
  }
  return false;
}

bool Budget::take_characters(std::size_t count, const xml::Position& position, Report& report) {
  if (take(count, characters_)) return true;
  if (!std::exchange(characters_told_, true)) {
    report.error(codes::kExpansion, position,
                 "with this value the graph has grown by more than 16 MB of arguments, which is the limit");
  }
  return false;
}

}  // namespace orca::graph
