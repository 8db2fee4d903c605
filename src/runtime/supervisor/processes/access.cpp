// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/access.hpp"

#include <grp.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "orca/base/text.hpp"
#include "orca/supervisor/control_socket.hpp"

namespace orca::supervisor {
namespace {

constexpr Access kGiven[] = {Access::observe, Access::operate, Access::change};

Error wrong(const std::string& text) {
  return fail(Code::invalid_argument,
              "ROLE=user:NAME or ROLE=group:NAME is expected, ROLE being observe, operate or change, such as "
              "operate=user:anna, not " +
                  in_quotes(text));
}

std::optional<id_t> number_in(const std::string& text) {
  id_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc{} && end == text.data() + text.size() ? std::optional(number) : std::nullopt;
}

std::optional<id_t> user_of(const std::string& name) {
  const passwd* const found = getpwnam(name.c_str());
  return found == nullptr ? number_in(name) : found->pw_uid;
}

std::optional<id_t> group_of(const std::string& name) {
  const group* const found = getgrnam(name.c_str());
  return found == nullptr ? number_in(name) : found->gr_gid;
}

bool concerns(const Grant& grant, const Asker& asker) {
  if (!grant.is_group) return grant.id == asker.who.uid;
  return grant.id == asker.who.gid || std::ranges::find(asker.groups, grant.id) != asker.groups.end();
}

}  // namespace

Asker asker_at(const Descriptor& socket) {
  const std::optional<ucred> peer = peer_of(socket);
  if (!peer) return {};
  Asker asker{*peer, {}};
  socklen_t size = 0;
  (void)getsockopt(socket.number(), SOL_SOCKET, SO_PEERGROUPS, nullptr, &size);  // says how much there is
  asker.groups.resize(size / sizeof(gid_t));
  if (size > 0 && getsockopt(socket.number(), SOL_SOCKET, SO_PEERGROUPS, asker.groups.data(), &size) != 0)
    asker.groups.clear();
  return asker;
}

Result<Grant> read_grant(const std::string& text) {
  const auto equals = text.find('=');
  const auto colon = text.find(':');
  if (equals == std::string::npos || colon == std::string::npos || colon < equals) return wrong(text);
  const std::string role = text.substr(0, equals);
  const std::string kind = text.substr(equals + 1, colon - equals - 1);
  const std::string name = text.substr(colon + 1);
  const auto* const access = std::ranges::find(kGiven, role, to_string);
  if (access == std::end(kGiven) || (kind != "user" && kind != "group") || name.empty()) return wrong(text);
  const std::optional<id_t> id = kind == "group" ? group_of(name) : user_of(name);
  if (!id) return fail(Code::invalid_argument, "this machine knows no " + kind + " " + in_quotes(name));
  return Grant{*access, kind == "group", *id};
}

Access access_of(const Asker& asker, const std::vector<Grant>& grants) {
  if (asker.who.uid == 0 || asker.who.uid == geteuid()) return Access::change;
  Access most = Access::none;
  for (const Grant& grant : grants)
    if (concerns(grant, asker)) most = std::max(most, grant.access);
  return most;
}

}  // namespace orca::supervisor
