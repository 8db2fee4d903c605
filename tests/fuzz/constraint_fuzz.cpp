// SPDX-License-Identifier: GPL-3.0-or-later
// Any text is a constraint or has a fault with a place in it. A constraint is the same after printing.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "reading/trading/constraint.hpp"

using namespace orca::graph;

namespace {

std::string printed(const Constraint& constraint) {
  std::string text;
  for (const Term& term : constraint) text += (text.empty() ? "" : "; ") + term.text();
  return text;
}

bool equal(const Constraint& a, const Constraint& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].name != b[i].name || a[i].comparison != b[i].comparison || a[i].value != b[i].value)
      return false;
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ConstraintFault fault;
  static_cast<void>(parse_preference(text, fault));
  fault = {};
  const auto constraint = parse_constraint(text, fault);
  if (!constraint) {
    if (fault.message.empty() || fault.column == 0 || fault.column > size + 1) std::abort();
    return 0;
  }
  if (constraint->empty()) std::abort();
  const auto again = parse_constraint(printed(*constraint), fault);
  if (!again || !equal(*constraint, *again)) std::abort();
  for (const Term& term : *constraint)
    if (evaluate(term, term.value) == TermOutcome::incomparable) std::abort();
  return 0;
}
