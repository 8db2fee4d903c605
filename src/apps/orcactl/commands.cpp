// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "commands.hpp"

#include "keys/keys.hpp"

namespace orca::orcactl {
namespace {

using apps::Argument;
using apps::Command;
using apps::Names;
using apps::OptionSpec;

const Argument kPort{"PORT", Names::port};
const Argument kComponent{"COMPONENT", Names::component};
const Argument kComponents{"COMPONENT|GROUP", Names::group};
const OptionSpec kCount{"--count", "N", "end after so many objects"};
const OptionSpec kFor{"--for", "DURATION", "end after this time, with one line about all of it"};
const OptionSpec kTimeout{"--timeout", "DURATION", "longest wait for the answer (default 5 s)"};

constexpr std::string_view kSendDetails =
    "XML is the text form of the object, one element named after its type; what is not mentioned keeps its "
    "default. With - it is read from stdin. The framework stamps the header; an object that is sent begins a "
    "mission of its own, a question does not. The command ends when the object has been handled, with an "
    "error if the component refuses it.";

constexpr std::string_view kLatencyDetails =
    "The age counts from the moment at which the object was made, by the clock that all processes of the "
    "machine share. With --from and --to instead of a port it counts from the moment at which data were "
    "sensed that passed the one port until an object arrives at the other one that was sent because of them, "
    "with a line for each way that such data have taken. A component names as the cause of what it sends the "
    "object that it took last. A way that begins with ? goes back to an object that left before orcactl "
    "looked; one without times begins elsewhere. \"--to wheels\" is the port MotionCommandSend, and names "
    "may lack their Push or Send: --from base.odometry.";

constexpr std::string_view kRecordDetails =
    "With --ring it goes on for ever, in a folder: the oldest files go when there is no more room, and "
    "half of the room is for objects of at most 1 KiB, which so reach back much further. It ends with "
    "the system, or at Ctrl-C. Without PORT it records all ports through which objects leave their "
    "component, the log and the alarms; the graph and the files that it names are in the recording as "
    "well. It is a process of its own: a slow disk costs no component anything. What a port sends "
    "faster than it can be written, beyond 64 MiB, is left out, and counted by port. Whoever kills it "
    "loses the last quarter of a second. Objects are written as they travel, and scans, odometry, "
    "poses, paths, grids, images and batteries once more as ROS 2 knows them, so Foxglove, PlotJuggler "
    "and readers of rosbag2 show them. A file is never overwritten.";

constexpr std::string_view kBagDetails =
    "info FILE: how long it is, and what is in it, with what was lost. check FILE: reads all of it, with "
    "every checksum, and says what is wrong at which byte; exit status 1 if anything is. recover FILE "
    "NEW: writes what is whole into a new file with an index, after the recorder was killed or the disk "
    "was full. cut FILE NEW [FROM [TO]]: writes a span of time into a new file, such as cut nomad_scout "
    "noon.mcap 12:02 12:04; info and cut take the folder of --ring, too, and the name of a system whose "
    "graph says record=always. csv FILE [PORT...]: a table on stdout, as deployer --record FILE.csv "
    "writes it. carmen FILE [PORT...]: odometry and scans as a log for programs that make maps. diff "
    "FILE OTHER [PORT...]: the first object that differs, with its field; exit status 1 if there is one; "
    "times count, so it is for runs in virtual time. FILE may be a bag of ROS 2, in MCAP or SQLite, or "
    "its folder; recover takes MCAP files only, of any writer.";

constexpr std::string_view kMapDetails =
    "Asks the part of the system that has a map, by its port OccupancyGridQuery, and writes NAME.png, a "
    "picture, and "
    "NAME.yaml beside it, which orca.MapServer and the tools of ROS read. With several maps, or a port of "
    "another name, "
    "give the PORT, such as slam.OccupancyGridQuery. Cells from 65 % on are occupied (black), up to 19 % "
    "free (white), "
    "others not known (grey 205). A file is never overwritten, and neither is there before both are whole.\n"
    "map ways NAME.yaml prints a topological map for orca.RouteServer, to be completed by hand: rooms, the "
    "narrow passages between them as doors, and legs from door to door. No system needs to run.";

constexpr std::string_view kCalibrateDetails =
    "RECORDING is an MCAP file or a CARMEN log; PORT... says which odometry and which laser if there are "
    "several. The "
    "scans are laid upon each other to a map, in which the robot's way is known better than by its wheels; "
    "what explains "
    "the difference best is printed with its standard deviation, and as lines for the graph and the robot's "
    "file. Drive "
    "50 m at least, straight and with turns to both sides, past walls. --square \"4 m\" is for recordings of "
    "graphs/calibrate.xml.";

constexpr std::string_view kApplyDetails =
    "The file is read and checked like a graph that is started, with the profiles and settings of the "
    "deployer's command line, and compared with what runs now: what was changed with set and swap counts. "
    "Other types of components, and parameters that cannot change while a component runs, are exchanged like "
    "with swap, one after the other; then all other parameters change between two laps. If a step fails, "
    "everything goes back. A process that is started again begins with the new graph. New components come up "
    "before connections are made, removed and given other policies; components that the file does not have "
    "end at last. What cannot change in a process that runs - its hardware, its executor, a component that "
    "comes from another process, a connection over DDS - is there when the process begins anew: it ends, and "
    "is started with the new graph, while the others run on; components go on from what their save_state() "
    "wrote. The last lines say which processes that concerns. What needs more - machines, processes on "
    "demand - is refused before anything changes.";

constexpr std::string_view kRewireDetails =
    "The graph with that change is checked as a whole, so that the order is refused if a port that must be "
    "connected would not be. It is carried out between two laps of the components at both ends; no other "
    "connection notices. An object that waits at a port whose connection is removed is dropped, a request "
    "that was not answered gets an error, and what a server has accepted it still handles. A process that is "
    "started again has the same connections; orcactl graph shows the graph with them. Connections over DDS, "
    "and those of processes that run on demand, cannot change while the system runs.";

constexpr const char* kPaceDetails =
    "Only a run in virtual time has a pace: deployer --clock virtual --pace 1, or --view. 2 is twice as fast "
    "as the "
    "clock, 0.1 a tenth, 0 a pause; fast is as fast as the machine can. A step of 100ms moves the time by "
    "exactly "
    "that, and answers when it is over. What the system does, and its trace hash, are the same at any pace.";

// What a system is and does.
std::vector<Command> showing_commands() {
  return {
      {.name = "ps", .watches = true, .text = "the components: where they run and how they are"},
      {.name = "graph",
       .options = {{"--running", "", "with the values and types that set and swap have put there"}},
       .text = "the graph, with files, arguments and profiles merged",
       .details = "What it prints is a graph file. With --running it says what runs now, so that apply can "
                  "come back to it later."},
      {.name = "machines",
       .watches = true,
       .text = "the machines of the system: how they are, and how their clocks differ from this one's",
       .details =
           "clock_ahead_ms is what was measured with the shortest round trip of the last minute; the "
           "truth is at most error_ms away. A clock that certainly differs by more than 20 ms raises the "
           "alarm CLOCKS_DIFFER, and the instants in what comes from there are corrected."},
      {.name = "team",
       .watches = true,
       .text = "the systems of the team that this one has joined, and what they offer"},
      {.name = "ports", .text = "the ports of all components, and what they are connected to"},
      {.name = "plugins",
       .text = "the plugin files, and who uses them",
       .details = "A file counts as pinned if it, or a copy of it that was exchanged, stays in memory "
                  "although nothing uses it: the alarm PLUGIN_PINNED, which was not acknowledged, says why."},
      {.name = "objects",
       .text = "the libraries of object types that are not Orca's own, with their types",
       .details =
           "They stay in memory until the system ends. deployer --describe TYPE --plugins FOLDER shows "
           "the fields of one."},
  };
}

// Files of a system: recordings and maps.
std::vector<Command> file_commands() {
  return {
      {.name = "record",
       .arguments = {{"FILE.mcap|FILE.carmen|FOLDER", Names::file}, {"PORT", Names::port, true, true}},
       .options = {{"--ring", "SIZE", "keep the newest in a folder, in so much room, such as \"2 GB\""},
                   {"--for", "DURATION", "end after this time"},
                   {"--wait", "DURATION", "for a system that does not run yet"}},
       .text = "record everything, or what passes these ports, into an MCAP file, or odometry and scans into "
               "a CARMEN log",
       .details = kRecordDetails},
      {.name = "bag",
       .arguments = {{"info|check|recover|cut|csv|carmen|diff"},
                     {"FILE.mcap|FOLDER|SYSTEM", Names::file},
                     {"MORE", Names::port, true, true}},
       .options = {{"--plugins", "FOLDER", "where the libraries of object types lie that are not Orca's own",
                    true}},
       .text = "show, check, repair, convert or compare a recording; no system needs to run",
       .details = kBagDetails},
      {.name = "map",
       .arguments = {{"save|ways"}, {"NAME", Names::file}, {"PORT", Names::port, true}},
       .options = {kTimeout},
       .text = "save the map of a running system as NAME.yaml and NAME.png, or propose rooms and doors",
       .details = kMapDetails},
      {.name = "calibrate",
       .arguments = {{"RECORDING", Names::file}, {"PORT", Names::port, true, true}},
       .options = {{"--robot", "FILE", "the robot's file, which says how far its wheels are apart"},
                   {"--square", "LENGTH", "evaluate squares with sides of this length, too: the UMBmark"}},
       .text =
           "the figures that correct a base's odometry, from a drive with a laser; no system needs to run",
       .details = kCalibrateDetails},
  };
}

// Objects at ports.
std::vector<Command> port_commands() {
  return {
      {.name = "echo",
       .arguments = {kPort},
       .options = {kCount,
                   {"--for", "DURATION", "end after this time"},
                   {"--field", "NAME",
                    "only this field of each object, as the columns of a recording are named"}},
       .text = "the objects that pass a port, one per line",
       .details =
           "At a PushServer and a SendProxy an object is seen when it leaves, whoever takes it; at any other "
           "port, when it arrives. Looking makes no component work: one that nobody uses pushes nothing; but "
           "one that works and makes something only for whoever takes it makes it for whoever looks. Objects "
           "that come faster than they can be printed are left out, and counted on stderr."},
      {.name = "hz",
       .arguments = {kPort},
       .options = {kFor},
       .text = "how often objects pass a port, each second"},
      {.name = "latency",
       .arguments = {{"PORT", Names::port, true}},
       .options = {kFor,
                   {"--from", "PORT", "where data begin: follow causes back to this port"},
                   {"--to", "PORT", "where data arrive, or \"wheels\""}},
       .text = "how old objects are when they pass a port, each second",
       .details = kLatencyDetails},
      {.name = "send",
       .arguments = {kPort, {"XML"}},
       .options = {kTimeout},
       .text = "send an object to a SendServer",
       .details = kSendDetails},
      {.name = "query",
       .arguments = {kPort, {"XML"}},
       .options = {kTimeout},
       .text = "ask a QueryServer, and print its reply",
       .details = kSendDetails},
  };
}

// Parameters, and what has happened.
std::vector<Command> history_commands() {
  return {
      {.name = "get",
       .arguments = {{"COMPONENT[.PARAM]", Names::param}},
       .watches = true,
       .text = "the value of a parameter, or of all of a component, in SI"},
      {.name = "set",
       .arguments = {{"COMPONENT.PARAM", Names::param},
                     {"VALUE"},
                     {"COMPONENT.PARAM VALUE", Names::param, true, true}},
       .pairs = true,
       .text = "change parameters between two laps: all of them, or none",
       .details = "Values are written and checked as in a graph, with units, all of them before anything "
                  "changes. Each component changes between two of its laps, one after the other; if one "
                  "refuses, those before it get their old values back. A process that is started again "
                  "begins with the values of the graph."},
      {.name = "counters", .watches = true, .text = "what the connections have carried, dropped and refused"},
      {.name = "log",
       .arguments = {{"NAME", Names::component, true, true}},
       .options = {{"--follow", "", "go on with the lines that come"},
                   {"--level", "debug|info|warning|error", "no lines below (default info)"}},
       .text = "the last lines of the log, of all processes or of those named"},
      {.name = "alarms",
       .arguments = {{"ack N", Names::none, true, true}},
       .watches = true,
       .text = "the alarms that nobody has acknowledged",
       .details = "An alarm stays until it is acknowledged, even if its source has been started again: "
                  "alarms ack N takes out the one with that number, alarms ack all takes out all."},
      {.name = "tasks",
       .arguments = {{"pause|resume|skip|end|begin|yes|no", Names::none, true},
                     {"COMPONENT", Names::component, true}},
       .options = {kTimeout},
       .text = "the tasks with their steps, or an order to one",
       .details =
           "pause lets the robot stand, and resume begins the step on the way again. skip takes that "
           "step for done, end takes the task for failed, begin begins it again. yes and no answer it."},
      {.name = "go",
       .arguments = {{"GOAL", Names::none, true, true}},
       .options = {{"--queue", "", "after the goals that it has, instead of them"},
                   {"--repeat", "", "to all of them in turn, again and again"},
                   {"--cancel", "", "stand, and forget all goals"},
                   {"--wait", "", "show what becomes of each goal; exit status 1 if one was not reached"},
                   {"--component", "NAME", "which component takes the order, if several do"},
                   kTimeout},
       .text = "send the robot somewhere, or show where it goes and how far it is",
       .details =
           "A GOAL is a place by its name (kitchen), two coordinates in metres (3.2 4), or a text as in "
           "Command's parameter goals (\"desk: 3 2 > 5 4.5 @ 90\"). Several are driven to one after the "
           "other. Without a goal it shows the goal on the way, what is left, and why the robot waits. "
           "Who was given an order waits for the next one when it is carried out."},
      {.name = "missions",
       .arguments = {{"MISSION", Names::none, true}},
       .text = "what happened in each mission, in order"},
  };
}

// What changes a running system.
std::vector<Command> operating_commands() {
  return {
      {.name = "estop",
       .options = {{"--release", "", "let the motors obey commands again"}},
       .text = "stop all motors now, and hold them until estop --release",
       .details =
           "The order goes to each process over its control channel, not over a connection of the graph. A "
           "held base refuses commands to move; a process that is started meanwhile is held, too. After the "
           "release nothing moves before the next command. Both orders are for the whole system: where it "
           "runs on several machines, each of them is asked, and has a line in the answer; if one does not "
           "confirm within 2 s, the exit status is 1, and the error names it."},
      {.name = "stop",
       .text = "end the system: motors first, then everything else",
       .details = "Processes that go on after their deployer was killed obey this and estop themselves."},
      {.name = "restart",
       .arguments = {{"NAME", Names::process}},
       .text = "start the process of a component again, with all that runs in it"},
      {.name = "suspend",
       .arguments = {kComponents},
       .text = "pause a component, or all of a group, between two laps",
       .details = "The components of a group are suspended one after the other, in the reverse order of "
                  "their start; those that are suspended already stay so. If one cannot be suspended, those "
                  "before it are resumed."},
      {.name = "resume",
       .arguments = {kComponents},
       .text = "let a suspended component go on, or all of a group",
       .details = "The components of a group are resumed one after the other, in the order of their start; "
                  "those that are not suspended are left alone. If one cannot be resumed, those before it "
                  "are suspended again."},
  };
}

const OptionSpec kTryout{"--tryout", "DURATION", "time for which new code is tried out (default 2 s)"};
const OptionSpec kProbation{"--probation", "DURATION", "time in which a failure takes it back (default 2 s)"};
const OptionSpec kUntried{"--untried", "", "take new code even if it cannot be tried out"};

// What puts something else in the place of what runs.
std::vector<Command> exchanging_commands() {
  return {
      {.name = "swap",
       .arguments = {kComponent, {"PLUGIN.so[:TYPE]", Names::file}},
       .options = {{"--set", "PARAM=VALUE", "value of a parameter from then on", true},
                   kTryout,
                   kProbation,
                   kUntried,
                   {"--fresh", "", "begin without the old code's state, which is not asked for it"},
                   {"--only-try", "", "try the new code out, say what came of it, and change nothing"}},
       .text = "exchange the code of a component, or a driver, while it runs",
       .details =
           "For two seconds, what reaches the component is collected; then the new code is tried with that "
           "in a process of its own, where it can do no harm. If it crashes, hangs or fails there, nothing "
           "changes, and neither if it cannot be tried out, because it would write a file, for example. "
           "Otherwise the new object is made and configured beside the old one, which works on meanwhile. "
           "Between two laps it takes over the old one's state, ports and subscriptions; nothing that waits "
           "in queues is lost. The order ends when the probation is over and the old code is out of memory. "
           "Without TYPE it is the type that runs; another type is taken if its ports fit, and begins "
           "afresh. A process that is started again begins with the code of the graph. With the name of "
           "hardware instead of a component, its driver is exchanged: the base stops and is held, the device "
           "is closed and opened anew, and the old driver is back if the new one is not ready within 5 s. "
           "There is no trial and no probation then."},
      {.name = "fits",
       .arguments = {kComponent},
       .text = "the types of the plugin folders that could take a component's place",
       .details = "Their ports are compared with those of the component, as swap does. For that, their "
                  "constructors run in a copy of the deployer's process; a plugin that does not survive "
                  "that is named on stderr."},
      {.name = "connect",
       .arguments = {kPort, kPort, {"ATTRIBUTE=VALUE", Names::none, true, true}},
       .text = "make a connection while the system runs, or give it another policy",
       .details = kRewireDetails},
      {.name = "disconnect",
       .arguments = {kPort, kPort},
       .text = "remove a connection while the system runs",
       .details = kRewireDetails},
      {.name = "move",
       .arguments = {kPort, {"SERVER_PORT", Names::port}},
       .text = "let a client's port use another server from now on, with the same policy",
       .details = kRewireDetails},
      {.name = "diff",
       .arguments = {{"GRAPH.xml", Names::file}},
       .text = "what apply would change, and what stops meanwhile",
       .details = kApplyDetails},
      {.name = "apply",
       .arguments = {{"GRAPH.xml", Names::file}},
       .options = {kTryout, kProbation, kUntried},
       .text = "let the running system become what a graph says: all of it, or nothing",
       .details = kApplyDetails},
  };
}

// The time of a simulation.
std::vector<Command> pacing_commands() {
  return {
      {.name = "pace",
       .arguments = {{"FACTOR|fast", Names::none, true}},
       .watches = true,
       .text = "how fast the time of a simulation passes; show it, or set it",
       .details = kPaceDetails},
      {.name = "pause", .text = "let the time of a simulation stand", .details = kPaceDetails},
      {.name = "step",
       .arguments = {{"DURATION"}},
       .text = "let a time pass in a simulation, and pause",
       .details = kPaceDetails},
  };
}

constexpr std::string_view kNewDetails =
    "component: a behaviour, its test without a robot, and a graph in which it drives a simulated Scout. "
    "driver: "
    "a made-up laser on a line, an emulation of it, and a test over good and bad lines. experiment: two "
    "avoid behaviours in three worlds. object: a type of objects that travel, its test, a component that "
    "makes "
    "them and one that uses them, and a graph. NAME consists of letters, digits and _; the type of "
    "follow_light is "
    "my.FollowLight. What it prints can be pasted: the commands that build, try and run it, which the "
    "folder's "
    "README.md explains. The templates are in share/orca/templates. Nothing is overwritten.";

constexpr std::string_view kImportDetails =
    "FILE configures a component of the thesis (9.5, Appendix A). The graph has its hardware and the "
    "component, in SI units; as a comment, the ports that connections may name, and what belongs into "
    "the robot's file. What has no equivalent in Orca is said on stderr, all at once, each with its "
    "line. Lengths are taken as mm, angles of sonars as tenths of a degree. orcactl import base.xml > "
    "base_graph.xml && deployer base_graph.xml --check";

// For shells and people.
std::vector<Command> shell_commands() {
  return {
      keys_command(),
      {.name = "new",
       .arguments = {{"component|driver|experiment|object"}, {"NAME"}},
       .text = "begin a component, driver, experiment or object type of your own, in a folder NAME; no "
               "system needs "
               "to run",
       .details = kNewDetails},
      {.name = "import",
       .arguments = {{"FILE.xml", Names::file}},
       .text = "print a component's file of the thesis as a graph; no system needs to run",
       .details = kImportDetails},
      {.name = "names",
       .arguments = {{"KIND"}},
       .text = "names for completion, one per line: component, group, port, param, process or system"},
  };
}

}  // namespace

const apps::Program& program() {
  static const apps::Program all = [] {
    apps::Program program{
        .name = "orcactl",
        .usage = "[--system NAME] COMMAND ...",
        .text = "look at a running system, and command it",
        .details =
            "  orcactl ps                            what runs, and how it is\n"
            "  orcactl echo base.OdometryPush        the objects that pass a port\n"
            "  orcactl estop                         stop all motors now\n",
        .options = {{"--system", "NAME", "which system, if several run: its name", false, "Options"},
                    {"--of", "USER", "a system of another user, who has allowed it: see deployer --allow"},
                    {"--json", "",
                     "for programs: JSON on stdout; one object per line where the output goes on"},
                    {"--watch", "", "repeat every second, until interrupted"}},
        .exits = {"0 done", "1 refused: the reason is on stderr", "2 the command line is wrong",
                  "3 no deployer runs"},
        .notes =
            "\nIt talks to the deployer that runs a graph, through a Unix socket of the same user:\n"
            "$XDG_RUNTIME_DIR/orca/GRAPH.sock, or /tmp/orca-UID/GRAPH.sock where there is no such folder. A "
            "system\n"
            "has the name of its graph, or that of deployer --name.\n"};
    for (const auto& group :
         {showing_commands(), port_commands(), file_commands(), history_commands(), operating_commands(),
          pacing_commands(), exchanging_commands(), shell_commands()})
      program.commands.insert(program.commands.end(), group.begin(), group.end());
    return program;
  }();
  return all;
}

}  // namespace orca::orcactl
