// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"

namespace orca::plugin {

/// The line from the copy of the process in which a trial runs to the process that waits for it.
///
/// Thread contract: one thread of the copy at a time.
class TrialLine {
 public:
  virtual ~TrialLine() = default;

  /// Announces the next step, in words for people. The last one says how far the copy has come.
  virtual void step(const std::string& what) = 0;
  /// Hands over a finding; any bytes.
  virtual void find(const std::string& finding) = 0;
  /// Asks the process that waits, and blocks until it has answered; any bytes. The wait does not count as time of the trial.
  [[nodiscard]] virtual std::string ask(const std::string& question) = 0;
  /// Ends the trial well from wherever it is.
  [[noreturn]] virtual void end() = 0;
};

/// The result of a trial.
struct TrialResult {
  enum class Ending {
    well,      ///< It came to its end.
    died,      ///< A signal, exit() or an exception that nothing can catch ended the copy.
    too_long,  ///< It was ended at its time limit.
    effect,    ///< It was ended before it left a trace outside the copy.
    silent,    ///< It could not be tried, or not be heard; this says nothing about the code.
  };
  Ending ending = Ending::silent;
  std::string last_step;
  std::string text;  ///< How it ended, after the last step: "ended the process with exit(3)"; empty if well.
  std::vector<std::string> findings;
};

/// The effects that a trial may have outside its copy of the process.
enum class Effects {
  any,  ///< All that the code has.
  none,  ///< It is ended before it opens a file for writing or a device, changes the file system, reaches for another
  ///< process, starts one, or talks to a network.
};

/// Answers what the copy asks: see TrialLine::ask().
using TrialAnswerer = std::function<std::string(const std::string& question)>;

/// Runs `attempt` in a copy of this process, so that a crash, exit() or endless loop affects only the copy. Its
/// changes to memory are lost, its standard streams lead nowhere. An exception is not a failure of the trial.
///
/// @param limit    [s of the steady clock] for the whole trial.
/// @param give_up  asked several times a second; true ends the trial, with the ending `silent`. Empty: never.
/// @param answer   empty: all questions get an empty answer.
/// @errors  ending `silent` with the reason in `text`; kNoMemoryText if the copy found no memory.
/// @thread  any; the copy has only the calling thread.
[[nodiscard]] TrialResult run_trial(const std::function<void(TrialLine&)>& attempt, Duration limit,
                                    Effects effects, const std::function<bool()>& give_up = {},
                                    const TrialAnswerer& answer = {});

/// Runs `attempt` in a copy of this process, with any effects, and says whether the copy survived it.
///
/// @param attempt  calls its argument before each step with a description of the step, for people.
/// @errors  internal with the step and how it ended the copy; deadline_exceeded if it takes too long; unavailable if it
///          could not be tried, with kNoMemoryText if there is no memory.
/// @thread  any; the copy has only the calling thread.
[[nodiscard]] Status survives_trial(
    const std::function<void(const std::function<void(const std::string&)>&)>& attempt, Duration limit);

}  // namespace orca::plugin
