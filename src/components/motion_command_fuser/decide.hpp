// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "arbitration.hpp"
#include "fusion.hpp"
#include "voice.hpp"

namespace orca::fuse {

enum class Mode { weighted, priority, vote, vector_sum, subsumption };

/// @pre  text is one of kModes.
[[nodiscard]] Mode mode_of(std::string_view text);
inline const std::vector<std::string> kModes{"weighted", "priority", "vote", "vector_sum", "subsumption"};

/// The rules by which the voices of the behaviours become one command.
struct Rules {
  Mode mode = Mode::weighted;
  double max_age = 0.0;  ///< [s] older wishes do not count.
  Ballot ballot;
  std::vector<std::string> order;     ///< Mode priority: the first named comes first.
  Wiring wiring;                      ///< Mode subsumption.
  std::vector<std::string> required;  ///< Must be among the voices.
};

enum class Verdict { fused, no_wish, told_to_stop, required_silent };

/// The movement that the robot shall make, and the reason.
struct Decision {
  Verdict verdict = Verdict::no_wish;  ///< All but `fused` mean: stop.
  Wish command;                        ///< If fused.
  std::vector<double> shares;          ///< [1] of each voice in the command, in their order.
  std::string decided_by;              ///< Who had the largest share, said stop, or was silent; or empty.
};

/// Decides on a command; safety comes before any mode. The robot stops if any behaviour has said full stop, if
/// one has been silent for longer than its limit or is lost, or if a required one is not listened to. Messages without an
/// opinion, messages that are too old and wishes without weight never count.
///
/// @param last_rate  [rad/s] decided in the lap before.
[[nodiscard]] Decision decide(std::span<const Voice> voices, const Rules& rules, double last_rate);

}  // namespace orca::fuse
