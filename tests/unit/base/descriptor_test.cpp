// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/base/descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <utility>

using orca::Descriptor;

namespace {

int null_device() { return open("/dev/null", O_RDONLY | O_CLOEXEC); }
bool holds(int number) { return fcntl(number, F_GETFD) >= 0; }

}  // namespace

TEST_CASE("a descriptor is closed with its owner, and belongs to one owner at a time", "[base][descriptor]") {
  const int number = null_device();
  REQUIRE(number >= 0);
  {
    Descriptor first(number);
    CHECK(first);
    CHECK(first.number() == number);
    Descriptor second(std::move(first));
    CHECK(second.number() == number);
    Descriptor third(null_device());
    const int replaced = third.number();
    third = std::move(second);
    CHECK(third.number() == number);
    CHECK_FALSE(holds(replaced));
    CHECK(holds(number));
  }
  CHECK_FALSE(holds(number));
}

TEST_CASE("a descriptor that was given away stays open", "[base][descriptor]") {
  int number = -1;
  {
    Descriptor owner(null_device());
    number = owner.release();
    CHECK_FALSE(owner);
  }
  CHECK(holds(number));
  close(number);
}

TEST_CASE("an empty descriptor has the number -1, however it became empty", "[base][descriptor]") {
  const Descriptor none;
  const Descriptor failed(-7);
  Descriptor moved(null_device());
  const Descriptor moved_to(std::move(moved));
  Descriptor assigned(null_device());
  Descriptor assigned_to;
  assigned_to = std::move(assigned);
  Descriptor released(null_device());
  close(released.release());
  Descriptor reset(null_device());
  reset.reset();
  for (const Descriptor* const one :
       {&none, &failed, &std::as_const(moved), &std::as_const(assigned), &std::as_const(released),
        &std::as_const(reset)}) {  // NOLINT: what moving leaves
    CHECK_FALSE(*one);
    CHECK(one->number() == -1);
  }
}

TEST_CASE("0 is the number of a descriptor like any other", "[base][descriptor]") {
  const int kept = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 3);
  close(STDIN_FILENO);
  const int number = null_device();  // the lowest that is free
  {
    const Descriptor owner(number);
    CHECK(owner);
    CHECK(owner.number() == number);
  }
  const bool was_closed = !holds(number);
  if (kept >= 0) {
    dup2(kept, STDIN_FILENO);
    close(kept);
  }
  CHECK(number == 0);
  CHECK(was_closed);
}
