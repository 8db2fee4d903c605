// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::view {

/// What a page asks for, in one message. A plain value.
struct Wish {
  enum class Op { ask, cancel, layout, look, unlook, query, send, types };
  Op op = Op::ask;
  std::uint32_t id = 0;              ///< Chosen by the page; the answer repeats it.
  std::string command{};             ///< Of orcactl, for ask.
  std::vector<std::string> words{};  ///< Its words.
  bool streams = false;              ///< Its records are wanted as they come.
  std::string graph{};               ///< A graph, in place of the file that the first word would name.
  bool as_text = false;              ///< A text is wanted as for people, not as JSON.
  std::string layout{};              ///< To be kept; empty: it is asked for.
  std::string port{};                ///< For look, query and send.
  double rate = 0.0;                 ///< [1/s] Most objects of a look, from 0.001 to 1000; 0: all.
  std::string xml{};                 ///< The object for query and send, in its text form.
};

/// Reads a message of a page. The page is not trusted.
/// @param id  becomes the number of the message, also if something else in it is wrong; 0 if it has none.
/// @errors  invalid_argument, with what is wrong.
[[nodiscard]] Result<Wish> read_wish(const std::string& text, std::uint32_t& id);

}  // namespace orca::view
