// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "progress.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "orca/base/live_line.hpp"

namespace orca::simbatch {
namespace {

constexpr std::chrono::seconds kBetweenLines{10};

std::string left_text(double seconds) {
  const long whole = std::lround(seconds);
  if (whole < 120) return std::to_string(whole) + " s";
  if (whole < 7200) return std::to_string(whole / 60) + " min";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole / 60 % 60) + " min";
}

std::string percent(std::size_t part, std::size_t whole) {
  return std::to_string(std::lround(100.0 * static_cast<double>(part) / static_cast<double>(whole))) + " %";
}

}  // namespace

Progress::Progress(const batch::Experiment& experiment, batch::Store& store, std::size_t wanted)
    : experiment_(experiment),
      store_(store),
      wanted_(wanted),
      live_(isatty(STDERR_FILENO) != 0),
      of_variant_(experiment.variants.size()) {}

Status Progress::finished(std::size_t number, const batch::Outcome& outcome, const batch::Cost& cost) {
  const batch::Run run = experiment_.run(number);
  if (Status added = store_.add(batch::Row{experiment_.variants[run.variant].name,
                                           experiment_.worlds[run.world].name, run.seed, outcome, cost});
      !added.ok())
    return added;
  ++done_;
  ++of_variant_[run.variant].done;
  if (outcome.ending == batch::Ending::success) ++of_variant_[run.variant].successes;
  if (outcome.ending >= batch::Ending::failed) ++failed_;
  return ok();
}

Status Progress::repeated(std::size_t number, const batch::Repeat& repeat) {
  const batch::Run run = experiment_.run(number);
  if (!repeat.difference.empty()) {
    const LiveLine::Pause pause;
    std::fprintf(stderr, "warning: %s depends on more than its seed; made twice, the runs part: %s\n",
                 name_of(number).c_str(), repeat.difference.c_str());
  }
  return store_.add(batch::RepeatRow{experiment_.variants[run.variant].name,
                                     experiment_.worlds[run.world].name, run.seed, repeat});
}

void Progress::overloaded(std::size_t number, const std::string& why, bool again) {
  const LiveLine::Pause pause;
  std::fprintf(stderr, "warning: the machine is overloaded, %s is no result: %s; %s\n",
               name_of(number).c_str(), why.c_str(),
               again ? "it is made again" : "it is left out after several tries");
}

std::string Progress::name_of(std::size_t number) const {
  const batch::Run run = experiment_.run(number);
  return "variant " + experiment_.variants[run.variant].name + " in world " +
         experiment_.worlds[run.world].name + " with seed " + std::to_string(run.seed);
}

std::string Progress::text(std::size_t running) const {
  const double taken = std::chrono::duration<double>(Clock::now() - start_).count();
  std::string line = std::to_string(done_) + " of " + std::to_string(wanted_) + " runs";
  if (failed_ > 0) line += ", " + std::to_string(failed_) + " failed";
  if (done_ > 0 && done_ < wanted_) {
    const double each = taken / static_cast<double>(done_);
    line += ", " + std::to_string(std::lround(3600.0 / each)) + " an hour, about " +
            left_text(each * static_cast<double>(wanted_ - done_)) + " left";
  }
  for (std::size_t i = 0; i < of_variant_.size(); ++i)
    if (of_variant_[i].done > 0)
      line +=
          "; " + experiment_.variants[i].name + " " + percent(of_variant_[i].successes, of_variant_[i].done);
  return running == 0 ? line : line + " (" + std::to_string(running) + " running)";
}

void Progress::tick(std::size_t running) {
  if (live_) {
    LiveLine::show(STDERR_FILENO, text(running));
  } else if (Clock::now() >= next_line_) {
    next_line_ = Clock::now() + kBetweenLines;
    std::fprintf(stderr, "%s\n", text(running).c_str());
  }
}

void Progress::end() {
  LiveLine::erase();
  std::fprintf(stderr, "%s\n", text(0).c_str());
}

}  // namespace orca::simbatch
