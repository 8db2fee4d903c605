// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <utility>

namespace orca {

/// The outcome of one lap of work(). The thesis has a bool here (true: WORK_DONE, false: WORK_FAILED). An
/// Outcome can also say "not yet", and a failure keeps its reason.
struct [[nodiscard]] Outcome {
  enum class Kind { again, done, failed };
  Kind kind = Kind::again;
  std::string reason;  ///< Set for a failure only.
};

/// Requests another lap when it is due.
inline Outcome again() { return {}; }

/// Reports that the task is finished: state WORK_DONE.
inline Outcome done() { return {Outcome::Kind::done, {}}; }

/// Reports that the task cannot be finished: state WORK_FAILED.
inline Outcome failed(std::string reason) { return {Outcome::Kind::failed, std::move(reason)}; }

}  // namespace orca
