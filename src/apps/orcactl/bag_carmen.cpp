// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "bag_carmen.hpp"

#include "orca/recording/objects/carmen_writer.hpp"
#include "table.hpp"

namespace orca::orcactl {

Status print_carmen_log(const recording::ObjectReader& reader, const std::set<std::string>& ports) {
  recording::CarmenText text;
  print(recording::CarmenText::beginning());
  const Status read = reader.objects(ports, [&](const recording::RecordedObject& one) {
    print(text.text_of(one.row, one.object));
    return true;
  });
  print(text.ending());
  return read.ok() ? text.check() : read;
}

}  // namespace orca::orcactl
