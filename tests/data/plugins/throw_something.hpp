// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <stdexcept>
#include <string>

namespace orca::test {

/// An exception that only the plugin knows.
struct Mishap : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Not an exception in the standard's sense, but C++ lets everything be thrown.
struct Oddity {};

/// @param what  "exception", "int", "text", "nullptr", or anything else for an object of a type of its own.
[[noreturn]] inline void throw_something(const std::string& what) {
  if (what == "exception") throw Mishap("the wheels came off");
  if (what == "int") throw 42;
  if (what == "text") throw "plain words";
  if (what == "nullptr") throw nullptr;
  throw Oddity{};
}

}  // namespace orca::test
