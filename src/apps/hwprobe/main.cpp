// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include "common/manual.hpp"
#include "common/output.hpp"
#include "orca/base/files/own_library.hpp"
#include "orca/base/live_line.hpp"
#include "orca/base/log.hpp"
#include "orca/base/text.hpp"
#include "orca/host/stop_signal.hpp"
#include "orca/hw/link/device_files.hpp"
#include "orca/plugin/index.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"
#include "ports.hpp"
#include "summary.hpp"
#include "trial.hpp"

namespace orca::hwprobe {
namespace {

constexpr std::string_view kDetails =
    "  hwprobe                            all serial ports and cameras of this machine\n"
    "  hwprobe /dev/ttyUSB0               one port\n"
    "  hwprobe /dev/video0                a camera\n"
    "  hwprobe tcp:192.168.0.20:8101      a device behind a network\n"
    "  hwprobe --driver orca.hw.P2os      only one kind of device\n"
    "  hwprobe /dev/ttyUSB0 --watch       and its data anew each second, until Ctrl-C: push the robot by\n"
    "                                     hand, hold a box in front of a sonar\n"
    "  hwprobe emulated:bench             a device of graphs/emulated_devices.xml, which runs beside it\n"
    "\n"
    "Each driver looks for its device in turn, at all rates that the device may have. It may take half\n"
    "a minute per port. Drivers of devices in the network are asked at a serial port only if --driver\n"
    "names them. Nothing is moved: motors get no power. A port that cannot be opened, and a device that\n"
    "does not answer, is told with what to do. Stop a running system first: a port belongs to one\n"
    "program at a time.\n";

const apps::Program& program() {
  static const apps::Program all{
      .name = "hwprobe",
      .usage = "[PORT...] [options]",
      .text = "which device is at which port, and what it says first",
      .details = kDetails,
      .arguments = {{"PORT", apps::Names::none, true, true}},
      .options = {{"--driver", "TYPE", "only this hardware type", true, "Options"},
                  {"--watch", "", "show the data of a device anew each second; for one port"},
                  {"--limit", "SECONDS", "the longest wait for an answer, and for data (default 15)"},
                  {"--plugins", "FOLDER", "look for drivers here too, after Orca's own", true}},
      .exits = {"0 a device answered at each port", "1 at some port none did", "2 wrong usage"},
      .notes = "docs/hardware/day-one.md leads from here to the first motion.\n"};
  return all;
}

enum class ExitCode { all_answer = 0, some_silent = 1, usage = 2 };

struct Options {
  std::vector<std::string> ports{};
  std::vector<std::string> types{};
  std::vector<std::string> folders{};
  double limit = 15.0;  // [s]
  bool watches = false;
};

Error wrong(const std::string& what) {
  return fail(Code::invalid_argument, what + "; hwprobe --help explains what there is");
}

Result<Options> options_of(const apps::Call& call) {
  Options options{call.words, call.all("--driver"), call.folders("--plugins")};
  options.watches = call.has("--watch");
  if (options.watches && options.ports.size() != 1)
    return wrong("--watch needs one port, whose device it watches");
  if (const auto text = call.text("--limit")) {
    const auto seconds = xml::parse_number(*text);
    if (!seconds || !(*seconds > 0.0) || *seconds > 3600.0)
      return wrong("--limit " + in_quotes(*text) + " is no time of up to an hour in seconds");
    options.limit = *seconds;
  }
  return options;
}

std::vector<std::string> plugin_folders(const Options& options) {
  std::vector<std::string> folders{own_plugin_folder()};
  folders.insert(folders.end(), options.folders.begin(), options.folders.end());
  return folders;
}

void show(const std::string& text) { std::printf("%s\n", text.c_str()); }

void show_data(const Finding& finding) {
  for (const std::string& object : finding.data)
    for (const std::string& line : summary(object)) show("    " + line);
  for (const std::string& name : finding.silent) show("    no " + name + " has come");
}

void show_again(const Finding& finding) {
  LiveLine::erase();
  show("");
  show_data(finding);
  (void)std::fflush(stdout);
}

std::string param_text(const std::string& name, const std::string& value) {
  return "<param name=\"" + name + "\" value=\"" + value + "\"/>";
}

void show_device(const std::string& type, const std::string& port, const Finding& finding) {
  show("  " + type + ": " + finding.what.vendor() + " " + finding.what.model());
  for (const std::string& line : finding.said) show("    " + line);
  show_data(finding);
  show("    the line: " + std::to_string(finding.line.frames()) + " good frames, " +
       std::to_string(finding.line.bad_checksums()) + " spoiled, " +
       std::to_string(finding.line.skipped_bytes()) + " bytes skipped");
  std::string params = param_text("device", port);
  for (const auto& [name, value] : finding.learned) params += param_text(name, value);
  show("    in a graph: <hardware name=\"...\" type=\"" + type + "\">" + params + "</hardware>");
}

// Returns the drivers to be tried at a port. Those of cameras, and of devices in the network, are asked at other ports only by name, and no
// other drivers at cameras.
std::vector<std::string> types_for(const std::string& port, const std::vector<DriverType>& known,
                                   const Options& options) {
  if (!options.types.empty()) return options.types;
  std::vector<std::string> types;
  const Place place = place_of(port);
  for (const DriverType& driver : known)
    if (driver.place == place || (driver.place == Place::serial && place == Place::network))
      types.push_back(driver.name);
  return types;
}

// Returns whether a device has answered.
bool probe(host::PluginCatalogue& catalogue, const std::vector<std::string>& types, const Look& look,
           const std::string& port) {
  show(port);
  const Status opened = place_of(port) == Place::camera ? ok() : try_port(port);  // a driver opens it
  if (!opened.ok()) {
    show("  " + opened.error().text());
    return false;
  }
  std::vector<std::string> reasons;
  for (const std::string& type : types) {
    if (isatty(STDERR_FILENO) != 0) LiveLine::show(STDERR_FILENO, "  looking for " + type);
    const Result<Finding> finding = try_driver(catalogue, type, port, look);
    LiveLine::erase();
    if (finding && finding->answers) {
      show_device(type, port, *finding);
      return true;
    }
    if (look.is_stopped()) break;
    reasons.push_back("  " + type + ": " + (finding ? finding->reason : finding.error().message));
  }
  for (const std::string& reason : reasons) show(reason);
  return false;
}

ExitCode refuse(const Error& error) {
  std::fprintf(stderr, "error: %s\n", error.message.c_str());
  return ExitCode::usage;
}

Status check_types(const std::vector<std::string>& wanted, const std::vector<DriverType>& drivers) {
  std::vector<std::string> known;
  for (const DriverType& driver : drivers) known.push_back(driver.name);
  for (const std::string& type : wanted)
    if (std::find(known.begin(), known.end(), type) == known.end())
      return wrong("there is no driver " + in_quotes(type) + "; drivers: " + listed(known) +
                   xml::did_you_mean(xml::nearest_name(type, known)));
  return ok();
}

std::vector<std::string> ports_of_machine() {
  std::vector<std::string> ports = serial_ports();
  for (const std::string& camera : hw::link::cameras()) ports.push_back(camera);
  return ports;
}

ExitCode run(Options options, const host::StopSignal& stop) {
  host::PluginCatalogue catalogue(plugin::PluginIndex(plugin_folders(options)));
  const std::vector<DriverType> known = drivers(catalogue);
  if (const Status checked = check_types(options.types, known); !checked.ok()) return refuse(checked.error());
  if (options.ports.empty()) options.ports = ports_of_machine();
  if (options.ports.empty()) {
    show(
        "this machine has no serial port and no camera: is the adapter plugged in? \"dmesg | tail\" shows "
        "what "
        "became of it");
    return ExitCode::some_silent;
  }
  Look look{.limit = from_seconds(options.limit), .is_stopped = [&stop] { return stop.requested(); }};
  if (options.watches) look.show = show_again;
  bool all_answer = true;
  for (const std::string& port : options.ports)
    all_answer =
        !stop.requested() && probe(catalogue, types_for(port, known, options), look, port) && all_answer;
  return all_answer ? ExitCode::all_answer : ExitCode::some_silent;
}

ExitCode act(const std::vector<std::string>& words) {
  const apps::Call call = apps::parse(program(), words);
  if (!call.problems.empty()) return refuse(wrong(call.problems.front().message));
  if (const auto answer = apps::answer(program(), call)) {
    std::fputs(answer->c_str(), stdout);
    return ExitCode::all_answer;
  }
  const Result<Options> options = options_of(call);
  if (!options) return refuse(options.error());
  const host::StopSignal stop(static_cast<int>(ExitCode::some_silent));
  return run(*options, stop);
}

}  // namespace
}  // namespace orca::hwprobe

int main(int argc, char** argv) {
  using namespace orca::hwprobe;
  const ExitCode code = act({argv + 1, argv + argc});
  const bool lost = !orca::apps::output_has_arrived();
  return static_cast<int>(code == ExitCode::all_answer && lost ? ExitCode::some_silent : code);
}
