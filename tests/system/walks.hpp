// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <catch2/catch.hpp>
#include <iostream>

#include "deployer.hpp"

namespace orca::test {

/// Ten worlds to drive about in: a drawn office, one corridor, and two of each other family.
inline const std::vector<std::string> kTenWorlds{
    "office.xml",   "office_floor.xml#1", "office_floor.xml#2", "barn_like.xml#1",    "barn_like.xml#2",
    "u_trap.xml#1", "u_trap.xml#2",       "narrow_doors.xml#1", "narrow_doors.xml#2", "corridor.xml#1"};

/// Lets a robot walk at random in each of the ten worlds for a simulated time, and prints the number of
/// contacts.
inline void walk_in_ten_worlds(const std::string& time, Seconds limit) {
  for (const std::string& world : kTenWorlds) {
    const Run run = run_deployer(Words{source_file("graphs/random_walk.xml"), "--until", time, "--log", "off",
                                       "--set", "world=" + source_file("sim/worlds/" + world)} +
                                     virtual_clock(),
                                 limit);
    CAPTURE(world);
    INFO(run.err);
    CHECK(run.ended);
    CHECK(run.exit_code() == 0);
    CHECK(run.trace_hash());
    std::cout << world << ": " << run.contacts().size() << " contacts in " << time << std::endl;
  }
}

}  // namespace orca::test
