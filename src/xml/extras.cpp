// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/extras.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace orca::xml {
namespace {

struct Extra {
  std::string_view begin;
  std::string_view end;
  bool is_left_out;
};
constexpr std::array kExtras{Extra{"<!--", "-->", true}, Extra{"<?", "?>", true},
                             Extra{"<![CDATA[", "]]>", false}};

void blank(std::string& text, std::size_t at, std::size_t size) {
  for (std::size_t i = at; i < at + size; ++i)
    if (text[i] != '\n') text[i] = ' ';
}

}  // namespace

std::string without_extras(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  for (std::size_t at = text.find('<'); at != std::string::npos; at = text.find('<', at + 1)) {
    const std::string_view rest = std::string_view(text).substr(at);
    const bool is_declaration = at == 0 && rest.starts_with("<?xml") && !rest.starts_with("<?xml-");
    const auto kind =
        std::ranges::find_if(kExtras, [&](const Extra& e) { return rest.starts_with(e.begin); });
    if (kind == kExtras.end() || is_declaration) continue;
    const std::size_t size = rest.find(kind->end, kind->begin.size());
    if (size == std::string_view::npos) return text;  // read_text() says what is not closed
    if (kind->is_left_out) blank(text, at, size + kind->end.size());
    at += size;
  }
  return text;
}

}  // namespace orca::xml
