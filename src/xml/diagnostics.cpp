// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/xml/diagnostics.hpp"

#include <algorithm>
#include <tuple>

#include "orca/base/json.hpp"
#include "orca/base/text.hpp"

namespace orca::xml {

std::string Position::text() const {
  if (line == 0) return file;
  return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

std::string Diagnostic::text() const {
  if (code.empty()) return printable(message);
  const char* kind = severity == Severity::error ? ": error " : ": warning ";
  return printable(position.text() + kind + code + ": " + message);
}

void Diagnostics::keep(Severity severity, std::string code, Position position, std::string message) {
  ++reported_;
  if (items_.size() == kKept) return;
  items_.push_back({severity, std::move(code), std::move(position), shortened(message, kLongest)});
}

void Diagnostics::error(std::string code, Position position, std::string message) {
  ++errors_;
  keep(Severity::error, std::move(code), std::move(position), std::move(message));
}

void Diagnostics::warning(std::string code, Position position, std::string message) {
  keep(Severity::warning, std::move(code), std::move(position), std::move(message));
}

void Diagnostics::line(Position position, std::string finished_line) {
  error({}, std::move(position), std::move(finished_line));
}

std::vector<Diagnostic> Diagnostics::sorted() const {
  std::vector<Diagnostic> result = items_;
  const auto key = [](const Diagnostic& d) {
    return std::tie(d.position.file, d.position.line, d.position.column);
  };
  std::stable_sort(result.begin(), result.end(),
                   [&](const Diagnostic& a, const Diagnostic& b) { return key(a) < key(b); });
  return result;
}

std::string Diagnostics::text() const {
  const std::vector<Diagnostic> all = sorted();
  std::string result;
  for (std::size_t i = 0; i < std::min(all.size(), kPrinted); ++i) result += all[i].text() + "\n";
  if (reported_ > kPrinted) result += "... and " + std::to_string(reported_ - kPrinted) + " more\n";
  return result;
}

std::string Diagnostics::json() const {
  JsonWriter json;
  json.begin_object();
  json.member("errors", errors_);
  json.member("warnings", reported_ - errors_);
  json.key("messages").begin_array();
  for (const Diagnostic& diagnostic : sorted()) {
    json.begin_object();
    json.member("severity", diagnostic.severity == Severity::error ? "error" : "warning");
    json.member("code", diagnostic.code);
    json.member("file", diagnostic.position.file);
    json.member("line", diagnostic.position.line);
    json.member("column", diagnostic.position.column);
    json.member("message", diagnostic.message);
    json.end();
  }
  json.end();
  json.end();
  return json.text();
}

}  // namespace orca::xml
