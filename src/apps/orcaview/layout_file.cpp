// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "layout_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>

#include "answers.hpp"
#include "orca/base/descriptor.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

constexpr std::size_t kMostComponents = 10000;
constexpr double kFarthest = 1e6;             // [pixels]
constexpr std::uintmax_t kLongest = 1 << 20;  // [bytes]

bool is_place(const json& place) {
  if (!place.is_array() || place.size() != 2) return false;
  for (const json& number : place)
    if (!number.is_number() || !(std::abs(number.get<double>()) <= kFarthest)) return false;
  return true;
}

bool is_layout(const json& layout) {
  if (!layout.is_object() || layout.size() > kMostComponents) return false;
  for (const auto& [name, place] : layout.items())
    if (!is_place(place)) return false;
  return true;
}

// A line for each component, in alphabetical order, so that a change is small in a repository.
std::string text_of_layout(const json& layout) {
  std::string text = "{\n";
  std::size_t left = layout.size();
  for (const auto& [name, place] : layout.items())
    text += json(name).dump() + ": " + place.dump() + (--left > 0 ? ",\n" : "\n");
  return text + "}\n";
}

Error system_error(const std::string& what, const std::string& file) {
  return fail(Code::unavailable, what + ": " + std::generic_category().message(errno), file);
}

// Writes a file that nobody has opened yet, and puts it in its place. Nobody waits for the disk: whoever wants to stop the motors
// waits for this thread.
Status put(const std::string& file, const std::string& text) {
  const std::string fresh = file + "." + std::to_string(getpid()) + ".new";
  constexpr mode_t kAsUsual = 0666;  // less the umask
  ::unlink(fresh.c_str());
  const Descriptor out(::open(fresh.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, kAsUsual));
  if (!out) return system_error("the layout cannot be kept beside the graph", file);
  const bool is_written =
      ::write(out.number(), text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
      std::rename(fresh.c_str(), file.c_str()) == 0;
  if (is_written) return ok();
  const Error error = system_error("the layout cannot be kept beside the graph", file);
  ::unlink(fresh.c_str());
  return error;
}

}  // namespace

std::string layout_file_of(const std::string& graph_file) {
  return std::filesystem::path(graph_file).replace_extension(".layout.json").string();
}

Result<std::string> read_layout(const std::string& graph_file) {
  const std::string file = layout_file_of(graph_file);
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error == std::errc::no_such_file_or_directory) return std::string("{}");
  if (error) return fail(Code::unavailable, "the layout cannot be read: " + error.message(), file);
  std::ifstream in(file, std::ios::binary);
  if (!in) return fail(Code::unavailable, "the layout cannot be read", file);
  if (size > kLongest)
    return fail(Code::data_loss, "this file is no layout of a graph: it is too long", file);
  const json layout = read_json(std::string(std::istreambuf_iterator<char>(in), {}));
  if (!is_layout(layout))
    return fail(Code::data_loss, "this file is no layout of a graph; move it elsewhere, or remove it", file);
  return layout.dump();
}

Status keep_layout(const std::string& graph_file, const std::string& layout) {
  const json wanted = read_json(layout);
  if (!is_layout(wanted))
    return fail(Code::invalid_argument, "a layout has two numbers for each component: {\"goto\":[120,40]}");
  const Result<std::string> there = read_layout(graph_file);
  if (!there) return fail(Code::failed_precondition, there.error().message, there.error().where);
  const std::string file = layout_file_of(graph_file);
  if (!wanted.empty()) return put(file, text_of_layout(wanted));
  const bool is_gone = ::unlink(file.c_str()) == 0 || errno == ENOENT;
  return is_gone ? ok() : Status(system_error("the layout cannot be removed", file));
}

}  // namespace orca::view
