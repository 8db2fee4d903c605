// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "options.hpp"

namespace orca::deployer {

const char* help_text() {
  return R"(deployer GRAPH.xml [options]      bring up the system that a graph describes, run it, take it down

  deployer graphs/scout_goto.xml                          in real time, with the graph's default profile
  deployer graphs/scout_goto.xml --clock virtual          the same run, as fast as the machine can
  deployer graphs/scout_goto.xml --check                  only say what is wrong with the graph

What to run
  --profile NAME        select a profile of the graph; may be repeated (default: the graph's default_profile)
  --set ARG=VALUE       set an <arg> of the graph; or, with NAME.PARAM=VALUE, a parameter of the component or hardware
                        NAME, whatever the graph says; may be repeated
  --plugins FOLDER      look for plugins here too, after Orca's own; may be repeated
  --until DURATION      end after this time of the run's clock, e.g. 60s
  --seed N              seed of all random streams (default 1)
  --fail NAME=HOW@TIME  rehearse a failure of the component NAME, e.g. avoid=silent@20s; HOW: silent, throw, hang, or
                        slow (each lap nine periods late); may be repeated
  --change GRAPH@TIME   with --clock virtual or --in-process: at this time of the run go over to another graph, as with
                        orcactl apply, e.g. other.xml@20s; may be repeated

How to run it
  --clock KIND          steady: real time (default); virtual: simulated time, bit-identical for the same seed
  --executor KIND       thread (default of steady), fiber (default of virtual) or baton
  --machine NAME        the machine of the graph that this is; start the deployer on each of them, in any order
  --in-process          everything in this process, for a debugger, instead of host processes below it; the virtual clock
                        always does so
  --hold                nothing moves before orcactl estop --release: for a first motion, and for a deployer that a
                        service starts
  --watch               while you develop: when the plugin of a component is built anew, its code is exchanged while the
                        system runs; if it fails when it is tried out, the log says why and the old one goes on. A graph
                        that is saved is carried out like with orcactl apply

What to write
  --trace FILE          one line per delivery, connection and change of state; not with several host processes
  --values              in the trace, each object that is delivered, so that two runs can be compared to the first
                        differing number
  --record FILE.csv=PORT,...
                        a table of all objects that a PushServer pushes, a SendProxy sends, or that arrive at another
                        port, for a spreadsheet or pandas; --list-ports lists the ports; may be repeated with other files
  --picture FILE        draws the run, in the end, if it was simulated: .svg or .png
  --view WHAT           of the picture: world (default), robot (around the first robot, ahead is up) or film (key
                        moments: start, arrivals, contacts, end)
  --hide LAYERS         of the picture, e.g. sonar,track; layers: walls, track, robot, sonar, laser, motion, marks,
                        places
  --progress            one line on stderr that shows time, who is not well, distance to the goal and the last alarm, and a
                        summary in the end; by default if stderr is a terminal. --no-progress: neither
  --stats               in the end, on stderr: what each connection carried, dropped and delivered late
  --log LEVEL           debug, info (default), warning, error or off; logs go to stderr

Instead of running
  --check               only check the graph against the plugins, and what the components say to their parameters, in
                        a trial that leaves no trace; all errors at once
  --print               the graph as it is: files, arguments and profiles merged, defaults filled in, in SI
  --list-ports          every port of every component: pattern, role, type, and what it is connected to
  --dot, --mermaid      the graph as a picture, for Graphviz (| dot -Tsvg > graph.svg) or for a web page
  --diff OLD NEW        what differs between two graphs, by meaning: exit 0 the same, 1 different
  --types               all types of components and hardware, each with its plugin file
  --describe TYPE       ports and parameters, with units, ranges and defaults, of a type such as orca.Goto, or of all
                        types of a plugin file: --describe PLUGIN.so
  --schema              the graph's language as an XML schema, for editors
  --version, --help

How to check
  --strict              warnings are errors: nothing starts with one
  --json                for programs; with --check, --print, --list-ports, --diff, --describe and --types

stdout  arrived NAME x y t | failed NAME reason | contact NAME t | trace-hash HASH (virtual clock, last line);
        with several robots the first three end with the name of the robot
exit    0 finished or stopped on request   1 failed while running, output not written, or --diff found a difference
        2 graph or arguments wrong, nothing started   3 could not start, all taken down again
        A component that ends in WORK_FAILED is such a failure, unless the graph says may_fail="true" of it.
)";
}

}  // namespace orca::deployer
