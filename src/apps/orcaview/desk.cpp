// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "desk.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "answers.hpp"
#include "session.hpp"

namespace orca::view {

using nlohmann::json;

Desk::Desk(const boost::asio::any_io_executor& loop, const std::string& system,
           const SystemLink::Connect& connect, bool is_recorded)
    : is_recorded_(is_recorded),
      link_(loop, system, connect, [this](bool is_up) { changed(is_up); }),
      log_link_(loop, system, connect,
                [this](bool is_up) {
                  has_asked_ = false;
                  if (is_up) ask_for_log();
                }),
      ports_(link_, loop) {}

void Desk::start() {
  link_.start();
  log_link_.start();
}

void Desk::join(Session& session) { sessions_.push_back(&session); }

void Desk::leave(Session& session) {
  std::erase(sessions_, &session);
  std::erase_if(followers_, [&](const Follower& one) { return one.session == &session; });
}

void Desk::follow_log(Session& session, std::uint32_t id) {
  leave_log(session, id);
  constexpr std::ptrdiff_t kMost = 8;  // of one session
  if (std::ranges::count(followers_, &session, &Follower::session) >= kMost) return;
  followers_.push_back({&session, id});
  ask_for_log();
}

void Desk::leave_log(const Session& session, std::uint32_t id) {
  std::erase_if(followers_, [&](const Follower& one) { return one.session == &session && one.id == id; });
}

void Desk::ask_for_log() {
  if (has_asked_ || followers_.empty() || !log_link_.is_up()) return;
  has_asked_ = true;
  log_link_.ask(
      {"log", {"--follow", "--level", "info"}, true},
      [this](supervisor::ControlAnswer answer) {
        const auto* const record = std::get_if<supervisor::RecordAnswer>(&answer);
        if (record == nullptr) return;
        const json line = json_of(record->record);
        for (const Follower& one : std::vector(followers_)) one.session->hear(one.id, line);
      },
      [](const Status&) {});
}

void Desk::begin_anew() {
  for (Session* const session : std::vector(sessions_)) session->time_moved();
  ports_.look_anew();
}

void Desk::changed(bool is_up) {
  for (Session* const session : std::vector(sessions_)) session->system_changed(is_up);
}

}  // namespace orca::view
