// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace orca::xml {

/// A place in a text file. Lines and columns count from 1; a column is one character (code point), a tab is
/// one column. Line 0 stands for something that is no file, such as the command line.
struct Position {
  std::string file;
  int line = 0;
  int column = 0;

  /// Returns "graph.xml:12:7", or only the file where there is no line.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const Position&, const Position&) = default;
};

enum class Severity { error, warning };

/// A message to the author of a file. docs/errors.md lists the codes; they never change.
struct Diagnostic {
  Severity severity = Severity::error;
  std::string code;  ///< E.g. "G017"; empty: `message` is a whole line made elsewhere, printed as it is.
  Position position;
  std::string message;

  /// Returns "graph.xml:12:7: error G017: ..." in one line: what a terminal would obey instead of showing it
  /// is written as an escape sequence.
  [[nodiscard]] std::string text() const;
  friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

/// A collection of everything that is wrong with a file, so that all of it can be reported at once.
///
/// Thread contract: not synchronised; one thread.
class Diagnostics {
 public:
  /// The number of lines that are printed; more would help nobody.
  static constexpr std::size_t kPrinted = 50;
  /// The number of messages that are kept. Further ones are only counted, because a file of 16 MB must not
  /// cost gigabytes.
  static constexpr std::size_t kKept = 20'000;
  /// The bytes of a message that are kept. The middle of a longer one is left out.
  static constexpr std::size_t kLongest = 2000;

  void error(std::string code, Position position, std::string message);
  void warning(std::string code, Position position, std::string message);

  /// Adds a finished line, for instance about another file. `position` determines where it is sorted.
  void line(Position position, std::string finished_line);

  [[nodiscard]] bool has_errors() const { return errors_ > 0; }
  [[nodiscard]] std::size_t error_count() const { return errors_; }

  /// Returns all messages (the first kKept), ordered by file, line and column; in the order of reporting
  /// within one place.
  [[nodiscard]] std::vector<Diagnostic> sorted() const;

  /// Returns the sorted lines, each ended by a newline; after kPrinted of them "... and N more".
  [[nodiscard]] std::string text() const;

  /// Returns the same for programs: {errors, warnings, messages: [{severity, code, file, line, column,
  /// message}]}, sorted, and none of the first kKept left out.
  [[nodiscard]] std::string json() const;

 private:
  void keep(Severity severity, std::string code, Position position, std::string message);

  std::vector<Diagnostic> items_;
  std::size_t errors_ = 0;
  std::size_t reported_ = 0;
};

}  // namespace orca::xml
