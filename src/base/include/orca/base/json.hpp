// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace orca {

/// A writer of one JSON value (RFC 8259), indented, for option --json of the programs. All texts must be
/// UTF-8.
///
/// Thread contract: not synchronised; one thread.
class JsonWriter {
 public:
  void begin_object() { begin('{', '}'); }
  void begin_array() { begin('[', ']'); }
  /// Ends the innermost object or array.
  void end();

  /// Writes the name of the next value of an object.
  JsonWriter& key(std::string_view name);

  void value(std::string_view text);
  void value(const char* text) { value(std::string_view(text)); }
  void value(bool flag) { raw(flag ? "true" : "false"); }
  /// Writes null for an infinite value or NaN.
  void value(double number);
  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) void value(Integer number) { raw(std::to_string(number)); }
  void value(const std::vector<std::string>& texts);

  template <class Value>
  void member(std::string_view name, const Value& content) {
    key(name).value(content);
  }

  /// Returns everything written, with a newline at the end.
  [[nodiscard]] std::string text() const { return text_ + "\n"; }

 private:
  void begin(char open, char close);
  void raw(std::string_view json);
  void separate();
  void new_line();

  std::string text_;
  std::vector<char> open_;  // the closing brackets of the open objects and arrays
  bool first_ = true;       // the innermost one is still empty
  bool after_key_ = false;
};

}  // namespace orca
