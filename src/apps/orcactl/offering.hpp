// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <string>

#include "client.hpp"
#include "common/command_line.hpp"
#include "exit_code.hpp"
#include "orca/base/result.hpp"
#include "orca/idl/object.hpp"
#include "orca/xml/diagnostics.hpp"

namespace orca::orcactl {

/// Reads an object for a port from its text form.
/// @param source       of the text, for what is wrong with it.
/// @param type         of the objects that the port takes.
/// @param diagnostics  takes all that is wrong with the text.
/// @errors  invalid_argument if it is no such object, or if a number in it is none; unimplemented if the type is not known
///          here.
[[nodiscard]] Result<ObjectLoan> object_from(const std::string& text, const std::string& source,
                                             const std::string& type, xml::Diagnostics& diagnostics);

inline constexpr Duration kAnswerLimit =
    std::chrono::seconds(5);  ///< Longest wait for an answer, without --timeout.

/// Asks a QueryServer.
/// @return its reply.
/// @errors  those of the server; unavailable if its process ends; deadline_exceeded after `limit`; invalid_argument if the port
///          answers no questions.
[[nodiscard]] Result<ObjectLoan> ask_port(Client& client, const std::string& port, const ObjectLoan& question,
                                          Duration limit);

/// Carries out send or query: hands an object to a port, and prints the reply.
[[nodiscard]] ExitCode offer(const apps::Call& call);

}  // namespace orca::orcactl
