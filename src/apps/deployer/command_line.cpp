// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "common/command_line.hpp"

#include "options.hpp"

namespace orca::deployer {
namespace {

using apps::OptionSpec;

constexpr std::string_view kExamples =
    "  deployer graphs/scout_goto.xml                          in real time, with the graph's default "
    "profile\n"
    "  deployer graphs/scout_goto.xml --clock virtual          the same run, as fast as the machine can\n"
    "  deployer graphs/scout_goto.xml --check                  only say what is wrong with the graph\n";

constexpr std::string_view kNotes =
    "A component that ends in WORK_FAILED is such a failure, unless the graph says may_fail=\"true\" of it.\n"
    "\n"
    "stdout  arrived NAME x y t | failed NAME reason | contact NAME t | trace-hash HASH (virtual clock, last "
    "line);\n"
    "        with several robots the first three end with the name of the robot\n";

std::vector<OptionSpec> choosing_options() {
  return {
      {"--profile", "NAME", "select a profile of the graph (default: the graph's default_profile)", true,
       "What to run"},
      {"--set", "ARG=VALUE",
       "set an <arg> of the graph; or, with NAME.PARAM=VALUE, a parameter of the component or hardware NAME, "
       "whatever the graph says",
       true},
      {"--plugins", "FOLDER", "look for plugins here too, after Orca's own", true},
      {"--until", "DURATION", "end after this time of the run's clock, e.g. 60s"},
      {"--seed", "N", "seed of all random streams (default 1)", false, {}, 0},
      {"--measure-laps", "FILE",
       "with --clock virtual or --in-process: write the processor time of each component's laps, for takes "
       "of a graph"},
      {"--computing", "FACTOR",
       "with --clock virtual: laps take this many times as long as the graph says by takes; 0: no time"},
      {"--fail", "NAME=HOW@TIME",
       "rehearse a failure of the component NAME, e.g. avoid=silent@20s; HOW: silent, throw, hang, or slow "
       "(each lap nine periods late)",
       true},
      {"--change", "GRAPH@TIME",
       "with --clock virtual or --in-process: at this time of the run go over to another graph, as with "
       "orcactl apply, e.g. other.xml@20s",
       true},
  };
}

std::vector<OptionSpec> running_options() {
  return {
      {"--clock", "steady|virtual",
       "steady: real time (default); virtual: simulated time, bit-identical for the same seed", false,
       "How to run it"},
      {"--executor", "thread|fiber|baton", "thread is the default of --clock steady, fiber that of virtual"},
      {"--machine", "NAME",
       "the machine of the graph that this is; start the deployer on each of them, in any order"},
      {"--name", "NAME",
       "name of the system, in place of the graph's: with names of their own several systems of one graph "
       "run side by side"},
      {"--domain",
       "N",
       "DDS domain, from 0 to 232, in place of the graph's: systems of different domains see nothing of each "
       "other",
       false,
       {},
       0,
       232},
      {"--in-process", "",
       "everything in this process, for a debugger, instead of host processes below it; the virtual clock "
       "always does so"},
      {"--allow", "ROLE=WHO",
       "what another user may do, or all of a group, with orcactl --of USER: operate=user:anna, "
       "observe=group:robots; "
       "ROLE: observe, operate (goals, tasks, pauses, emergency stop) or change (everything)",
       true},
      {"--writable", "FOLDER",
       "components may write below it; else only to devices, temporary files, and the folders of files that "
       "their parameters name",
       true},
      {"--hold", "",
       "nothing moves before orcactl estop --release: for a first motion, and for a deployer that a service "
       "starts"},
      {"--view", "",
       "a page in the browser that shows the system and commands it; its address is printed (see orcaview "
       "--help). In virtual time it implies --pace 1"},
      {"--pace", "FACTOR",
       "with --clock virtual: how fast time passes by the clock, from 0.01 to 1000; 0: paused; fast: as fast "
       "as it "
       "can; orcactl pace, pause and step change it. The result is the same at any pace"},
      {"--guest", "FD[,FD]",
       "with --clock virtual or --check, for the Python package: open sockets to a program that has "
       "component "
       "types of its own, and that steps the run"},
      {"--watch", "",
       "while you develop: when the plugin of a component is built anew, its code is exchanged while the "
       "system runs; if it fails when it is tried out, the log says why and the old one goes on. A graph "
       "that is saved is carried out like with orcactl apply"},
  };
}

std::vector<OptionSpec> writing_options() {
  return {
      {"--trace", "FILE",
       "one line per delivery, connection and change of state; not with several host processes", false,
       "What to write"},
      {"--values", "",
       "in the trace, each object that is delivered, so that two runs can be compared to the first differing "
       "number"},
      {"--record", "FILE",
       "records the run: FILE.mcap everything, or FILE.mcap=PORT,... what passes these ports, as an MCAP "
       "file for "
       "Foxglove, PlotJuggler, rosbag readers and orcactl bag; FILE.carmen, or FILE.carmen=PORT,..., "
       "odometry "
       "and scans as a CARMEN log, which many programs that make maps read; FILE.csv=PORT,... a table of all "
       "objects that "
       "a "
       "PushServer pushes, a SendProxy sends, or that arrive at another port, for a spreadsheet or pandas; "
       "--list-ports lists the ports; each time with another file",
       true},
      {"--picture", "FILE", "draws the run, in the end, if it was simulated: .svg or .png"},
      {"--scene", "world|robot|film",
       "of the picture: world (default), around the first robot, ahead is up, or key moments: start, "
       "arrivals, contacts, end"},
      {"--hide", "LAYER,...",
       "of the picture, e.g. sonar,track; layers: walls, track, robot, sonar, laser, motion, marks, places"},
      {"--progress", "",
       "one line on stderr that shows time, who is not well, distance to the goal and the last alarm, and a "
       "summary in the end; by default if stderr is a terminal"},
      {"--no-progress", "", "neither of them"},
      {"--stats", "", "in the end, on stderr: what each connection carried, dropped and delivered late"},
      {"--log", "debug|info|warning|error|off",
       "least level of the log, which goes to stderr (default info)"},
  };
}

std::vector<OptionSpec> other_options() {
  return {
      {"--check", "",
       "only check the graph against the plugins, and what the components say to their parameters, in a "
       "trial that leaves no trace; all errors at once",
       false, "Instead of running"},
      {"--print", "", "the graph as it is: files, arguments and profiles merged, defaults filled in, in SI"},
      {"--list-ports", "", "every port of every component: pattern, role, type, and what it is connected to"},
      {"--dot", "", "the graph as a picture, for Graphviz (| dot -Tsvg > graph.svg)"},
      {"--mermaid", "", "the same for a web page"},
      {"--diff", "",
       "what differs between two graphs, OLD and NEW, by meaning: exit 0 the same, 1 different"},
      {"--types", "",
       "all types of components and hardware, and object types that are not Orca's own, each with its file "
       "and "
       "a sentence on what it is"},
      {"--describe", "",
       "ports and parameters, with units, ranges and defaults, of a type such as orca.Goto, or of all types "
       "of a plugin file: --describe PLUGIN.so; or the fields of an object type such as Odometry"},
      {"--schema", "",
       "the graph's language as an XML schema for editors, with the types of all plugins, their ports and "
       "parameters"},
      {"--rnc", "", "the same in RELAX NG's compact syntax, for Emacs"},
      {"--strict", "", "warnings are errors: nothing starts with one", false, "How to check"},
      {"--json", "", "for programs; with --check, --print, --list-ports, --diff, --describe and --types"},
  };
}

}  // namespace

const apps::Program& program() {
  static const apps::Program all = [] {
    apps::Program program{
        .name = "deployer",
        .usage = "GRAPH.xml [options]",
        .text = "bring up the system that a graph describes, run it, take it down",
        .details = kExamples,
        .arguments = {{"FILE", apps::Names::file, true, true}},
        .exits = {"0 finished or stopped on request",
                  "1 failed while running, output not written, or --diff found a difference",
                  "2 graph or arguments wrong, nothing started", "3 could not start, all taken down again"},
        .notes = kNotes};
    for (const auto& group : {choosing_options(), running_options(), writing_options(), other_options()})
      program.options.insert(program.options.end(), group.begin(), group.end());
    return program;
  }();
  return all;
}

}  // namespace orca::deployer
