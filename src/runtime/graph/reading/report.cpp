// SPDX-License-Identifier: LGPL-3.0-or-later
#include "report.hpp"

#include "orca/xml/names.hpp"

namespace orca::graph {

namespace {

// Returns the message without the contexts of names, which differ between copies of a file:
// "left/avoid" is "avoid".
std::string without_contexts(const std::string& message) {
  std::string result;
  std::size_t word = 0;
  for (const char c : message) {
    const bool in_name =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (c == '/') {
      result.resize(word);
      continue;
    }
    result += c;
    if (!in_name) word = result.size();
  }
  return result;
}

}  // namespace

bool Report::told_already(const char* code, const xml::Position& position, const std::string& message) {
  if (!shared_files_.contains(position.file)) return false;
  return !told_.insert(position.text() + code + without_contexts(message)).second;
}

void Report::error(const char* code, const xml::Position& position, std::string message) {
  if (told_already(code, position, message)) return;
  Reporter::error(code, position, std::move(message));
}

void Report::warning(const char* code, const xml::Position& position, std::string message) {
  if (told_already(code, position, message)) return;
  if (strict_) {
    ++strict_warnings_;
    return diagnostics().error(code, position, std::move(message));
  }
  diagnostics().warning(code, position, std::move(message));
}

void Report::line(const xml::Position& position, std::string finished_line) {
  if (told_.insert(finished_line).second) diagnostics().line(position, std::move(finished_line));
}

std::string Report::hint_in_contexts(std::string_view name, std::span<const std::string> candidates) {
  if (!has_hints()) return {};
  if (const auto near = nearest(name, candidates)) return xml::did_you_mean(near);
  const std::string ending = "/" + std::string(name);
  const auto fits = [&](const std::string& candidate) { return candidate.ends_with(ending); };
  const auto found = std::ranges::find_if(candidates, fits);
  return found == candidates.end() ? "" : xml::did_you_mean(*found);
}

}  // namespace orca::graph
