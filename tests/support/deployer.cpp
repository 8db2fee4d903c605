// SPDX-License-Identifier: GPL-3.0-or-later
#include "deployer.hpp"

#include <fstream>
#include <memory>
#include <sstream>

namespace orca::test {

std::vector<std::string> split_lines(std::string_view text) {
  std::vector<std::string> lines;
  std::istringstream in{std::string(text)};
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> Run::lines() const { return split_lines(out); }

std::vector<Arrival> Run::arrivals() const {
  std::vector<Arrival> arrivals;
  for (const std::string& line : lines()) {
    std::istringstream words(line);
    std::string kind;
    Arrival arrival;
    if (!(words >> kind >> arrival.name >> arrival.x >> arrival.y >> arrival.t) || kind != "arrived")
      continue;
    words >> arrival.robot;
    arrivals.push_back(arrival);
  }
  return arrivals;
}

Words Run::goals() const {
  Words names;
  for (const Arrival& arrival : arrivals()) names.push_back(arrival.name);
  return names;
}

std::vector<std::string> Run::failures() const { return lines_with("failed "); }

std::vector<std::string> Run::contacts() const { return lines_with("contact "); }

std::vector<std::string> Run::lines_with(std::string_view beginning) const {
  std::vector<std::string> found;
  for (const std::string& line : lines())
    if (line.starts_with(beginning)) found.push_back(line);
  return found;
}

std::optional<std::string> Run::trace_hash() const {
  constexpr std::string_view kLabel = "trace-hash ";
  const std::vector<std::string> all = lines();
  if (all.empty() || !all.back().starts_with(kLabel)) return std::nullopt;
  std::string hash = all.back().substr(kLabel.size());
  const bool hexadecimal = hash.find_first_not_of("0123456789abcdef") == std::string::npos;
  return hash.size() == 16 && hexadecimal ? std::optional(hash) : std::nullopt;
}

bool Run::says(std::string_view text) const { return err.find(text) != std::string::npos; }

Words Run::said(std::string_view text) const {
  Words found = split_lines(err);
  std::erase_if(found, [&](const std::string& line) { return line.find(text) == std::string::npos; });
  return found;
}

std::string Run::line_with(std::string_view text) const {
  const Words found = said(text);
  return found.empty() ? std::string() : found.front();
}

Words operator+(Words a, const Words& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Words deployer(const Words& words) { return Words{ORCA_BINARY_DIR "/bin/deployer"} + words; }

Words hwprobe(const Words& words) { return Words{ORCA_BINARY_DIR "/bin/hwprobe"} + words; }

Words orcactl(const Words& words) { return Words{ORCA_BINARY_DIR "/bin/orcactl"} + words; }

Run run_orcactl(const Words& words, Seconds limit) {
  Subprocess program(orcactl(words));
  return finish(program, limit);
}

Words virtual_clock() {
  return kThreadSanitizer ? Words{"--clock", "virtual", "--executor", "baton"} : Words{"--clock", "virtual"};
}

Run finish(Subprocess& program, Seconds limit) {
  Run run;
  const std::optional<Ending> ending = program.wait(limit * kSlowdown);
  run.ended = ending.has_value();
  run.ending = ending.value_or(Ending{});
  run.out = program.out();
  run.err = program.err();
  return run;
}

Run run_deployer(const Words& words, Seconds limit) {
  Subprocess program(deployer(words));
  return finish(program, limit);
}

std::vector<Run> run_together(const std::vector<Words>& commands, Seconds limit) {
  std::vector<std::unique_ptr<Subprocess>> programs;
  for (const Words& words : commands)
    programs.push_back(std::make_unique<Subprocess>(
        deployer(words + Words{"--name", "beside_" + std::to_string(programs.size())})));
  std::vector<Run> runs;
  for (const auto& program : programs) runs.push_back(finish(*program, limit));
  return runs;
}

std::string source_file(std::string_view path) {
  return std::string(ORCA_SOURCE_DIR "/") + std::string(path);
}

Words with_test_plugins() { return {"--set", "plugins=" ORCA_BINARY_DIR "/tests/plugins"}; }

std::string system_graph(std::string_view name) {
  return source_file("tests/data/graphs/system/") + std::string(name);
}

std::string line_of(const std::string& file, std::string_view text) {
  std::ifstream lines(file);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.find(text) != std::string::npos) return std::to_string(number);
  }
  return "0";
}

}  // namespace orca::test
