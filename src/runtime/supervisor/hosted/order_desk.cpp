// SPDX-License-Identifier: LGPL-3.0-or-later
#include "order_desk.hpp"

#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <sys/eventfd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "agreed/graph_mark.hpp"
#include "counter_records.hpp"
#include "orca/base/distant_log.hpp"
#include "orca/base/exhaustion.hpp"
#include "orca/idl/bulk_pool.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/idl/system.hpp"
#include "orca/supervisor/log_name.hpp"
#include "orca/supervisor/meeting_place.hpp"

namespace orca::supervisor {
namespace {

constexpr int kBeatMs = 20;
constexpr int kBeatsToGlance = 5;
constexpr Duration kPlaceLook = 1s;  // until the next look at the file of the meeting place

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
  if (const auto* down = std::get_if<TakeDown>(&order)) {
    host::PartOrder taking = about(Kind::take_down);
    taking.keeps_states = down->keeps_states;
    return taking;
  }
  if (std::holds_alternative<AskUse>(order)) return about(Kind::check_unused);
  if (const auto* configure = std::get_if<Configure>(&order))
    return about(Kind::configure, configure->component);
  if (const auto* suspend = std::get_if<Suspend>(&order)) return about(Kind::suspend, suspend->component);
  if (const auto* resume = std::get_if<Resume>(&order)) return about(Kind::resume, resume->component);
  if (const auto* gate = std::get_if<OpenGate>(&order)) return about(Kind::open_gate, gate->component);
  if (const auto* gone = std::get_if<RemoveComponent>(&order)) return about(Kind::remove, gone->component);
  if (const auto* call = std::get_if<ConcludeCall>(&order)) {
    host::PartOrder conclusion = about(Kind::conclude, call->component);
    Result<std::string> outcome = call->before;
    if (!call->outcome.ok()) outcome = call->outcome.error();
    conclusion.outcome =
        std::make_shared<std::pair<std::uint64_t, Result<std::string>>>(call->number, outcome);
    return conclusion;
  }
  if (const auto* set = std::get_if<SetParams>(&order))
    return host::PartOrder{Kind::set_params, set->component, {set->values.begin(), set->values.end()}};
  return std::nullopt;
}

host::PartOrder connection_order(Rewire& rewire) {
  host::PartOrder order = about(host::PartOrder::Kind::rewire);
  order.connections = std::make_shared<std::vector<host::ConnectionChange>>();
  for (EdgeChange& change : rewire.changes)
    order.connections->push_back({std::move(change.edge), change.makes, std::move(change.memory)});
  return order;
}

host::PartOrder arrival_order(AddComponent& added) {
  host::PartOrder order = about(host::PartOrder::Kind::add, added.node.name);
  order.node = std::make_shared<graph::ComponentNode>(std::move(added.node));
  order.params = {added.values.begin(), added.values.end()};
  return order;
}

}  // namespace

void note_pool(EdgeMemory& edge) {
  if (!edge.pool) return;
  if (const Status noted = PeerPools::all().note(edge.peer, std::move(edge.pool)); !noted.ok())
    log::warning(edge.peer, "its bulk data will be copied: " + noted.error().message);
}

OrderDesk::OrderDesk(std::shared_ptr<Channel> channel, host::PartAccess& part, ReportSender& reports,
                     Site site)
    : channel_(std::move(channel)),
      part_(part),
      reports_(reports),
      site_(std::move(site)),
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
  site_.heartbeat.store(0);  // from here on silence is no hang
}

void OrderDesk::work() {
  for (int beats = 0; !ending_.load(); ++beats) {
    if (site_.shows) show_now_and_then(beats);
    tell_log_wish();
    site_.heartbeat.fetch_add(1, std::memory_order_relaxed);
    wait();
    channel_ != nullptr ? hear_supervisor() : keep_vigil();
    if (place_) look_after_place();
  }
}

// A deployer that does not find this process would start another one in its place.
void OrderDesk::look_after_place() {
  const Moment now = Moment::clock::now();
  if (now - place_seen_ < kPlaceLook) return;
  place_seen_ = now;
  const Result<bool> restored = place_->restore();
  if (restored && *restored)
    log::warning(site_.process,
                 "somebody has removed the socket at which a deployer finds this process; it is made again");
}

void OrderDesk::wait() const {
  std::vector<pollfd> all{{wake_.number(), POLLIN, 0}};
  if (channel_ != nullptr)
    all.push_back(
        {channel_->descriptor(), static_cast<short>(channel_->has_unsent() ? POLLIN | POLLOUT : POLLIN), 0});
  if (vigil_) vigil_->add_to(all);
  poll(all.data(), all.size(), kBeatMs);
}

void OrderDesk::show_now_and_then(int beats) {
  if (beats % kBeatsToGlance == 0) reports_.show(part_.look());
}

void OrderDesk::tell_log_wish() {
  const bool is_wanted = log::wants_distant();
  if (std::exchange(wants_lines_, is_wanted) != is_wanted) reports_.send(LogWished{is_wanted});
}

void OrderDesk::hear_supervisor() {
  (void)channel_->flush();  // its error comes back from receive()
  for (;;) {
    Result<std::optional<Message>> message = channel_->receive();
    if (!message) return lose_supervisor(message.error());
    if (!message->has_value()) break;
    if (!(*message)->descriptors.empty()) part_.open_descriptors([] {});  // they have come just now
    const std::uint64_t request = (*message)->request;
    Result<Order> order = decode_order(std::move(**message));
    if (!order) leave(order.error());
    carry_out({std::move(order).value(), request, channel_});
  }
  if (place_) turn_away_all();
}

// Nobody has anything to say to a process that has a supervisor.
void OrderDesk::turn_away_all() {
  for (;;) {
    const Result<Descriptor> visitor = place_->accept();
    if (!visitor || !*visitor) return;
  }
}

void OrderDesk::carry_out(Told told) {
  Order& order = told.order;
  if (std::holds_alternative<TakeDown>(order)) is_taken_down_ = true;
  if (std::optional<host::PartOrder> for_part = part_order(order)) return pass_on(std::move(*for_part), told);
  if (auto* swap = std::get_if<SwapCode>(&order)) return pass_on(*swap, told);
  if (auto* rewire = std::get_if<Rewire>(&order)) return pass_on(connection_order(*rewire), told);
  if (auto* added = std::get_if<AddComponent>(&order)) {
    site_.learn(*added);
    return pass_on(arrival_order(*added), told);
  }
  if (const auto* process = std::get_if<NoteProcess>(&order)) return site_.learn_process(*process);
  if (const auto* cut = std::get_if<CutEdge>(&order))
    return part_.cut_edge(cut->edge, fail(Code::unavailable, cut->reason));
  if (const auto* alarm = std::get_if<TellAlarm>(&order)) return hear(*alarm);
  if (const auto* lines = std::get_if<TellLines>(&order)) return hear(*lines);
  if (const auto* note = std::get_if<NoteGraph>(&order)) {
    graph_mark_ = mark_of(note->graph);
    return;
  }
  if (const auto* alarm = std::get_if<ForgetAlarm>(&order)) {
    reports_.remember([&](Recollection& all) { all.forget_alarm(*alarm); });
    return part_.forget_alarm(alarm->kind, alarm->source, alarm->process);
  }
  std::optional<Answer> answer = answer_of(order);
  if (!answer) answer = Answer{fail(Code::failed_precondition, "this order comes too late")};
  (void)told.by->post(encode(Report(std::move(*answer)), told.request));
}

// Carries out an order that takes no time. Returns nothing if it is none of these.
std::optional<Answer> OrderDesk::answer_of(Order& order) {
  if (const auto* stop = std::get_if<StopMotors>(&order)) {
    if (stop->only_devices)
      return Answer{part_.hold_devices(stop->reason) ? ok()
                                                     : Status(fail(Code::not_found, "it has no devices"))};
    reports_.remember([](Recollection& all) { all.note_held(true); });
    return part_.hold(stop->reason), Answer{};
  }
  if (std::holds_alternative<ReleaseMotors>(order)) {
    reports_.remember([](Recollection& all) { all.note_held(false); });
    return Answer{part_.let_go() ? ok() : Status(fail(Code::failed_precondition, "nothing is held"))};
  }
  if (auto* outlive = std::get_if<Outlive>(&order)) return Answer{prepare_to_outlive(*outlive)};
  if (std::holds_alternative<Count>(order)) return Answer{ok(), to_records(part_.counters())};
  if (auto* line = std::get_if<OpenLine>(&order)) return Answer{lines_.open(std::move(*line))};
  if (auto* renew = std::get_if<RenewEdge>(&order)) {
    note_pool(renew->edge);
    if (renew->edge.peer_is_new)
      part_.cut_edge(renew->edge.edge, fail(Code::unavailable, "its peer was replaced"));
    return Answer{part_.renew_edge(renew->edge.edge, std::move(renew->edge.memory))};
  }
  if (const auto* move = std::get_if<MoveEdge>(&order)) return Answer{part_.move_edge(move->edge)};
  return std::nullopt;
}

void OrderDesk::hear(const TellAlarm& told) {
  idl::Alarm alarm;
  if (const Status read = object_type<idl::Alarm>().deserialize(told.object, &alarm); !read.ok())
    leave(read.error());
  reports_.remember([&](Recollection& all) { all.note_alarm(alarm, told.process); });
  part_.hear(alarm, told.process);
}

void OrderDesk::hear(const TellLines& told) {
  for (const LogLine& line : told.lines)
    log::hear_distant({line.level, line.who, line.text, TimePoint(Duration(line.time))});
}

// Returns what the next supervisor must know once an order was carried out.
std::function<void(Recollection&)> OrderDesk::memorable(const Order& order) {
  if (const auto* set = std::get_if<SetParams>(&order))
    return [set = *set](Recollection& all) { all.note_params(set.component, set.values); };
  if (const auto* gone = std::get_if<RemoveComponent>(&order))
    return [gone = *gone](Recollection& all) { all.forget_component(gone.component); };
  return [](Recollection&) {};
}

// The answer goes to whoever has given the order, even if there is another supervisor by then.
void OrderDesk::pass_on(host::PartOrder order, const Told& told) {
  order.done = [this, by = told.by, request = told.request,
                done = memorable(told.order)](const Status& outcome) {
    if (outcome.ok()) reports_.remember(done);
    (void)by->post(encode(Report(Answer{outcome}), request));
  };
  part_.order(std::move(order));
}

void OrderDesk::pass_on(SwapCode& swap, const Told& told) {
  host::PartOrder order = about(host::PartOrder::Kind::swap, swap.component);
  order.swap = std::make_shared<host::SwapOrder>(
      host::SwapOrder{swap.component,
                      plugin::PluginImage(std::move(swap.plugin), swap.origin),
                      swap.type,
                      {swap.values.begin(), swap.values.end()},
                      Duration(swap.probation),
                      swap.tried ? plugin::Trial::done : plugin::Trial::now,
                      swap.fresh});
  order.swapped = [this, by = told.by, request = told.request, component = swap.component,
                   file = swap.origin](const Result<host::SwapReport>& outcome) {
    if (outcome)
      reports_.send(ExchangedCode{component,
                                  outcome->new_type,
                                  file,
                                  outcome->build_id,
                                  ++swaps_[component],
                                  outcome->params,
                                  {outcome->values.begin(), outcome->values.end()}});
    Answer answer{outcome ? Status(ok()) : Status(outcome.error())};
    if (outcome) answer.records.push_back(to_record(*outcome));
    (void)by->post(encode(Report(std::move(answer)), request));
  };
  part_.order(std::move(order));
}

// ---- Without a supervisor

Status OrderDesk::prepare_to_outlive(Outlive& order) {
  std::optional<Result<ControlSocket>> place;
  part_.open_descriptors([&] { place.emplace(open_meeting_place(site_.system, site_.process)); });
  if (!*place) return place->error();
  place_.emplace(std::move(*place).value());
  will_.emplace(std::move(order));
  return ok();
}

void OrderDesk::lose_supervisor(const Error& reason) {
  if (!will_ || is_taken_down_ || reason.code != Code::unavailable) leave(reason);
  channel_.reset();
  reports_.lose_supervisor();
  vigil_.emplace(*place_, [this] { return introduction(); });
  vigil_ends_at_ = Moment::clock::now() + std::chrono::nanoseconds(will_->wait);
  log::warning(site_.process, "the deployer is gone; this process goes on, and waits for another one");
}

void OrderDesk::keep_vigil() {
  const Moment now = Moment::clock::now();
  if (will_->wait > 0 && now >= vigil_ends_at_)
    leave(fail(Code::deadline_exceeded, "no other deployer came"));
  std::optional<Told> told = vigil_->turn(now);
  if (!told) return;
  std::holds_alternative<Adopt>(told->order) ? adopt(*told) : carry_out(std::move(*told));
}

void OrderDesk::adopt(const Told& told) {
  vigil_.reset();
  channel_ = told.by;
  wants_lines_ = false;
  reports_.greet(channel_);
  (void)channel_->post(encode(Report(Answer{}), told.request));
}

Orphaned OrderDesk::introduction() const {
  Orphaned self = site_.introduce();
  if (graph_mark_) self.graph = *graph_mark_;
  self.output = Descriptor(fcntl(will_->output.number(), F_DUPFD_CLOEXEC, 0));
  if (!self.output) throw_if_exhausted(errno);
  return self;
}

// Nobody is left who could stop this process, so it stops itself: the motors first.
void OrderDesk::leave(const Error& reason) {
  part_.prepare_for_death();
  log::error(kLogName, reason.message + "; the robot is stopped and this process ends");
  remove_meeting_place();
  std::_Exit(EXIT_FAILURE);
}

}  // namespace orca::supervisor
