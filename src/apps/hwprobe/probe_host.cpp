// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "probe_host.hpp"

namespace orca::hwprobe {

bool ProbeHost::set(const std::string& name, const std::string& value) {
  for (const ParamDeclaration& param : params_) {
    if (param.contract.name != name) continue;
    param.set(ParamValue(value));
    return true;
  }
  return false;
}

}  // namespace orca::hwprobe
