// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robots/realism.hpp"

namespace orca::robots {

std::string_view to_string(Realism realism) {
  switch (realism) {
    case Realism::ideal: return "ideal";
    case Realism::nominal: return "nominal";
    case Realism::harsh: return "harsh";
  }
  return "unknown";
}

std::optional<Realism> realism_from(std::string_view word) {
  for (const Realism r : {Realism::ideal, Realism::nominal, Realism::harsh})
    if (word == to_string(r)) return r;
  return std::nullopt;
}

}  // namespace orca::robots
