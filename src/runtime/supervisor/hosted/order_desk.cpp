// SPDX-License-Identifier: LGPL-3.0-or-later
#include "order_desk.hpp"

#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>

#include <cerrno>
#include <cstdlib>
#include <optional>
#include <utility>

#include "counter_records.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/system.hpp"

namespace orca::supervisor {
namespace {

constexpr int kBeatMs = 20;
constexpr int kBeatsToGlance = 5;

Descriptor make_wake() {
  Descriptor wake(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!wake) throw_if_exhausted(errno);
  return wake;
}

host::PartOrder about(host::PartOrder::Kind kind, std::string component = {}) {
  return {kind, std::move(component)};
}

// Returns the order for the part, if it is one. Others are the desk's own.
std::optional<host::PartOrder> part_order(const Order& order) {
  using Kind = host::PartOrder::Kind;
  if (std::holds_alternative<OpenHardware>(order)) return about(Kind::open_hardware);
  if (std::holds_alternative<OpenGates>(order)) return about(Kind::open_gates);
  if (std::holds_alternative<TakeDown>(order)) return about(Kind::take_down);
  if (const auto* configure = std::get_if<Configure>(&order))
    return about(Kind::configure, configure->component);
  if (const auto* suspend = std::get_if<Suspend>(&order)) return about(Kind::suspend, suspend->component);
  if (const auto* resume = std::get_if<Resume>(&order)) return about(Kind::resume, resume->component);
  if (const auto* set = std::get_if<SetParams>(&order))
    return host::PartOrder{Kind::set_params, set->component, {set->values.begin(), set->values.end()}};
  return std::nullopt;
}

}  // namespace

OrderDesk::OrderDesk(Channel& channel, host::HostedPart& part, ReportSender& reports,
                     std::atomic<std::uint32_t>& heartbeat, bool shows)
    : channel_(channel),
      part_(part),
      reports_(reports),
      heartbeat_(heartbeat),
      shows_(shows),
      lines_(part),
      wake_(make_wake()),
      thread_([this] {
        pthread_setname_np(pthread_self(), "orders");
        work();
      }) {}

OrderDesk::~OrderDesk() {
  ending_.store(true);
  eventfd_write(wake_.number(), 1);
  thread_.join();
  heartbeat_.store(0);  // from here on silence is no hang
}

void OrderDesk::work() {
  for (int beats = 0; !ending_.load(); ++beats) {
    if (shows_) show_now_and_then(beats);
    heartbeat_.fetch_add(1, std::memory_order_relaxed);
    wait();
    (void)channel_.flush();  // its error comes back from receive()
    receive();
  }
}

void OrderDesk::wait() const {
  const short events = channel_.has_unsent() ? POLLIN | POLLOUT : POLLIN;
  pollfd fds[] = {{channel_.descriptor(), events, 0}, {wake_.number(), POLLIN, 0}};
  poll(fds, 2, kBeatMs);
}

void OrderDesk::show_now_and_then(int beats) {
  if (beats % kBeatsToGlance == 0) reports_.show(part_.look());
}

void OrderDesk::receive() {
  for (;;) {
    Result<std::optional<Message>> message = channel_.receive();
    if (!message) leave(message.error());
    if (!message->has_value()) return;
    const std::uint64_t request = (*message)->request;
    Result<Order> order = decode_order(std::move(**message));
    if (!order) leave(order.error());
    carry_out(std::move(order).value(), request);
  }
}

void OrderDesk::carry_out(Order order, std::uint64_t request) {
  if (std::optional<host::PartOrder> for_part = part_order(order))
    return pass_on(std::move(*for_part), request);
  if (const auto* cut = std::get_if<CutEdge>(&order))
    return part_.cut_edge(cut->edge, fail(Code::unavailable, cut->reason));
  if (const auto* alarm = std::get_if<TellAlarm>(&order)) return hear(*alarm);
  if (const auto* alarm = std::get_if<ForgetAlarm>(&order))
    return part_.forget_alarm(alarm->kind, alarm->source, alarm->process);
  std::optional<Answer> answer = answer_of(order);
  reports_.send(
      answer ? std::move(*answer) : Answer{fail(Code::failed_precondition, "this order comes too late")},
      request);
}

// Carries out an order that takes no time. Returns nothing if it is none of these.
std::optional<Answer> OrderDesk::answer_of(Order& order) {
  if (const auto* stop = std::get_if<StopMotors>(&order)) return part_.hold(stop->reason), Answer{};
  if (std::holds_alternative<ReleaseMotors>(order)) return part_.let_go(), Answer{};
  if (std::holds_alternative<Count>(order)) return Answer{ok(), to_records(part_.counters())};
  if (auto* line = std::get_if<OpenLine>(&order)) return Answer{lines_.open(std::move(*line))};
  if (auto* renew = std::get_if<RenewEdge>(&order))
    return Answer{part_.renew_edge(renew->edge.edge, std::move(renew->edge.memory))};
  return std::nullopt;
}

void OrderDesk::hear(const TellAlarm& told) {
  idl::Alarm alarm;
  if (const Status read = object_type<idl::Alarm>().deserialize(told.object, &alarm); !read.ok())
    leave(read.error());
  part_.hear(alarm, told.process);
}

void OrderDesk::pass_on(host::PartOrder order, std::uint64_t request) {
  order.done = [this, request](const Status& outcome) { reports_.send(Answer{outcome}, request); };
  part_.order(std::move(order));
}

// Nobody is left who could stop this process, so it stops itself: the motors first.
void OrderDesk::leave(const Error& reason) {
  part_.prepare_for_death();
  log::error("supervisor", reason.message + "; the robot is stopped and this process ends");
  std::_Exit(EXIT_FAILURE);
}

}  // namespace orca::supervisor
