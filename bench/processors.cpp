// SPDX-License-Identifier: GPL-3.0-or-later
#include "processors.hpp"

#include <stdexcept>

namespace orca::bench {

Processors Processors::usable() {
  Processors processors;
  CPU_ZERO(&processors.set_);
  if (sched_getaffinity(0, sizeof processors.set_, &processors.set_) != 0)
    throw std::runtime_error("the system does not tell which processors may be used");
  return processors;
}

Processors Processors::one() const {
  Processors first;
  CPU_ZERO(&first.set_);
  int processor = 0;
  while (!CPU_ISSET(processor, &set_)) ++processor;
  CPU_SET(processor, &first.set_);
  return first;
}

void Processors::use() const {
  if (sched_setaffinity(0, sizeof set_, &set_) != 0)
    throw std::runtime_error("the system does not let this thread choose its processor");
}

Processors& at_start() {
  static Processors processors = Processors::usable();
  return processors;
}

}  // namespace orca::bench
