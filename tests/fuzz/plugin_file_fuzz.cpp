// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes give an error or a description of a plugin; nothing outside of them is read.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "inspection/plugin_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<std::byte> bytes(size);
  if (size > 0) std::memcpy(bytes.data(), data, size);
  const auto file = orca::plugin::PluginFile::parse(std::move(bytes));
  if (!file) {
    if (file.error().message.empty()) std::abort();
    return 0;
  }
  (void)file->faults(orca::plugin::known_type);
  (void)file->virtual_time_faults();
  (void)file->may_start_threads();
  return 0;
}
