// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/host/shadow.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "containment/process_watches.hpp"
#include "orca/base/text.hpp"
#include "orca/graph/settings.hpp"
#include "orca/host/last_words.hpp"
#include "orca/patterns/endpoints/push_server_endpoint.hpp"
#include "orca/plugin/trial.hpp"
#include "outer_offers.hpp"
#include "run/swap/fit.hpp"
#include "run/system/component_making.hpp"
#include "run/trial/backdrop.hpp"
#include "run/trial/quiet_run.hpp"
#include "run/trial/trial_servers.hpp"

namespace orca::host {
namespace {

using plugin::TrialLine;
using plugin::TrialResult;

constexpr Duration kMostTime = 10s;              // that the copy may take besides the span
constexpr std::uint64_t kSeed = 1;               // as of a run that is given none
constexpr rlim_t kMostMemory = rlim_t{2} << 30;  // [bytes] of private memory
constexpr const char* kLaps = "its laps, in the shadow of the present one,";

// What the copy says at its end: a mark, then a text.
enum class Mark : char { refused = 'r', well = 'w' };

// What the copy says, which is the end of it, and its watch over what all components of a process share: one that changes it could end the process of the
// system, or hinder others there.
class Verdict {
 public:
  explicit Verdict(TrialLine& line) : line_(line) {
    for (const auto& watch : watches_) watch->keep();
  }

  void step(const char* name) { line_.step(name); }
  std::string ask(const std::string& question) { return line_.ask(question); }
  void refuse(const std::string& why) { say(Mark::refused, why); }
  // @param what  it has been given and has pushed.
  void take(const std::string& what) { say(Mark::well, what); }
  void refuse_changes() {
    std::vector<std::string> deeds;
    for (const auto& watch : watches_)
      if (const auto found = watch->look()) deeds.push_back(found->deed);
    if (!deeds.empty())
      refuse("it has " + joined(deeds, ", ") + "; a component must leave alone what all share");
  }

 private:
  void say(Mark mark, const std::string& text) {
    line_.find(static_cast<char>(mark) + text);
    line_.end();
  }

  TrialLine& line_;
  const std::vector<std::unique_ptr<Watch>> watches_ = make_process_watches();
};

// The new object in the copy of the process.
class Shadow {
 public:
  Shadow(const ShadowOrder& order, std::vector<SeenObject>& seen, Executive& executive, Verdict& verdict)
      : order_(order), seen_(seen), executive_(executive), verdict_(verdict) {}

  Status make(PluginCatalogue& catalogue, LoadedType type) {
    type_ = std::move(type);
    const Result<Contract> contract = plugin::describe_component(*type_.entry, type_.file(), nullptr);
    if (!contract) return contract.error();
    ComponentSettings settings = settings_of(*order_.graph.find_component(order_.component));
    const std::vector<std::string> faults = misfits_in(order_.graph, settings, order_.ports, contract->ports);
    if (!faults.empty())
      return fail(Code::failed_precondition, order_.type + " cannot take its place: " + joined(faults, "; "));
    Result<ParamValues> params = inherited(contract->params, order_.params, order_.new_params);
    if (!params) return params.error();
    settings.params = std::move(params).value();
    settings.on_demand = false;
    settings.autonomous = true;
    object_ = std::make_unique<ComponentInstance>(
        quiet_.context(), std::move(settings), [this] { return Result<LoadedType>(type_); },
        [&catalogue](LoadedType gone) { return catalogue.release(std::move(gone)); }, nullptr);
    if (Status loaded = object_->load(); !loaded.ok()) return loaded;
    return backdrop_.connect(order_.graph, *object_, &servers_);
  }

  // Runs as the executive's main task.
  void work(PluginCatalogue& catalogue) {
    const TimePoint first = seen_.empty() ? executive_.now() : std::max(executive_.now(), seen_[0].time);
    wait_until_holds(executive_, *changed_, first, [] { return false; });
    verdict_.step("its configure()");
    object_->start();
    reach(ComponentState::idle);
    verdict_.step(kLaps);
    object_->open_gate();
    reach(ComponentState::work);
    follow(executive_.now());
    verdict_.refuse_changes();
    const std::string well = std::to_string(given_) + " " + std::to_string(pushed());
    obey(
        "its suspend()", [&] { return object_->order_suspend(); }, Refusal::is_none);
    obey(
        "its resume()", [&] { return object_->order_resume(); }, Refusal::is_none);
    obey(
        "its save_state() or load_state()", [&] { return object_->order_state_check(); }, Refusal::counts);
    verdict_.refuse_changes();
    verdict_.step("its end");
    end(catalogue);
    verdict_.take(well);
  }

 private:
  // Waits until the object is in a state, or has failed before.
  void reach(ComponentState state) {
    const auto is_there = [&] { return object_->state() == state || object_->has_failed(); };
    wait_until_holds(executive_, *changed_, saturating_add(executive_.now(), kMostTime), is_there);
    conclude_if_failed();
  }

  // Gives it all objects at their times, and the rest of the span to work.
  void follow(TimePoint begin) {
    for (SeenObject& seen : seen_) {
      work_until(saturating_add(begin, seen.time - seen_[0].time));
      give(seen);
    }
    work_until(saturating_add(begin, order_.span));
  }

  void work_until(TimePoint time) {
    wait_until_holds(executive_, *changed_, time, [this] { return object_->has_failed(); });
    conclude_if_failed();
  }

  void conclude_if_failed() {
    if (object_->has_failed()) verdict_.refuse(object_->failure());
  }

  enum class Refusal { is_none, counts };  // an order that does not suit the object's state is no fault of it

  // Lets the object carry out an order, unless it is in a long lap. The step is named first: the object may crash at once.
  template <class Give>
  void obey(const char* step, Give give_order, Refusal refusal) {
    verdict_.step(step);
    const std::shared_ptr<Order> order = give_order();
    wait_until_holds(executive_, *changed_, saturating_add(executive_.now(), kMostTime),
                     [&] { return order->done() || object_->has_failed(); });
    conclude_if_failed();
    if (refusal == Refusal::counts && order->done() && !order->result().ok())
      verdict_.refuse(order->result().error().text());
  }

  // Stops the object, destroys it and unloads its code.
  void end(PluginCatalogue& catalogue) {
    object_->request_exit();
    if (!object_->join_until(saturating_add(executive_.now(), kMostTime))) verdict_.refuse("it does not end");
    conclude_if_failed();
    if (const Status gone = object_->destroy(); !gone.ok()) verdict_.refuse(gone.error().text());
    object_.reset();
    verdict_.refuse_changes();
    if (const Status gone = catalogue.release(std::exchange(type_, {})); !gone.ok())
      verdict_.refuse(gone.error().text());
  }

  void give(SeenObject& seen) {
    Endpoint* const port = object_->endpoint(seen.port);
    if (port == nullptr) return;
    ++given_;
    if (port->contract().pattern != Pattern::push) {
      (void)offers_.offer(*port, std::move(seen.object), [](const Result<ObjectRef>&) {});
      return;
    }
    const std::optional<graph::PortRef> source = source_of(seen);
    if (source) backdrop_.push(*source, std::move(seen.object).seal());
  }

  // Returns the port that pushed an object: the one of the component that the object names, if there are several.
  [[nodiscard]] std::optional<graph::PortRef> source_of(SeenObject& seen) const {
    std::optional<graph::PortRef> source;
    for (const graph::Edge& edge : order_.graph.edges) {
      if (edge.to.component != order_.component || edge.to.port != seen.port) continue;
      if (!source || edge.from.component == seen.object.header().origin()) source = edge.from;
    }
    return source;
  }

  [[nodiscard]] std::uint64_t pushed() const {
    std::uint64_t count = 0;
    for (const PortContract& port : object_->parts().ports.contracts())
      if (const auto* const server = dynamic_cast<PushServerEndpoint*>(object_->endpoint(port.name)))
        count += server->pushed_count();
    return count;
  }

  const ShadowOrder& order_;
  std::vector<SeenObject>& seen_;
  Executive& executive_;
  Verdict& verdict_;
  const std::unique_ptr<Event> changed_ = executive_.make_event();
  std::atomic<std::uint64_t> missions_{0};
  QuietRun quiet_{executive_, "shadow", kSeed, [this] { changed_->notify(); }, missions_};
  OuterOffers offers_{executive_, nullptr};
  TrialServers servers_{[this](const std::string& question) { return verdict_.ask(question); }};
  LoadedType type_;
  Backdrop backdrop_{executive_};
  std::unique_ptr<ComponentInstance> object_;
  std::uint64_t given_ = 0;
};

void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__)  // which reserves more than there is
  const rlimit limit{kMostMemory, kMostMemory};
  (void)setrlimit(RLIMIT_DATA, &limit);
#endif
}

// Runs in the copy of the process. Nothing is ever destroyed, because the copy ends here.
void play(const ShadowOrder& order, plugin::PluginImage& plugin, std::vector<SeenObject>& seen,
          TrialLine& line) {
  LastWords::leave_copy();
  limit_memory();
  auto& verdict = *new Verdict(line);
  verdict.step("its static initialisation, its constructor or its destructor");
  auto& catalogue = *new PluginCatalogue(plugin::PluginIndex({}));
  Result<LoadedType> type =
      catalogue.acquire(std::move(plugin), PluginKind::component, order.type, plugin::Trial::done);
  if (!type) return verdict.refuse(type.error().text());
  const bool needs_machine = type->library != nullptr && !type->library->virtual_time_faults().empty();
  const auto options = needs_machine ? ExecutiveOptions{ClockKind::steady, Backend::thread}
                                     : ExecutiveOptions{ClockKind::virtual_time, Backend::fiber};
  Result<std::unique_ptr<Executive>> made = make_executive(options);
  if (!made) return;
  Executive& executive = *std::move(made).value().release();
  auto& shadow = *new Shadow(order, seen, executive, verdict);
  if (const Status ready = shadow.make(catalogue, std::move(*type)); !ready.ok())
    return verdict.refuse(ready.error().text());
  executive.run([&] { shadow.work(catalogue); });
}

ShadowReport untried(const std::string& why) { return {why, 0, 0}; }

Result<ShadowReport> read(const std::string& finding) {
  const std::string text = finding.substr(1);
  const auto mark = static_cast<Mark>(finding[0]);
  if (mark == Mark::refused) return fail(Code::failed_precondition, text);
  return ShadowReport{"", std::stoull(text), std::stoull(text.substr(text.find(' ')))};
}

Result<ShadowReport> judged(const TrialResult& tried) {
  const std::string how = tried.last_step + " " + tried.text;
  switch (tried.ending) {
    case TrialResult::Ending::well:
      return tried.findings.empty() ? untried("the copy of the process said nothing")
                                    : read(tried.findings[0]);
    case TrialResult::Ending::died: return fail(Code::internal, how);
    case TrialResult::Ending::too_long: return fail(Code::deadline_exceeded, how);
    case TrialResult::Ending::effect:
    case TrialResult::Ending::silent: return untried(how);
  }
  return untried(how);
}

// Answers a question from the copy of the process.
std::string answered(const ShadowOrder& order, const std::string& bytes) {
  Result<TrialQuestion> question = unpacked_question(bytes);
  if (!question) return packed_answer(question.error());
  if (!order.answer) return packed_answer(fail(Code::unavailable, "nobody answers in a trial"));
  return packed_answer(order.answer(question->server, std::move(question->object)));
}

}  // namespace

Result<ShadowReport> run_in_shadow(const ShadowOrder& order, plugin::PluginImage& plugin,
                                   std::vector<SeenObject>& seen, const std::function<bool()>& give_up) {
  if constexpr (!kTriesCode) return untried("ThreadSanitizer cannot follow a copy of a process");
  return judged(plugin::run_trial([&](TrialLine& line) { play(order, plugin, seen, line); },
                                  order.span + kMostTime, plugin::Effects::none, give_up,
                                  [&](const std::string& question) { return answered(order, question); }));
}

}  // namespace orca::host
