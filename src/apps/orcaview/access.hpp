// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/supervisor/role.hpp"

namespace orca::view {

/// What somebody may do who has opened the page. Which order takes which role, the supervisor knows.
using Role = supervisor::Access;

/// The tokens of a run of orcaview, one for each role: whoever knows one has it.
class Tokens {
 public:
  /// Draws new ones, 128 bits each, from the system's random device.
  /// @errors  unavailable if it gives none.
  [[nodiscard]] static Result<Tokens> draw();

  /// Returns the role of whoever knows a token; nothing if it is none. Takes the same time for each wrong one.
  [[nodiscard]] std::optional<Role> role_of(std::string_view token) const;

  /// @param role  of kRoles.
  [[nodiscard]] const std::string& of(Role role) const { return tokens_.at(role); }

  /// Those that have a token, the one that may most first.
  static constexpr Role kRoles[] = {Role::change, Role::operate, Role::observe};

 private:
  explicit Tokens(std::map<Role, std::string> tokens) : tokens_(std::move(tokens)) {}

  std::map<Role, std::string> tokens_;
};

/// How browsers call this server at one of its doors. A plain value.
struct Calling {
  std::string scheme = "http";
  /// Hosts in small letters, IPv6 in brackets; "*.lab.org" stands for each name with one part more than lab.org.
  std::vector<std::string> names{"127.0.0.1", "localhost", "[::1]"};
};

/// Returns whether a request calls this server by one of its names, at whatever port: ssh -L may have another one than this
/// server. A page of somebody else that lets its own name point here (DNS rebinding) names that.
/// @param host  header Host.
[[nodiscard]] bool is_own_host(std::string_view host, const Calling& calling = {});

/// Returns whether a request comes from a page of this server, or from no page at all.
/// @param origin  header Origin; empty: there is none, so that it is no browser.
[[nodiscard]] bool is_own_origin(std::string_view origin, std::string_view host, const Calling& calling = {});

/// Returns the value of a name in the query of a request's target, such as token in "/ws?token=1f"; empty: there is none.
[[nodiscard]] std::string query_value(std::string_view target, std::string_view name);

/// Returns whether an object in its text form is a question that carries no order: an Ask or an AskReading. orcaview asks these itself,
/// whoever looks.
[[nodiscard]] bool only_asks(std::string_view xml);

}  // namespace orca::view
