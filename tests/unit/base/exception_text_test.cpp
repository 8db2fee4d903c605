// SPDX-License-Identifier: GPL-3.0-or-later
// What has been thrown, as messages say it.
#include "orca/base/exception_text.hpp"

#include <unwind.h>

#include <catch2/catch.hpp>

#include <stdexcept>
#include <string>

using orca::describe_current_exception;

namespace {

template <class Thrown>
std::string text_of(const Thrown& thrown) {
  try {
    throw thrown;
  } catch (...) {
    return describe_current_exception();
  }
}

struct Odd {};

struct Mute : std::exception {
  [[nodiscard]] const char* what() const noexcept override { return nullptr; }
};

}  // namespace

TEST_CASE("an exception is described by its type and its text", "[base][exception]") {
  CHECK(text_of(std::runtime_error("no way out")) == "threw std::runtime_error: no way out");
  CHECK(text_of(7) == "threw the int 7");
  CHECK(text_of(std::string("a text")) == "threw the text \"a text\"");
  CHECK(text_of(static_cast<const char*>("a text")) == "threw the text \"a text\"");
  CHECK(text_of(static_cast<const char*>(nullptr)) == "threw an object of type char const*");
  CHECK(text_of(Mute{}) == "threw (anonymous namespace)::Mute");
  CHECK(text_of(Odd{}) == "threw an object of type (anonymous namespace)::Odd");
}

TEST_CASE("an exception of another language is described as something unknown", "[base][exception]") {
  _Unwind_Exception foreign{};
  foreign.exception_class = 0x6f74686572000000;  // not that of C++
  std::string text;
  try {
    _Unwind_RaiseException(&foreign);
  } catch (...) {
    text = describe_current_exception();
  }
  CHECK(text == "threw an object of type something unknown");
}

TEST_CASE("what an exception says is cut where it is very long", "[base][exception]") {
  const std::string text = text_of(std::runtime_error(std::string(20'000'000, 'x')));
  CHECK(text.size() < 5000);
  CHECK(text.find("...(20000000 bytes)...") != std::string::npos);
  CHECK(text_of(std::string(20'000'000, 'x')).size() < 5000);
}
