// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "no_answer/orphans.hpp"

#include <poll.h>

#include <algorithm>
#include <cstdio>
#include <future>
#include <utility>
#include <vector>

#include "asking.hpp"
#include "orca/base/text.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "orca/supervisor/meeting_place.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::orcactl {
namespace {

using supervisor::Order;
using supervisor::Waiting;

constexpr Duration kAnswerLimit = 5s;
constexpr Duration kMotorsLimit = 2s;  // to say so early that an emergency stop is not confirmed
constexpr int kEndMs = 3000;

// Returns the systems of which processes run without a deployer.
std::vector<std::string> orphaned_systems(const std::string& system) {
  std::vector<std::string> orphaned = supervisor::waiting_systems();
  const std::vector<std::string> running = supervisor::running_systems().value_or({});
  std::erase_if(orphaned, [&](const std::string& name) {
    return std::ranges::find(running, name) != running.end() || (!system.empty() && name != system);
  });
  return orphaned;
}

std::optional<Order> order_of(const apps::Call& call) {
  if (call.command->name == "stop") return supervisor::TakeDown{};
  if (call.command->name != "estop") return std::nullopt;
  if (call.has("--release")) return supervisor::ReleaseMotors{};
  return supervisor::StopMotors{"emergency stop; an operator releases it with: orcactl estop --release"};
}

Result<supervisor::Report> next_report(supervisor::Channel& channel, Duration limit) {
  Result<supervisor::Message> message = channel.wait_for_message(limit);
  if (!message && message.error().code == Code::deadline_exceeded)
    return fail(Code::deadline_exceeded, "it has not answered for " + seconds_text(limit) +
                                             ", and what it moves may go on: take the power from the motors");
  if (!message) return message.error();
  return supervisor::decode_report(std::move(message).value());
}

// Gives an order to a process, and waits until it is carried out. Returns the name of the process.
Result<std::string> give(Waiting& waiting, Order order) {
  const bool is_end = std::holds_alternative<supervisor::TakeDown>(order);
  const Duration limit = is_end ? kAnswerLimit : kMotorsLimit;
  supervisor::Channel channel(std::move(waiting.connection));
  const Result<supervisor::Report> first = next_report(channel, limit);
  if (!first) return first.error();
  const auto* const self = std::get_if<supervisor::Orphaned>(&*first);
  if (self == nullptr) return fail(Code::data_loss, "it does not say who it is");
  if (Status sent = channel.send(supervisor::encode(std::move(order), 1), limit); !sent.ok())
    return sent.error();
  const Result<supervisor::Report> answer = next_report(channel, limit);
  if (!answer) return answer.error();
  const auto* const said = std::get_if<supervisor::Answer>(&*answer);
  if (said == nullptr) return fail(Code::data_loss, "it does not answer");
  if (!said->outcome.ok()) return said->outcome.error();
  pollfd end{waiting.pidfd.number(), POLLIN, 0};
  if (is_end && poll(&end, 1, kEndMs) == 0) return fail(Code::deadline_exceeded, "it does not end");
  return self->process;
}

ExitCode give_all(const std::string& system, const apps::Call& call) {
  std::vector<std::string> obeyed;
  ExitCode code = ExitCode::done;
  std::vector<Waiting> all = supervisor::connect_to_waiting(system);
  // At once, so that none waits for another one that does not answer; one after the other if there are no threads to be had.
  std::vector<std::future<Result<std::string>>> given;
  for (Waiting& waiting : all)
    given.push_back(std::async(std::launch::async | std::launch::deferred,
                               [&] { return give(waiting, *order_of(call)); }));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Result<std::string> name = given[i].get();
    if (name)
      obeyed.push_back(*name);
    else
      code = report({fail(name.error().code, "process " + std::to_string(all[i].pid) + " of " + system +
                                                 ": " + name.error().message)});
  }
  if (obeyed.empty() && code == ExitCode::done)
    return report(
        {fail(Code::not_found, "no process of " + system + " could be reached"), ExitCode::no_deployer});
  if (!obeyed.empty())
    std::fprintf(stderr, "orcactl: no deployer runs; obeyed by the processes themselves: %s\n",
                 listed(obeyed).c_str());
  return code;
}

}  // namespace

std::string hint_at_orphans(const std::string& system) {
  const std::vector<std::string> orphaned = orphaned_systems(system);
  if (orphaned.empty()) return "";
  return "; but processes of " + listed(orphaned) +
         " go on without a deployer: start it again, or end them: orcactl --system " + orphaned.front() +
         " stop";
}

std::optional<ExitCode> order_orphans(const apps::Call& call) {
  if (!order_of(call)) return std::nullopt;
  const std::vector<std::string> orphaned = orphaned_systems(call.text("--system").value_or(""));
  if (orphaned.empty()) return std::nullopt;
  if (orphaned.size() == 1) return give_all(orphaned.front(), call);
  return report({fail(Code::invalid_argument,
                      "processes of several systems run without a deployer: " + listed(orphaned) +
                          "; choose one: --system " + orphaned.front()),
                 ExitCode::usage});
}

}  // namespace orca::orcactl
