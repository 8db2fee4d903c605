// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/host_process_main.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "agreed/graph_mark.hpp"
#include "agreed/run_wishes.hpp"
#include "doorbells.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/log.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/graph/loader.hpp"
#include "orca/graph/placement.hpp"
#include "orca/host/hosted_part.hpp"
#include "orca/host/stop_signal.hpp"
#include "orca/idl/bulk_pool.hpp"
#include "orca/plugin/index.hpp"
#include "orca/supervisor/channel.hpp"
#include "orca/supervisor/meeting_place.hpp"
#include "orca/supervisor/own_process.hpp"
#include "orca/supervisor/run_page.hpp"
#include "orca/supervisor/system_facts.hpp"
#include "order_desk.hpp"
#include "peers_process.hpp"
#include "report_sender.hpp"

namespace orca::supervisor {
namespace {

constexpr Duration kOrderLimit = 10s;

// An order together with the number that its answer repeats.
struct Numbered {
  Order order;
  std::uint64_t request = 0;
};

Result<Numbered> next_order(Channel& channel) {
  Result<Message> message = channel.wait_for_message(kOrderLimit);
  if (!message) return message.error();
  const std::uint64_t request = message->request;
  Result<Order> order = decode_order(std::move(message).value());
  if (!order) return order.error();
  return Numbered{std::move(order).value(), request};
}

Error wrong_sequence() { return fail(Code::data_loss, "the supervisor's orders come in a wrong sequence"); }

using Memory = std::map<std::string, Descriptor>;

Memory memory_of(std::vector<EdgeMemory>& edges) {
  Memory memory;
  for (EdgeMemory& edge : edges) {
    note_pool(edge);
    memory.emplace(edge.edge, std::move(edge.memory));
  }
  return memory;
}

// Waits for the order to build, and returns its number; nothing if there is nothing to do but to end. Meanwhile peers may
// end and be started again, which changes the memory of edges.
Result<std::optional<std::uint64_t>> await_build(Channel& channel, Memory& memory) {
  for (;;) {
    Result<Numbered> next = next_order(channel);
    if (!next) return next.error();
    if (std::holds_alternative<Build>(next->order)) return std::optional(next->request);
    if (std::holds_alternative<TakeDown>(next->order)) {
      (void)channel.send(encode(Report(Answer{}), next->request), kOrderLimit);
      return std::optional<std::uint64_t>();
    }
    if (std::holds_alternative<CutEdge>(next->order)) continue;  // new memory will come
    auto* const renew = std::get_if<RenewEdge>(&next->order);
    if (renew == nullptr) return wrong_sequence();
    note_pool(renew->edge);
    memory.insert_or_assign(renew->edge.edge, std::move(renew->edge.memory));
  }
}

host::KeptStates states_of(const Setup& setup) {
  host::KeptStates states;
  for (const StateKept& kept : setup.states) states[kept.component] = {{kept.type, kept.version}, kept.state};
  return states;
}

// The life of a host process, step by step.
class Life {
 public:
  Life(std::shared_ptr<Channel> channel, const std::vector<std::string>& plugin_folders,
       host::StopSignal& stop)
      : stop_(stop), channel_(std::move(channel)), catalogue_(plugin::PluginIndex(plugin_folders)) {}
  ~Life() { LiveLine::on_pause(nullptr); }
  Life(const Life&) = delete;
  Life& operator=(const Life&) = delete;

  Status live(Setup setup, std::uint64_t request) {
    Status made = prepare(setup);
    answer(made, request);
    if (!made.ok()) return made;
    if (setup.pool)
      if (const Status given = BulkPool::own().provide(std::move(setup.pool)); !given.ok()) return given;
    Memory memory = memory_of(setup.edges);
    const auto build = await_build(*channel_, memory);
    if (!build) return build.error();
    if (!build->has_value()) return ok();
    made = part_->build(std::move(memory));
    if (made.ok()) reports_->send(Built{robots(), builds()});
    answer(made, **build);
    if (!made.ok()) return made;
    work();
    reports_->send_last(Leaving{});
    return ok();
  }

 private:
  void answer(const Status& outcome, std::uint64_t request) {
    (void)channel_->post(encode(Report(Answer{outcome}), request));  // its end is seen elsewhere
  }

  Status prepare(Setup& setup) {
    const Result<RunWishes> wishes = read_wishes(setup.options);
    if (!wishes) return wishes.error();
    options_ = setup.options;
    mark_ = mark_of(setup.graph);
    set_process_name(setup.process);
    set_steady_epoch(wishes->epoch);
    log::set_level(log::Level::off);  // the supervisor writes the log
    log::set_clock([start = wishes->start] { return TimePoint(steady_now() - start); });
    reports_.emplace(channel_, setup.process, *wishes);
    LiveLine::on_pause([this](bool begins) { reports_->send(Prompting{begins}); });
    if (Status loaded = load(setup); !loaded.ok()) return loaded;
    if (Status placed = place(setup.process); !placed.ok()) return placed;
    Result<RunPage> page =
        RunPage::map(std::move(setup.run_page), setup.processes.size(), setup.doorbells.size());
    if (!page) return page.error();
    page_.emplace(std::move(page).value());
    const auto place = std::ranges::find(setup.processes, setup.process);
    if (place == setup.processes.end())
      return fail(Code::data_loss, "the run page has no place for process " + setup.process);
    place_ = static_cast<std::size_t>(place - setup.processes.begin());
    if (Status own = page_->belong_to(place_); !own.ok()) return own;
    doorbells_.emplace(*whole_, processes_, wishes->executor,
                       Doorbells::Words{std::move(setup.doorbells), std::move(setup.processes)}, *page_);
    shows_ = wishes->outputs.looks_on;
    return make_part(setup, *wishes);
  }

  Status load(const Setup& setup) {
    xml::Diagnostics diagnostics;
    whole_ = graph::load_text(setup.graph, "the system's graph", {}, catalogue_, diagnostics);
    if (!whole_)
      return fail(Code::failed_precondition,
                  "the plugins have changed since the system was checked:\n" + diagnostics.text());
    return ok();
  }

  // Finds out which process of which machine this is.
  Status place(const std::string& process) {
    processes_ = graph::processes_of(*whole_);
    const auto node = std::ranges::find(processes_, process, &graph::ProcessNode::name);
    if (node == processes_.end()) return fail(Code::data_loss, "nothing runs in process \"" + process + "\"");
    node_ = *node;
    processes_ = graph::processes_on(*whole_, node_.machine);
    return ok();
  }

  Status make_part(const Setup& setup, const RunWishes& wishes) {
    const std::string& process = setup.process;
    executor_ = wishes.executor;
    if (node_.lock_memory)
      if (const auto refused = lock_memory()) log::warning(process, *refused);
    Result<std::unique_ptr<Executive>> executive = make_executive(executive_options());
    if (!executive) return executive.error();
    executive_ = std::move(executive).value();
    host::PartOptions options{wishes.seed,
                              wishes.failures,
                              process,
                              is_declared(process) ? node_.hang_limit : Duration{0},
                              &page_->missions(),
                              {},
                              wishes.outputs,
                              wishes.run,
                              states_of(setup),
                              {}};
    if (whole_->machines.size() > 1)
      options.clock_ahead = [this](std::size_t machine) {
        const bool has_word = machine < RunPage::kMostMachines;
        return Duration(has_word ? page_->clock_ahead(machine).load(std::memory_order_relaxed) : 0);
      };
    if (graph::processes_of(*whole_).size() > 1)
      options.doorbell = [this](const std::string& component) { return &doorbells_->of(component); };
    part_.emplace(*whole_, process, host::PartPlace{catalogue_, *executive_, *reports_}, options);
    return ok();
  }

  ExecutiveOptions executive_options() {
    ExecutiveOptions options{ClockKind::steady, executor_.value_or(node_.executor), node_.spin};
    if (options.backend == Backend::fiber) options.doorbell = &page_->process_doorbell(place_);
    return options;
  }

  // A process that the graph does not declare is everything: a component that computes for long does not end it.
  [[nodiscard]] bool is_declared(const std::string& process) const {
    return std::ranges::find(whole_->processes, process, &graph::ProcessNode::name) !=
           whole_->processes.end();
  }

  [[nodiscard]] Pairs robots() const {
    const auto robots = part_->robots();
    return {robots.begin(), robots.end()};
  }

  [[nodiscard]] Pairs builds() {
    const auto builds = builds_in(*whole_, node_.name, catalogue_);
    return {builds.begin(), builds.end()};
  }

  // For a supervisor that has not started this process. The output is the desk's.
  [[nodiscard]] Orphaned introduction() const {
    Doorbells::Words words = doorbells_->words();
    return {node_.name,
            mark_,
            options_,
            page_->descriptor(),
            {},
            std::move(words.components),
            std::move(words.processes)};
  }

  OrderDesk::Site site() {
    return {whole_->name,
            node_.name,
            page_->heartbeat(place_),
            shows_,
            [this] { return introduction(); },
            [this](const AddComponent& added) { doorbells_->add(added.node, added.doorbell); },
            [this](const NoteProcess& noted) {
              doorbells_->add_process(noted.process, noted.place, noted.is_of_fibers);
            }};
  }

  void work() {
    stop_.on_crash([this] {
      part_->prepare_for_death();
      remove_meeting_place();
    });
    stop_.on_request([this] { part_->order({.kind = host::PartOrder::Kind::take_down}); });
    {
      const OrderDesk desk(channel_, *part_, *reports_, site());
      die_with_supervisor(false);  // the desk sees its end, and stops the motors first
      part_->run();
      part_->write_outputs();
      die_with_supervisor(true);
    }
    stop_.on_request(nullptr);
    stop_.on_crash(nullptr);
  }

  host::StopSignal& stop_;
  const std::shared_ptr<Channel> channel_;  // to the supervisor that has started this process
  host::PluginCatalogue catalogue_;
  std::optional<ReportSender> reports_;
  std::optional<graph::Graph> whole_;
  std::optional<RunPage> page_;
  std::optional<Doorbells> doorbells_;
  std::vector<graph::ProcessNode> processes_;  // of this machine
  graph::ProcessNode node_;                    // this process
  std::size_t place_ = 0;                      // of this process in the run page
  std::optional<Backend> executor_;            // that the command line asks for
  bool shows_ = false;
  Pairs options_;  // of the run
  std::uint64_t mark_ = 0;
  std::unique_ptr<Executive> executive_;
  std::optional<host::HostedPart> part_;
};

}  // namespace

int host_process_main(Descriptor socket, const std::vector<std::string>& plugin_folders) {
  // First of all, since all threads inherit the signals that it blocks, and never destroyed, so that it also ends
  // destructors and atexit handlers that hang.
  static auto& stop = *new host::StopSignal(EXIT_SUCCESS, EXIT_FAILURE, host::StopSignal::Terminal::ignored);
  const auto channel = std::make_shared<Channel>(std::move(socket));
  die_with_supervisor(true);
  Result<Numbered> first = next_order(*channel);
  Status lived = first ? wrong_sequence() : first.error();
  if (auto* const setup = first ? std::get_if<Setup>(&first->order) : nullptr)
    lived = Life(channel, plugin_folders, stop).live(std::move(*setup), first->request);
  else if (const auto* const meet = first ? std::get_if<Meet>(&first->order) : nullptr)
    lived = carry_states(*channel, *meet, first->request);
  return lived.ok() ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace orca::supervisor
