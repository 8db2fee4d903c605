// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "orca/base/descriptor.hpp"

namespace orca::supervisor {

/// The kinds of message on a control channel. The numbers travel; a kind keeps its number.
enum class Kind : std::uint16_t {
  // Orders: from the supervisor to a host process.
  setup = 1,
  build,
  open_hardware,
  configure,
  open_gates,
  take_down,
  stop_motors,
  suspend,
  resume,
  set_params,
  renew_edge,
  cut_edge,
  tell_alarm,
  forget_alarm,
  release_motors,
  count,
  open_line,
  meet = 31,
  say,
  outlive = 61,
  adopt,
  move_edge,
  ask_use = 51,
  tell_lines,
  swap_code = 71,
  note_graph = 72,
  rewire = 73,
  add_component = 74,
  remove_component = 75,
  open_gate = 76,
  note_process = 77,
  conclude_call = 78,
  // Reports: from a host process to the supervisor.
  answer = 101,
  built,
  state_change,
  arrived,
  goal_failed,
  contact,
  alarm,
  logged,
  last_words,
  rest_change,
  tally,
  output_failed,
  glance,
  prompting,
  mission_step,
  heard = 131,
  orphaned = 161,
  standing,
  leaving,
  log_wish = 151,
  exchanged_code = 171,
  state_kept,
  peer_called,
  edge_damaged,
  // Words of an operator's program and the answers: see orca/supervisor/control.hpp.
  ask = 201,
  record_answer = 301,
  text_answer,
  line_answer,
  end_answer,
  note_answer,
  // On a line between an operator's program and ports.
  tapped = 401,
  offer,
  offer_outcome,
  end_line,
  line_ended,
};

/// One message of a control channel, encoded. orca/supervisor/vocabulary.hpp gives it a meaning.
///
/// A plain value that owns its descriptors.
struct Message {
  Kind kind{};
  std::uint64_t request =
      0;  ///< The answer to an order repeats the order's number; 0: no answer is expected.
  std::vector<std::byte> body;
  std::vector<Descriptor> descriptors;  ///< All open.
};

}  // namespace orca::supervisor
