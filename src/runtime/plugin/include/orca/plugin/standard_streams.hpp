// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <iosfwd>
#include <locale>
#include <string>
#include <vector>

namespace orca::plugin {

/// A standard stream of C++ with the buffer, the tied stream and the locale that it had at some moment.
template <class Char>
struct KeptStream {
  KeptStream(std::basic_ios<Char>& present, const char* its_name);

  std::basic_ios<Char>& stream;
  const char* name;  ///< For people.
  std::basic_streambuf<Char>* buffer;
  std::basic_ostream<Char>* tied;
  std::locale locale;
};

/// The buffers, tied streams and locales of std::cout and the other standard streams of C++, and std::locale(), as they were when
/// the object was made. Others that a plugin puts in their place end with its code, and the process would crash when it flushes its
/// streams at its end.
///
/// Thread contract: any thread, while no other one changes the same.
class StandardStreams {
 public:
  StandardStreams();
  /// Returns what they were when the program began.
  static const StandardStreams& at_start();

  /// Returns what is different now, for people: "the buffer of std::cout". Nothing costs some ten nanoseconds.
  [[nodiscard]] std::vector<std::string> changes() const;
  /// Puts all of it back.
  void restore() const;

 private:
  std::vector<KeptStream<char>> narrow_;
  std::vector<KeptStream<wchar_t>> wide_;
  std::locale global_;
};

}  // namespace orca::plugin
