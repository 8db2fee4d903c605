// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/base/log.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/supervisor/message.hpp"
#include "orca/supervisor/record.hpp"

namespace orca::supervisor {

/// What the supervisor and its host processes say to each other. Names of components are those of the graph; an edge is
/// named as graph::Edge::name() says.

/// Names with their values.
using Pairs = std::vector<std::pair<std::string, std::string>>;

/// The memory of an edge between two processes.
struct EdgeMemory {
  std::string edge;
  Descriptor memory;
  std::string peer = {};     ///< The process at its other end.
  Descriptor pool = {};      ///< The bulk data of that process; empty: it came before, or there is none.
  bool peer_is_new = false;  ///< That process has taken the place of one that has ended.
};

/// What a component has saved of its state.
struct StateKept {
  static constexpr Kind kKind = Kind::state_kept;
  std::string component;
  std::string type;           ///< Of the object that has saved it.
  std::uint32_t version = 0;  ///< Of the state of that type.
  std::vector<std::byte> state;
};

// ---- Orders, from the supervisor to a host process.

/// Tells a new process who it is. The first order.
struct Setup {
  static constexpr Kind kKind = Kind::setup;
  std::string process;                 ///< Its name in the graph.
  std::string graph;                   ///< The expanded graph, as `deployer --print` writes it.
  Pairs options;                       ///< Of the run, by their names on the command line.
  Descriptor run_page;                 ///< See orca/supervisor/run_page.hpp.
  std::vector<EdgeMemory> edges;       ///< The edges to other processes that use memory.
  std::vector<std::string> doorbells;  ///< The components whose doorbells are in the run page, in this order.
  std::vector<StateKept> states;       ///< With what components begin.
  std::vector<std::string>
      processes;         ///< Those that have a place in the run page, in this order; "": nobody's.
  Descriptor pool = {};  ///< For its bulk data, which its peers may read; empty: none.
};
/// Asks to construct all components and hardware and to connect the ports. Built comes before the answer.
struct Build {
  static constexpr Kind kKind = Kind::build;
};
/// Asks to open all hardware.
struct OpenHardware {
  static constexpr Kind kKind = Kind::open_hardware;
};
/// Asks to configure one component.
struct Configure {
  static constexpr Kind kKind = Kind::configure;
  std::string component;
};
/// Asks to let the components work.
struct OpenGates {
  static constexpr Kind kKind = Kind::open_gates;
};
/// Asks to end: motors first, then everything else.
struct TakeDown {
  static constexpr Kind kKind = Kind::take_down;
  bool keeps_states = false;  ///< The states of all components come as StateKept before the end.
};
/// Asks to stop all motors of the process now, and to let nothing move until ReleaseMotors. Everything else goes on.
struct StopMotors {
  static constexpr Kind kKind = Kind::stop_motors;
  std::string reason;
  bool only_devices = false;  ///< Only hardware on a line; an error says that there is none.
};
/// Asks to let the motors obey commands again.
struct ReleaseMotors {
  static constexpr Kind kKind = Kind::release_motors;
};
/// Asks for the counters of all connections that end in the process. They come with the answer.
struct Count {
  static constexpr Kind kKind = Kind::count;
};
/// Gives an operator's program a line to ports of the process: see orca/supervisor/control.hpp.
struct OpenLine {
  static constexpr Kind kKind = Kind::open_line;
  std::vector<graph::PortRef> ports;  ///< One at least. What the program offers is for the first.
  bool taps = false;                  ///< Objects that pass the ports are told, with their times.
  bool objects = false;               ///< With the objects themselves.
  std::uint64_t bound = 0;  ///< What may wait for the program [bytes]; 0: what a person who looks on needs.
  Descriptor line;
};
/// Asks to suspend a component.
struct Suspend {
  static constexpr Kind kKind = Kind::suspend;
  std::string component;
};
/// Asks to let a suspended component go on.
struct Resume {
  static constexpr Kind kKind = Kind::resume;
  std::string component;
};
/// Asks to change parameters of a component, all together or none.
struct SetParams {
  static constexpr Kind kKind = Kind::set_params;
  std::string component;
  Pairs values;  ///< Values are texts as in the graph, with units.
};
/// Gives an edge new memory, because the process at its other end has been started again.
struct RenewEdge {
  static constexpr Kind kKind = Kind::renew_edge;
  EdgeMemory edge;
};
/// Says that the process at the other end of an edge is gone.
struct CutEdge {
  static constexpr Kind kKind = Kind::cut_edge;
  std::string edge;
  std::string reason;
};
/// Tells of an alarm that was raised or cleared elsewhere.
struct TellAlarm {
  static constexpr Kind kKind = Kind::tell_alarm;
  std::string process;            ///< That it is about; empty: not one alone.
  std::vector<std::byte> object;  ///< An idl::Alarm, encoded as XCDR1.
};
/// Tells that an alarm was acknowledged.
struct ForgetAlarm {
  static constexpr Kind kKind = Kind::forget_alarm;
  std::string kind;
  std::string source;
  std::string process;
};

/// Tells a new process that it is the one that speaks with the other machines, or with a team, and where. The first order, instead of
/// Setup.
struct Meet {
  static constexpr Kind kKind = Kind::meet;
  std::string name;                 ///< Of the process, for people.
  std::string type;                 ///< IDL name of what is said: "orca::idl::MachineState".
  std::string topic;                ///< What all of them speak on.
  std::string address;              ///< Of this machine; empty: any.
  std::string interface {};         ///< Network interface of this machine; empty: any.
  std::vector<std::string> others;  ///< Addresses of the other machines, as far as they are known.
  std::uint32_t domain = 0;         ///< Of DDS.
  std::string keys{};               ///< Folder with the keys of this machine; empty: everything is plain.
};
/// Asks to say something to all others. The answer says that the process is well.
struct Say {
  static constexpr Kind kKind = Kind::say;
  std::vector<std::byte> state;  ///< Of the type of Meet, encoded as XCDR1.
};

/// Asks to go on if the supervisor is gone, and to wait for another one at a meeting place
/// (orca/supervisor/meeting_place.hpp). Until then the loss of the supervisor ends the process.
struct Outlive {
  static constexpr Kind kKind = Kind::outlive;
  Descriptor output;  ///< The reading end of its own stdout and stderr, to be kept for the next supervisor.
  std::uint64_t wait = 0;  ///< Longest wait for another supervisor [ns]; 0: no limit.
};
/// Takes over a process that has lost its supervisor. The answer comes after all reports that a new supervisor must have.
struct Adopt {
  static constexpr Kind kKind = Kind::adopt;
};
/// Lets a port use an edge from now on, of those that it chooses from.
struct MoveEdge {
  static constexpr Kind kKind = Kind::move_edge;
  std::string edge;
};
/// Asks whether anything in the process is in use: refused, with who is, if something is.
struct AskUse {
  static constexpr Kind kKind = Kind::ask_use;
};
/// A line of the log that another process has written.
struct LogLine {
  log::Level level = log::Level::info;
  std::string who;
  std::string text;
  std::uint64_t time = 0;  ///< [ns of the run's clock]
};
/// Tells what other processes have written to the log.
struct TellLines {
  static constexpr Kind kKind = Kind::tell_lines;
  std::vector<LogLine> lines;
};
/// Asks to exchange the code of a component while it runs. The answer comes when it is done, with a record about it.
struct SwapCode {
  static constexpr Kind kKind = Kind::swap_code;
  std::string component;
  std::string type;             ///< Of the new object; empty: as that of the old one.
  Pairs values;                 ///< New values of parameters, as texts.
  std::uint64_t probation = 0;  ///< Time in which a failure of the new object brings the old one back [ns].
  std::string origin;           ///< The file that the plugin was copied from.
  Descriptor plugin;            ///< Its bytes: see orca/plugin/image.hpp.
  bool tried = false;           ///< Whether the plugin has been tried out.
  bool fresh = false;           ///< The new object begins without the state of the old one.
};
/// An edge that is made or removed while its components run, at one process.
struct EdgeChange {
  graph::Edge edge;
  bool makes = true;
  Descriptor memory{};  ///< Of an edge to another process that is made.
};
/// Asks to make and remove connections of one component, in this order: of a client, or of a server whose client is in another
/// process. What is so already is made anew, or left alone. All changes are made, or none.
struct Rewire {
  static constexpr Kind kKind = Kind::rewire;
  std::vector<EdgeChange> changes;
};
/// Tells of a component that is new in the graph, or comes to another process. The process that has it constructs it.
struct AddComponent {
  static constexpr Kind kKind = Kind::add_component;
  graph::ComponentNode node;   ///< Without parameters and properties.
  Pairs values;                ///< Its parameters, as texts.
  std::uint64_t doorbell = 0;  ///< Place of its doorbell in the run page.
};
/// Tells of a component that nobody is connected to any more, and that goes. The process that has it ends it.
struct RemoveComponent {
  static constexpr Kind kKind = Kind::remove_component;
  std::string component;
};
/// Tells of a process that begins, or begins anew.
struct NoteProcess {
  static constexpr Kind kKind = Kind::note_process;
  std::string process;
  std::uint64_t place = 0;    ///< In the run page.
  bool is_of_fibers = false;  ///< Its strands have one doorbell together.
};
/// Asks to let one component work.
struct OpenGate {
  static constexpr Kind kKind = Kind::open_gate;
  std::string component;
};
/// Says that the run has another graph now, of which the process runs its part already: a supervisor that adopts it must have
/// the same.
struct NoteGraph {
  static constexpr Kind kKind = Kind::note_graph;
  std::string graph;  ///< As graph::print() writes it.
};

/// Gives a component the outcome of what it has ordered by PeerCalled.
struct ConcludeCall {
  static constexpr Kind kKind = Kind::conclude_call;
  std::string component;
  std::uint64_t number = 0;
  Status outcome;
  std::string before{};  ///< As of ComponentHost::take_outcome().
};

using Order =
    std::variant<Setup, Build, OpenHardware, Configure, OpenGates, TakeDown, StopMotors, Suspend, Resume,
                 SetParams, RenewEdge, CutEdge, TellAlarm, ForgetAlarm, ReleaseMotors, Count, OpenLine, Meet,
                 Say, Outlive, Adopt, MoveEdge, AskUse, TellLines, SwapCode, NoteGraph, Rewire, AddComponent,
                 RemoveComponent, OpenGate, NoteProcess, ConcludeCall>;

// ---- Reports, from a host process to the supervisor.

/// The answer to the order whose number the message repeats.
struct Answer {
  static constexpr Kind kKind = Kind::answer;
  Status outcome;
  std::vector<Record> records{};  ///< What was asked for, if anything.
};
/// What the process is made of, before anything moves.
struct Built {
  static constexpr Kind kKind = Kind::built;
  Pairs robots;  ///< Hardware and the name of its robot.
  Pairs
      builds{};  ///< Type, and PluginLibrary::build_id() of its code here; without what is loaded on demand.
};
/// What has become of a component, whenever it changes.
struct StateChange {
  static constexpr Kind kKind = Kind::state_change;
  std::string component;
  std::uint64_t state = 0;   ///< Number of its state; which one it is is agreed elsewhere.
  std::string failure;       ///< Why it has failed; empty: it has not.
  bool has_worked = false;   ///< Whether it has worked at some time.
  bool has_failed = false;   ///< Whether it has failed at some time.
  bool ended_badly = false;  ///< Whether its last work ended in WORK_FAILED.
};
/// Whether nothing in the process is in use any more, whenever it changes.
struct RestChange {
  static constexpr Kind kKind = Kind::rest_change;
  bool at_rest = true;
};
/// An object that the process reports, encoded as XCDR1.
template <Kind kind>
struct ObjectReport {
  static constexpr Kind kKind = kind;
  std::vector<std::byte> object;
};
using ArrivedReport = ObjectReport<Kind::arrived>;  ///< An idl::Arrived that a component has pushed.
using GoalFailedReport =
    ObjectReport<Kind::goal_failed>;                ///< An idl::GoalFailed that a component has pushed.
using ContactReport = ObjectReport<Kind::contact>;  ///< An idl::Contact of a robot.
using AlarmReport = ObjectReport<Kind::alarm>;      ///< An idl::Alarm.
using HeardReport = ObjectReport<Kind::heard>;      ///< An idl::MachineState of another machine.
/// A line of the log.
struct Logged {
  static constexpr Kind kKind = Kind::logged;
  log::Level level = log::Level::info;
  std::string who;
  std::string text;
};
/// Numbers with the name of what they count. Their order is agreed elsewhere.
struct Counts {
  std::string name;
  std::vector<std::uint64_t> numbers;
};
/// What the process has done, just before it takes everything down.
struct Tally {
  static constexpr Kind kKind = Kind::tally;
  std::vector<Counts> edges;    ///< By their ends: "a.out to b.in".
  std::vector<Counts> clients;  ///< By the ports that send or ask.
  std::vector<Counts> servers;  ///< By the ports that serve them.
  std::vector<Counts> ways;     ///< By the components that tell where a robot is: how far it has driven [mm].
};
/// An output of the process could not be written.
struct OutputFailed {
  static constexpr Kind kKind = Kind::output_failed;
  Status outcome;
};
/// What the process is like at this moment, for people.
struct Glance {
  static constexpr Kind kKind = Kind::glance;
  Pairs unwell;               ///< Hardware that does not work as it should, and its state.
  std::vector<Counts> goals;  ///< Places to which components drive: how far they are [mm].
};
/// Whether a component asks the user something on the terminal.
struct Prompting {
  static constexpr Kind kKind = Kind::prompting;
  bool begins = true;
};
/// What a process says when it crashes.
struct LastWordsReport {
  static constexpr Kind kKind = Kind::last_words;
  std::string text;
};

/// A port has sent the first object of a mission.
struct MissionStep {
  static constexpr Kind kKind = Kind::mission_step;
  std::uint64_t mission = 0;
  std::uint64_t time = 0;  ///< Of its creation [ns of the run's clock].
  std::string port;        ///< "component.port"
  std::string type;        ///< Of the object, its IDL name.
  std::uint64_t seq = 0;
  std::string cause_origin;  ///< What the object answers; empty: nothing.
  std::string cause_port;
  std::uint64_t cause_seq = 0;
};
/// Whether somebody in the process wants to hear what other processes write to the log, whenever it changes.
struct LogWished {
  static constexpr Kind kKind = Kind::log_wish;
  bool is_wanted = false;
};

/// What a process without a supervisor says first to whoever comes.
struct Orphaned {
  static constexpr Kind kKind = Kind::orphaned;
  std::string process;      ///< Its name in the graph.
  std::uint64_t graph = 0;  ///< mark_of() the expanded graph.
  Pairs options;            ///< Of the run, as in Setup.
  Descriptor run_page;
  Descriptor output;                   ///< The reading end of its stdout and stderr.
  std::vector<std::string> doorbells;  ///< As in Setup, with those of components that came later.
  std::vector<std::string> processes;  ///< As in Setup, with those that came later.
};
/// A component runs other code from now on than the graph names.
struct ExchangedCode {
  static constexpr Kind kKind = Kind::exchanged_code;
  std::string component;
  std::string type;
  std::string file;                     ///< The plugin's, when it was copied.
  std::string build_id;                 ///< PluginLibrary::build_id() of what is in memory.
  std::uint64_t swaps = 0;              ///< How often the component's code was exchanged in this process.
  std::vector<ParamContract> params{};  ///< That the code has.
  std::vector<std::pair<std::string, ParamValue>> values{};  ///< Of those that do not have their defaults.
};
/// What an earlier supervisor has ordered and kept, for the one that adopts the process.
struct Standing {
  static constexpr Kind kKind = Kind::standing;
  /// Alarms that nobody has acknowledged: the process that each is about, and an idl::Alarm, encoded as XCDR1.
  std::vector<std::pair<std::string, std::vector<std::byte>>> alarms;
  bool motors_held = false;                           ///< By StopMotors.
  std::vector<std::pair<std::string, Pairs>> params;  ///< By component: those that SetParams has changed.
};
/// A component orders another one.
struct PeerCalled {
  static constexpr Kind kKind = Kind::peer_called;
  enum class Act : std::uint8_t { set, suspend, resume };  ///< As PeerOrder::Kind.
  std::string by;
  std::uint64_t number = 0;  ///< Of the order, among those of the component.
  Act act = Act::set;
  std::string component;
  std::string param;  ///< To set.
  std::string value;  ///< To set: as in the graph, with its unit.
};
/// The memory of an edge holds what cannot be. The process has cut the edge.
struct EdgeDamaged {
  static constexpr Kind kKind = Kind::edge_damaged;
  std::string edge;  ///< graph::Edge::name()
};
/// Everything is taken down on order or at a signal, and the process ends.
struct Leaving {
  static constexpr Kind kKind = Kind::leaving;
};

using Report = std::variant<Answer, Built, StateChange, RestChange, ArrivedReport, GoalFailedReport,
                            ContactReport, AlarmReport, Logged, LastWordsReport, Tally, OutputFailed, Glance,
                            Prompting, MissionStep, HeardReport, Orphaned, Standing, Leaving, LogWished,
                            ExchangedCode, StateKept, PeerCalled, EdgeDamaged>;

/// Encodes an order or a report.
/// @param request  the number that the answer repeats, or, in an answer, that of the order; 0: none.
/// @pre  its descriptors are open.
/// @thread  any.
[[nodiscard]] Message encode(Order order, std::uint64_t request = 0);
[[nodiscard]] Message encode(Report report, std::uint64_t request = 0);

/// Decodes a message that came from the supervisor, or from a host process. The sender is not trusted.
/// @errors  data_loss if it is no such message, if a field is missing or impossible, or if something is left over.
/// @thread  any.
[[nodiscard]] Result<Order> decode_order(Message message);
[[nodiscard]] Result<Report> decode_report(Message message);

}  // namespace orca::supervisor
