// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/base/random.hpp"

#include <bit>
#include <cmath>

#include "orca/base/hash.hpp"
#include "orca/base/portable_math.hpp"

namespace orca {
namespace {

std::uint64_t split_mix(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

}  // namespace

RandomStream::RandomStream(std::uint64_t run_seed, std::string_view component, std::string_view name) {
  Fnv1a key;
  key.add_u64(run_seed);
  key.add_text(component);
  key.add_text(name);
  std::uint64_t seed = key.value();
  for (std::uint64_t& word : state_) word = split_mix(seed);
}

RandomStream::result_type RandomStream::operator()() {
  const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
  const std::uint64_t t = state_[1] << 17;
  state_[2] ^= state_[0];
  state_[3] ^= state_[1];
  state_[1] ^= state_[2];
  state_[0] ^= state_[3];
  state_[2] ^= t;
  state_[3] = std::rotl(state_[3], 45);
  return result;
}

double RandomStream::uniform(double low, double high) {
  const double unit = static_cast<double>((*this)() >> 11) * 0x1.0p-53;
  return low + (high - low) * unit;
}

double RandomStream::normal(double mean, double sigma) {
  if (has_spare_) {
    has_spare_ = false;
    return mean + sigma * spare_;
  }
  double u = 0.0;
  double v = 0.0;
  double s = 0.0;
  do {
    u = uniform(-1.0, 1.0);
    v = uniform(-1.0, 1.0);
    s = u * u + v * v;
  } while (s >= 1.0 || s == 0.0);
  const double scale = std::sqrt(-2.0 * portable::log(s) / s);
  spare_ = v * scale;
  has_spare_ = true;
  return mean + sigma * u * scale;
}

bool RandomStream::chance(double probability) { return uniform(0.0, 1.0) < probability; }

}  // namespace orca
