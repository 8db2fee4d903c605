// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "comparison.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "scans.hpp"
#include "two_processes.hpp"

namespace orca::bench {

/// The objects that a pair pushes. An order tells the other process to make so many of a size ready.
struct Order {
  int count;
  std::size_t size;
};
struct ScanLoad {
  using Object = Scan;
  static void fill(Object& scan, std::size_t size) { scan.ranges().assign(size, 1.0); }
  static void order(Object& scan, const Order& order);
  static std::optional<Order> ordered(const Object& scan);
};
/// Their sizes are in bytes. What is large is not copied, because both processes have a pool for it.
struct ImageLoad {
  using Object = idl::Image;
  static void fill(Object& image, std::size_t size) { image.data().assign(size, 1); }
  static void order(Object& image, const Order& order);
  static std::optional<Order> ordered(const Object& image);
};

/// Two components in two processes that push to each other over shared memory: each waits for the other's object
/// before it pushes its own, so every push meets a component that is blocked.
template <class Load>
class ProcessPushPair {
 public:
  explicit ProcessPushPair(Executive& executive);
  ~ProcessPushPair();

  /// @return time from the call of push() until the other component has the object [ns].
  Nanoseconds time(int round_trips, std::size_t size);

 private:
  struct Both;

  void echo(Executive& executive);
  void connect(Both& peer, bool is_child);

  test::SharedPage page_;
  MemoryFile there_;
  MemoryFile back_;
  MemoryFile pool_there_;
  test::OtherProcess other_;
  std::unique_ptr<Both> one_;
};

extern template class ProcessPushPair<ScanLoad>;
extern template class ProcessPushPair<ImageLoad>;

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
