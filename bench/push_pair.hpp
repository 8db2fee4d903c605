// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "comparison.hpp"
#include "scans.hpp"

namespace orca::bench {

/// Two components that push to each other: each waits for the other's object before it pushes its own, so
/// every push meets a component that is blocked.
class PushPair {
 public:
  PushPair(Executive& executive, std::size_t ranges) : PushPair(executive, ranges, local_) {}
  /// @param links  join the two; they outlive the pair.
  PushPair(Executive& executive, std::size_t ranges, Links& links);

  /// @return time from the call of push() until the other component has the object [ns].
  Nanoseconds time(int round_trips);

 private:
  struct Both : test::Peer {
    Both(Executive& executive, const std::string& name) : Peer(executive, name) {}
    void push_next() { out.push(std::move(ready[next++])); }

    PushServer<Scan> out{*this, "out"};
    PushProxy<Scan> in{*this, "in"};
    std::vector<Loan<Scan>> ready;
    std::size_t next = 0;
  };

  const std::size_t ranges_;
  LocalLinks local_;
  Both one_;
  Both other_;
  std::optional<test::Script> echo_;
};

}  // namespace orca::bench
