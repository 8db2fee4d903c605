// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "tables.hpp"

#include <cstdint>
#include <cstdio>
#include <string>

#include "orca/base/output_file.hpp"
#include "orca/batch/lap_times.hpp"
#include "orca/xml/number.hpp"

namespace orca::simbatch {
namespace {

std::string quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string key_of(const batch::Row& row) {
  return row.variant + "," + row.world + "," + std::to_string(row.seed);
}

std::string line_of(const batch::Row& row) {
  const batch::Outcome& o = row.outcome;
  std::string line = key_of(row) + "," + batch::name_of(o.ending) + "," + batch::name_of(o.failure) + "," +
                     xml::number_text(o.time);
  for (const std::uint32_t count : {o.goals, o.failed_goals, o.contacts}) line += "," + std::to_string(count);
  for (const batch::Measure& measure : batch::all_measures()) {
    const std::optional<double>& value = o.measures.*measure.value;
    line += "," + (value ? xml::number_text(*value) : "");
  }
  return line + "," + o.trace_hash + "," + quoted(o.reason) + "\n";
}

using Table = Status (*)(const batch::Store&, const Take&);

Status write_table(const batch::Store& store, Table table, const std::filesystem::path& file) {
  OutputFile out("the table");
  if (Status opened = out.open(file.string()); !opened.ok()) return opened;
  if (Status read = table(store, [&](std::string_view line) { out.write(line); }); !read.ok()) return read;
  return out.close();
}

}  // namespace

Status runs_table(const batch::Store& store, const Take& take) {
  std::string title = "variant,world,seed,ending,failure,time,goals,failed_goals,contacts";
  for (const batch::Measure& measure : batch::all_measures()) title += std::string(",") + measure.name;
  take(title + ",trace_hash,reason\n");
  return store.for_each([&](const batch::Row& row) { take(line_of(row)); });
}

Status timing_table(const batch::Store& store, const Take& take) {
  take("variant,world,seed,wall,cpu\n");
  return store.for_each([&](const batch::Row& row) {
    take(key_of(row) + "," + xml::number_text(row.cost.wall) + "," + xml::number_text(row.cost.cpu) + "\n");
  });
}

Status laps_table(const batch::Store& store, const Take& take) {
  take("variant,world,seed,component,laps,mean,p95,longest\n");
  return store.for_each([&](const batch::Row& row) {
    for (const batch::LapCost& one : row.cost.laps)
      take(key_of(row) + "," + one.component + "," + std::to_string(one.laps) + "," +
           xml::number_text(one.mean) + "," + xml::number_text(one.p95) + "," +
           xml::number_text(one.longest) + "\n");
  });
}

std::string laps_summary(const batch::Store& store) {
  batch::LapTimes times;
  (void)store.for_each([&](const batch::Row& row) { times.add(row); });
  std::string text;
  for (const auto& [variant, components] : times.of_variant) {
    text += variant + ": processor time per lap:";
    for (const auto& [component, sum] : components) {
      char part[32];
      std::snprintf(part, sizeof part, " %.3g ms", 1e3 * sum.mean());
      text += (text.ends_with(':') ? " " : ", ") + component + part;
    }
    text += "\n";
  }
  return text;
}

Status write_tables(const batch::Store& store, const std::filesystem::path& folder) {
  if (Status written = write_table(store, runs_table, folder / "runs.csv"); !written.ok()) return written;
  if (Status written = write_table(store, timing_table, folder / "timing.csv"); !written.ok()) return written;
  return write_table(store, laps_table, folder / "laps.csv");
}

}  // namespace orca::simbatch
