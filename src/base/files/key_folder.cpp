// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/files/key_folder.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace orca {

std::string as_file_name(std::string name) {
  std::ranges::replace(name, '/', '-');
  return name;
}

Result<std::string> config_folder() {
  const char* const configured = std::getenv("XDG_CONFIG_HOME");
  const char* const home = std::getenv("HOME");
  std::string folder;
  if (configured != nullptr && configured[0] == '/')
    folder = configured;
  else if (home != nullptr && home[0] == '/')
    folder = std::string(home) + "/.config";
  else
    return fail(Code::not_found,
                "there is no folder for keys: neither XDG_CONFIG_HOME nor HOME names one; set one of them");
  return folder + "/orca";
}

Result<std::string> keys_of_system(const std::string& system) {
  Result<std::string> folder = config_folder();
  if (!folder) return folder;
  return std::move(folder).value() + "/keys/" + as_file_name(system);
}

std::string key_folder_name(const std::string& machine) {
  return machine.empty() ? "this-machine" : as_file_name(machine);
}

std::string key_file_name(const std::string& process) { return as_file_name(process) + ".key"; }

Result<std::string> key_folder(const std::string& system, const std::string& machine) {
  Result<std::string> folder = keys_of_system(system);
  if (!folder) return folder;
  return std::move(folder).value() + "/" + key_folder_name(machine);
}

}  // namespace orca
