// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/result.hpp"

namespace orca::view {

/// What somebody may do who has opened the page.
enum class Role { reader, operator_ };

/// The answer to a reader who gives orders.
inline constexpr const char* kOnlyLooks = "this address may only look; for orders open the one for operators";

/// The tokens of a run of orcaview: whoever knows one may look, or look and steer.
class Tokens {
 public:
  /// Draws new ones, 128 bits each, from the system's random device.
  /// @errors  unavailable if it gives none.
  [[nodiscard]] static Result<Tokens> draw();

  /// Returns the role of whoever knows a token; nothing if it is none. Takes the same time for each wrong one.
  [[nodiscard]] std::optional<Role> role_of(std::string_view token) const;

  [[nodiscard]] const std::string& of(Role role) const { return role == Role::reader ? reader_ : operator_; }

 private:
  Tokens(std::string reader, std::string steering)
      : reader_(std::move(reader)), operator_(std::move(steering)) {}

  std::string reader_;
  std::string operator_;
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

/// Returns whether a reader may give this command of orcactl: it shows something and changes nothing.
[[nodiscard]] bool only_shows(std::string_view command, bool has_words);

}  // namespace orca::view
