// SPDX-License-Identifier: LGPL-3.0-or-later
#include "command_line.hpp"

#include "codes.hpp"
#include "orca/base/text.hpp"

namespace orca::graph {
namespace {

class Reader {
 public:
  explicit Reader(Report& report) : report_(report) {}

  CommandLine read(const std::vector<std::string>& settings) {
    for (const std::string& setting : settings) take(setting);
    return std::move(result_);
  }

 private:
  void take(const std::string& setting) {
    const std::size_t equals = setting.find('=');
    const std::string name = setting.substr(0, equals);
    const std::size_t dot = name.rfind('.');
    const bool is_parameter = dot != std::string::npos;
    if (name.empty()) return refuse(setting, "names no argument: write --set ARG=VALUE");
    if (dot == 0 || dot == name.size() - 1)
      return refuse(setting, "names no parameter: write --set COMPONENT.PARAM=VALUE");
    if (equals == std::string::npos) {
      if (!is_parameter) result_.valueless.insert(name);
      return refuse(setting, std::string("has no value: write --set ") +
                                 (is_parameter ? "COMPONENT.PARAM" : "ARG") + "=VALUE");
    }
    add(is_parameter ? result_.parameters : result_.arguments, name, setting.substr(equals + 1));
  }

  void add(std::map<std::string, Text>& settings, const std::string& name, const std::string& value) {
    const auto [first, fresh] = settings.try_emplace(name, Text{value, command_line(), true, ""});
    if (!fresh)
      refuse(name, "is given twice, as " + in_quotes(first->second.value) + " and " + in_quotes(value) +
                       "; give it once");
  }

  void refuse(const std::string& setting, const std::string& why) {
    report_.error(codes::kBadSetting, command_line(), shown_setting(setting) + " " + why);
  }

  Report& report_;
  CommandLine result_;
};

}  // namespace

const xml::Position& command_line() {
  static const xml::Position place{"command line", 0, 0};
  return place;
}

CommandLine read_command_line(const std::vector<std::string>& settings, Report& report) {
  return Reader(report).read(settings);
}

std::string shown_option(std::string_view option, std::string_view name) {
  constexpr std::size_t kMost = 300;
  return std::string(option) + " " + shortened(name, kMost);
}

}  // namespace orca::graph
