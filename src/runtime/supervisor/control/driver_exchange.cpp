// SPDX-License-Identifier: LGPL-3.0-or-later
#include "control/driver_exchange.hpp"

#include <utility>

#include "control/exchanging.hpp"
#include "orca/base/log.hpp"
#include "orca/plugin/image.hpp"

namespace orca::supervisor {

Status order_driver_exchange(const SwapWish& wish, const graph::HardwareNode& hardware,
                             const SystemNames& names, std::function<void(const Answer& answer)> take) {
  const Result<Member*> member = names.ready_member_of(hardware);
  if (!member) return member.error();
  Result<plugin::PluginImage> image = plugin::PluginImage::copy(wish.file);
  if (!image) return image.error();
  const std::string file = image->origin();
  log::info(hardware.name, "its driver is to be exchanged for " + file);
  SwapCode swap{hardware.name,
                wish.type,
                {wish.params.begin(), wish.params.end()},
                0,
                file,
                std::move(*image).take_bytes(),
                false,
                false};
  (*member)->ask_for(std::move(swap), std::move(take));
  return ok();
}

}  // namespace orca::supervisor
