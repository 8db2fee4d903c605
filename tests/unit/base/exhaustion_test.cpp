// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>
#include <cerrno>
#include <new>
#include <string>
#include <system_error>

#include "orca/base/exhaustion.hpp"

using namespace orca;

namespace {

std::string text_of(int error_number) {
  try {
    throw_if_exhausted(error_number);
  } catch (...) {
    return exhaustion_text(std::current_exception());
  }
  return {};
}

}  // namespace

TEST_CASE("lack of memory, threads and descriptors is exhaustion, each with what to do",
          "[base][exhaustion]") {
  CHECK(text_of(ENOMEM).find("ulimit -v") != std::string::npos);
  CHECK(text_of(EAGAIN).find("ulimit -u") != std::string::npos);
  for (const int number : {EMFILE, ENFILE}) CHECK(text_of(number).find("ulimit -n") != std::string::npos);
  CHECK(exhaustion_text(std::make_exception_ptr(std::bad_alloc())) == text_of(ENOMEM));
}

TEST_CASE("other errors are no exhaustion", "[base][exhaustion]") {
  CHECK_NOTHROW(throw_if_exhausted(ENOENT));
  CHECK_NOTHROW(throw_if_exhausted(0));
  const std::error_code missing(ENOENT, std::generic_category());
  CHECK(exhaustion_text(std::make_exception_ptr(std::system_error(missing))) == nullptr);
  CHECK(exhaustion_text(std::make_exception_ptr(std::runtime_error("no memory"))) == nullptr);
  CHECK(exhaustion_text(std::make_exception_ptr(42)) == nullptr);
  CHECK(exhaustion_text(nullptr) == nullptr);
}
