// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace orca {

/// Writes one JSON value (RFC 8259), indented, for the --json of the programs. What it is given must be
/// UTF-8.
///
/// Thread contract: not synchronised; one thread.
class JsonWriter {
 public:
  void begin_object() { begin('{', '}'); }
  void begin_array() { begin('[', ']'); }
  /// Ends the innermost object or array.
  void end();

  /// The name of the next value of an object.
  JsonWriter& key(std::string_view name);

  void value(std::string_view text);
  void value(const char* text) { value(std::string_view(text)); }
  void value(bool flag) { raw(flag ? "true" : "false"); }
  /// null if it is infinite or no number.
  void value(double number);
  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) void value(Integer number) { raw(std::to_string(number)); }
  void value(const std::vector<std::string>& texts);

  template <class Value>
  void member(std::string_view name, const Value& content) {
    key(name).value(content);
  }

  /// Everything written, ended by a newline.
  [[nodiscard]] std::string text() const { return text_ + "\n"; }

 private:
  void begin(char open, char close);
  void raw(std::string_view json);
  void separate();
  void new_line();

  std::string text_;
  std::vector<char> open_;  // how the open objects and arrays end
  bool first_ = true;       // nothing in the innermost one yet
  bool after_key_ = false;
};

}  // namespace orca
