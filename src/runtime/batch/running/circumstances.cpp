// SPDX-License-Identifier: LGPL-3.0-or-later
#include "circumstances.hpp"

#include <malloc.h>
#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace orca::batch {
namespace {

constexpr std::size_t kLargestBlock = 512;  // [bytes] of what a component keeps many of
constexpr std::size_t kBlocksEach = 1000;
constexpr std::size_t kMovedBy = 37UL << 20;  // [bytes]
constexpr int kFill = 0xa5;

}  // namespace

void change_environment() {
  setenv("ORCA_ANOTHER_RUN", std::string(5000, 'x').c_str(), 1);
  setenv("HOME", "/", 1);
  setenv("USER", "somebody", 1);
  setenv("LOGNAME", "somebody", 1);
  setenv("TZ", "Pacific/Chatham", 1);
  unsetenv("PWD");
}

// Holes of each size between blocks that stay: the library hands the hole out first that became free last.
void scramble_heap() {
  mallopt(M_PERTURB, kFill);
  std::minstd_rand random(1);  // the same each time, so that what is found once is found again
  std::vector<void*> holes;
  for (std::size_t size = 16; size <= kLargestBlock; size += 16) {
    for (std::size_t i = 0; i < 2 * kBlocksEach; ++i) {
      void* const block = std::malloc(size);
      if (i % 2 == 0) holes.push_back(block);
    }
  }
  std::shuffle(holes.begin(), holes.end(), random);
  for (void* const hole : holes) std::free(hole);
  // Whatever is mapped from here on lies elsewhere.
  (void)mmap(nullptr, kMovedBy, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
}

}  // namespace orca::batch
