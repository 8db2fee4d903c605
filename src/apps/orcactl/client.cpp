// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "client.hpp"

#include <pwd.h>

#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "no_answer/orphans.hpp"
#include "no_answer/silence.hpp"
#include "orca/base/files/own_folder.hpp"
#include "orca/base/text.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "orca/xml/names.hpp"

namespace orca::orcactl {
namespace {

Failure no_system(const std::string& what) {
  return {fail(Code::not_found, what + "; looked in " + OwnFolder::path_of_user()), ExitCode::no_deployer};
}

// Nobody can be reached: not that there is no system, but that it cannot be trusted, or takes nobody in.
Failure unreachable(const Error& why) { return {why, ExitCode::no_deployer}; }

std::variant<Descriptor, Failure> connect_to_user(const std::string& user, const std::string& system) {
  const passwd* const owner = getpwnam(user.c_str());
  if (owner == nullptr)
    return Failure{fail(Code::invalid_argument, "--of: this machine knows no user " + in_quotes(user)),
                   ExitCode::usage};
  Result<Descriptor> socket = supervisor::connect_to_shared(system, owner->pw_uid);
  if (socket) return std::move(socket).value();
  if (socket.error().code == Code::invalid_argument) return Failure{socket.error(), ExitCode::usage};
  return unreachable(socket.error());
}

}  // namespace

std::variant<Descriptor, Failure> connect_to(const apps::Call& call) {
  std::string name = call.text("--system").value_or("");
  if (const auto owner = call.text("--of")) return connect_to_user(*owner, name);
  if (name.empty()) {
    const Result<std::vector<std::string>> running = supervisor::running_systems();
    if (!running) return unreachable(running.error());
    if (running->empty()) return no_system("no system runs" + hint_at_orphans(name));
    if (running->size() > 1)
      return Failure{fail(Code::invalid_argument, "several systems run: " + listed(*running) +
                                                      "; choose one: --system " + running->front()),
                     ExitCode::usage};
    name = running->front();
  }
  Result<Descriptor> socket = supervisor::connect_to_system(name);
  if (socket) return std::move(socket).value();
  if (socket.error().code != Code::not_found) return unreachable(socket.error());
  const auto nearest = xml::nearest_name(name, supervisor::running_systems().value_or({}));
  return no_system(socket.error().message + xml::did_you_mean(nearest) + hint_at_orphans(name));
}

std::variant<Client, Failure> Client::connect(const apps::Call& call) {
  std::variant<Descriptor, Failure> socket = connect_to(call);
  if (auto* const failure = std::get_if<Failure>(&socket)) return std::move(*failure);
  const std::optional<ucred> deployer = supervisor::peer_of(std::get<Descriptor>(socket));
  Client client(std::get<Descriptor>(std::move(socket)));
  client.note_silence_ = [&call, process = deployer ? deployer->pid : 0] {
    if (const std::string text = silence_text(call, process); !text.empty())
      std::fprintf(stderr, "orcactl: %s\n", text.c_str());
  };
  return client;
}

Result<supervisor::Message> Client::next_message(Duration limit) {
  if (!note_silence_ || limit <= kSilence) return channel_->wait_for_message(limit);
  Result<supervisor::Message> message = channel_->wait_for_message(kSilence);
  if (message || message.error().code != Code::deadline_exceeded) return message;
  std::exchange(note_silence_, nullptr)();
  return channel_->wait_for_message(limit - kSilence);
}

Status Client::ask(const supervisor::Ask& ask, const Taker& taker, Duration limit) {
  const std::uint64_t request = ++last_request_;
  if (Status sent = channel_->send(supervisor::encode(ask, request), limit); !sent.ok()) return sent;
  for (;;) {
    Result<supervisor::Message> message = next_message(limit);
    if (!message) {
      if (message.error().code == Code::unavailable)
        return fail(Code::unavailable,
                    "the system has ended, or has closed the connection because it was asked more than 200 "
                    "times in a second, or because its answers were not read");
      if (message.error().code == Code::deadline_exceeded)
        return fail(Code::deadline_exceeded,
                    "the deployer has not answered for " + std::to_string(limit / 1s) + " s");
      return message.error();
    }
    if (message->request != request) continue;  // the rest of an earlier answer
    Result<supervisor::ControlAnswer> answer = supervisor::decode_answer(std::move(message).value());
    if (!answer) return answer.error();
    if (const auto* const end = std::get_if<supervisor::EndAnswer>(&*answer)) return end->outcome;
    taker(*answer);
  }
}

Result<supervisor::LineAnswer> Client::open_line(const std::string& port,
                                                 const std::vector<std::string>& options) {
  constexpr Duration kLimit = 10s;
  supervisor::Ask ask{"line", {port}, false};
  ask.words.insert(ask.words.end(), options.begin(), options.end());
  std::optional<supervisor::LineAnswer> line;
  const auto take = [&](supervisor::ControlAnswer& answer) {
    if (auto* const found = std::get_if<supervisor::LineAnswer>(&answer)) line.emplace(std::move(*found));
    if (const auto* const note = std::get_if<supervisor::NoteAnswer>(&answer))
      std::fprintf(stderr, "orcactl: %s\n", note->text.c_str());
  };
  if (const Status asked = this->ask(ask, take, kLimit); !asked.ok()) return asked.error();
  if (!line) return fail(Code::internal, "the supervisor has sent no line");
  return std::move(*line);
}

}  // namespace orca::orcactl
