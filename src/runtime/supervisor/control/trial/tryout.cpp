// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/trial/tryout.hpp"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <utility>

#include "orca/idl/object_type.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::supervisor {
namespace {

using Clock = std::chrono::steady_clock;
using host::SeenObject;

constexpr int kLookMs = 50;                                  // between two looks at the time
constexpr std::size_t kUnsentBound = std::size_t{1} << 16;   // [bytes] that wait to be sent: nothing is
constexpr std::size_t kLongestSeen = std::size_t{16} << 20;  // [bytes] of an object
constexpr std::size_t kMostBytes = std::size_t{256} << 20;   // of all objects

// A port whose objects are collected.
class Listener {
 public:
  explicit Listener(WatchedPort watched)
      : port_(std::move(watched.port)), line_(std::move(watched.line), kUnsentBound, kLongestSeen) {}

  [[nodiscard]] pollfd waits_for() const { return {is_open_ ? line_.descriptor() : -1, POLLIN, 0}; }

  // Appends what has come. A line that ends, or holds something else, is not listened to any more.
  void take(std::vector<SeenObject>& all, std::size_t& bytes) {
    while (is_open_) {
      Result<std::optional<Message>> message = line_.receive();
      is_open_ = static_cast<bool>(message);
      if (!is_open_ || !message->has_value()) return;
      bytes += (*message)->body.size();
      is_open_ = append(std::move(**message), all);
    }
  }

 private:
  bool append(Message message, std::vector<SeenObject>& all) const {
    const Result<LineWord> word = decode_line_word(std::move(message));
    const auto* const passed = word ? std::get_if<Tapped>(&*word) : nullptr;
    const ObjectType* const type = passed == nullptr ? nullptr : find_object_type(passed->type);
    if (type == nullptr) return false;
    ObjectLoan object = make_object(*type);
    if (!type->deserialize(passed->object, object.get()).ok()) return false;
    all.push_back({port_, std::move(object), TimePoint(Duration(passed->passed))});
    return true;
  }

  std::string port_;
  Channel line_;
  bool is_open_ = true;
};

// Returns what reaches ports within a time, in the order of the times.
std::vector<SeenObject> watch(std::vector<WatchedPort> ports, Duration span,
                              const std::function<bool()>& give_up) {
  std::vector<std::unique_ptr<Listener>> listeners;
  for (WatchedPort& port : ports) listeners.push_back(std::make_unique<Listener>(std::move(port)));
  std::vector<SeenObject> seen;
  std::size_t bytes = 0;
  for (const auto end = Clock::now() + span; Clock::now() < end && bytes < kMostBytes && !give_up();) {
    std::vector<pollfd> all;
    for (const auto& listener : listeners) all.push_back(listener->waits_for());
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end - Clock::now()).count();
    poll(all.data(), all.size(), static_cast<int>(std::clamp<long>(left, 0, kLookMs)));
    for (const auto& listener : listeners) listener->take(seen, bytes);
  }
  std::ranges::stable_sort(seen, {}, &SeenObject::time);
  return seen;
}

}  // namespace

Result<host::ShadowReport> try_out(host::ShadowOrder order, plugin::PluginImage& plugin, TryoutLines lines,
                                   const std::function<bool()>& give_up) {
  std::vector<SeenObject> seen = watch(std::move(lines.ports), order.span, give_up);
  Questioner questioner(std::move(lines.servers), give_up);
  order.answer = [&](const graph::PortRef& server, ObjectLoan question) {
    return questioner.ask(server, std::move(question));
  };
  Result<host::ShadowReport> outcome = host::run_in_shadow(order, plugin, seen, give_up);
  // A failure without an answer says nothing about the code.
  if (!outcome && outcome.error().code == Code::failed_precondition && !questioner.silence().empty())
    return host::ShadowReport{questioner.silence() + "; then " + outcome.error().text(), 0, 0};
  return outcome;
}

}  // namespace orca::supervisor
