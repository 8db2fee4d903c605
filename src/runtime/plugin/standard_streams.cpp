// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/plugin/standard_streams.hpp"

#include <iostream>

namespace orca::plugin {
namespace {

template <class Char>
void add_changes(const std::vector<KeptStream<Char>>& all, std::vector<std::string>& changes) {
  for (const KeptStream<Char>& kept : all) {
    if (kept.stream.rdbuf() != kept.buffer) changes.push_back(std::string("the buffer of ") + kept.name);
    if (kept.stream.tie() != kept.tied) changes.push_back(std::string("the stream tied to ") + kept.name);
    if (kept.stream.getloc() != kept.locale) changes.push_back(std::string("the locale of ") + kept.name);
  }
}

template <class Char>
void restore_all(const std::vector<KeptStream<Char>>& all) {
  for (const KeptStream<Char>& kept : all) {
    if (kept.stream.rdbuf() != kept.buffer) kept.stream.rdbuf(kept.buffer);  // which also clears its errors
    if (kept.stream.tie() != kept.tied) kept.stream.tie(kept.tied);
    if (kept.stream.getloc() != kept.locale) kept.stream.imbue(kept.locale);
  }
}

const StandardStreams g_at_start;

}  // namespace

template <class Char>
KeptStream<Char>::KeptStream(std::basic_ios<Char>& present, const char* its_name)
    : stream(present),
      name(its_name),
      buffer(present.rdbuf()),
      tied(present.tie()),
      locale(present.getloc()) {}

StandardStreams::StandardStreams()
    : narrow_{{std::cin, "std::cin"},
              {std::cout, "std::cout"},
              {std::cerr, "std::cerr"},
              {std::clog, "std::clog"}},
      wide_{{std::wcin, "std::wcin"},
            {std::wcout, "std::wcout"},
            {std::wcerr, "std::wcerr"},
            {std::wclog, "std::wclog"}} {}

const StandardStreams& StandardStreams::at_start() { return g_at_start; }

std::vector<std::string> StandardStreams::changes() const {
  std::vector<std::string> changes;
  add_changes(narrow_, changes);
  add_changes(wide_, changes);
  if (std::locale() != global_) changes.emplace_back("std::locale()");
  return changes;
}

void StandardStreams::restore() const {
  if (std::locale() != global_) std::locale::global(global_);
  restore_all(narrow_);
  restore_all(wide_);
}

}  // namespace orca::plugin
