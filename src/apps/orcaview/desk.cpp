// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "desk.hpp"

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "answers.hpp"
#include "page.hpp"

namespace orca::view {

using nlohmann::json;

Desk::Desk(const boost::asio::any_io_executor& loop, const std::string& system)
    : link_(loop, system, [this](bool is_up) { changed(is_up); }),
      log_link_(loop, system,
                [this](bool is_up) {
                  has_asked_ = false;
                  if (is_up) ask_for_log();
                }),
      ports_(link_, loop) {}

void Desk::start() {
  link_.start();
  log_link_.start();
}

void Desk::join(Page& page) { pages_.push_back(&page); }

void Desk::leave(Page& page) {
  std::erase(pages_, &page);
  std::erase_if(followers_, [&](const Follower& one) { return one.page == &page; });
}

void Desk::follow_log(Page& page, std::uint64_t id) {
  followers_.push_back({&page, id});
  ask_for_log();
}

void Desk::leave_log(const Page& page, std::uint64_t id) {
  std::erase_if(followers_, [&](const Follower& one) { return one.page == &page && one.id == id; });
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
        for (const Follower& one : std::vector(followers_))
          one.page->say({{"op", "record"}, {"id", one.id}, {"record", line}});
      },
      [](const Status&) {});
}

std::string Desk::greeting(Role role) const {
  using Seconds = std::chrono::duration<double>;
  const Seconds time = std::chrono::system_clock::now().time_since_epoch();
  return json({{"op", "hello"},
               {"system", link_.system()},
               {"role", role == Role::reader ? "reader" : "operator"},
               {"present", link_.is_up()},
               {"time", time.count()},
               {"version", ORCA_VERSION}})
      .dump();
}

void Desk::changed(bool is_up) {
  for (Page* const page : std::vector(pages_)) {
    if (is_up)
      page->greet();
    else
      page->say({{"op", "system"}, {"present", false}});
  }
}

}  // namespace orca::view
