// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "orca/patterns/push.hpp"

namespace orca {

/// Waits for several PushProxies of one component (thesis 7.4, Fig. 7.11). It only waits: taking the objects
/// stays with the proxies.
///
/// Every wait throws Interrupted when the component must leave its lap.
/// Thread contract: the component's strand.
class Synchronizer {
 public:
  void add(PushProxyHandle& subject);
  void remove(PushProxyHandle& subject);

  /// Blocks until this subject has new data.
  /// @pre  the subject was added.
  void wait(PushProxyHandle& subject);

  /// Blocks until any subject has new data, and returns that one; of several the one added first.
  /// @pre  at least one subject was added.
  PushProxyHandle& wait();

  /// Blocks until all subjects have new data.
  void wait_all();

  /// The same, at most `limit`.
  /// @return whether all have new data.
  bool wait_all(Duration limit);

 private:
  [[nodiscard]] Strand& strand() const;
  [[nodiscard]] bool all_new() const;
  [[nodiscard]] PushProxyHandle* first_new() const;

  std::vector<PushProxyHandle*> subjects_;
};

}  // namespace orca
