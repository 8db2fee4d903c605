// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/line_session.hpp"

namespace orca::hw {

std::vector<std::uint32_t> rates_of(const link::ByteLink& link, std::vector<std::uint32_t> rates) {
  if (link.byte_time() <= 0.0) rates.resize(1);
  return rates;
}

std::string where(const link::ByteLink& link, const std::vector<std::uint32_t>& rates) {
  if (rates.size() < 2) return link.name();
  std::string text;
  for (const std::uint32_t rate : rates) text += (text.empty() ? " at " : ", ") + std::to_string(rate);
  return link.name() + text + " baud";
}

Status RateSearch::begin() {
  rate_ = 0;
  calls_ = 0;
  return link_.set_line({.baud = rate()});
}

Result<bool> RateSearch::next() {
  if (++calls_ < kCalls) return true;
  calls_ = 0;
  if (++rate_ == rates_.size()) {
    rate_ = 0;
    return false;
  }
  if (Status set = link_.set_line({.baud = rate()}); !set.ok()) return set.error();
  return true;
}

}  // namespace orca::hw
