// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <vector>

#include "comparison.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "scans.hpp"
#include "two_processes.hpp"

namespace orca::bench {

/// Two components in two processes that push to each other over shared memory: each waits for the other's object
/// before it pushes its own, so every push meets a component that is blocked.
class ProcessPushPair {
 public:
  ProcessPushPair(Executive& executive, std::size_t ranges);
  ~ProcessPushPair();

  /// @return time from the call of push() until the other component has the object [ns].
  Nanoseconds time(int round_trips);

 private:
  struct Both;

  void echo(Executive& executive);
  void connect(Both& peer, bool is_child);

  const std::size_t ranges_;
  test::SharedPage page_;
  MemoryFile there_;
  MemoryFile back_;
  test::OtherProcess other_;
  std::unique_ptr<Both> one_;
};

/// A component that asks another in another process.
class ProcessQueryPair {
 public:
  explicit ProcessQueryPair(Executive& executive);
  ~ProcessQueryPair();

  /// @return time of one question with its answer [ns].
  Nanoseconds time(int questions);

 private:
  struct Asker;

  void answer(Executive& executive);

  test::SharedPage page_;
  MemoryFile file_;
  test::OtherProcess other_;
  std::unique_ptr<Asker> asker_;
};

}  // namespace orca::bench
