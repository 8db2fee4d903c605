// SPDX-License-Identifier: LGPL-3.0-or-later
// Sine, cosine, tangent and their inverses.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <utility>

#include "error_free.hpp"
#include "orca/base/portable_math.hpp"

namespace orca::portable {
namespace {

constexpr double kMostExact =
    1e6;  // [rad] below which the reduction loses nothing: less than 2^20 quarter turns
constexpr double kEighthTurn = 0.25 * std::numbers::pi;

// Pi / 2 in parts of 33 bits, whose products with numbers below 2^20 are exact, and the rest.
constexpr double kQuarter1 = 0x1.921fb54400000p+0;
constexpr double kQuarter2 = 0x1.0b4611a600000p-34;
constexpr double kQuarter3 = 0x1.3198a2e000000p-69;
constexpr double kQuarter4 = 0x1.b839a252049c1p-104;

// An angle as a number of quarter turns and a rest within an eighth.
struct Reduced {
  std::int64_t quarter;
  Pair rest;
};

Reduced reduced(double angle) {
  if (std::fabs(angle) <= kEighthTurn) return {0, {angle, 0.0}};
  if (!(std::fabs(angle) < kMostExact)) angle = std::fmod(angle, 2.0 * std::numbers::pi);
  if (std::isnan(angle)) return {0, {angle, 0.0}};  // of an infinite one, too
  const double count = rounded(angle * (2.0 * std::numbers::inv_pi));
  const Pair second = exact_sum(angle - count * kQuarter1, -count * kQuarter2);
  const Pair third = exact_sum(second.high, -count * kQuarter3);
  const double low = (second.low + third.low) - count * kQuarter4;
  return {static_cast<std::int64_t>(count), exact_sum_of_ordered(third.high, low)};
}

// Taylor's series; their next terms are below 1e-19 at an eighth turn.
double sine_of(const Pair& x) {
  const double square = x.high * x.high;
  if (square == 0.0) return x.high;  // keeps the sign of a zero
  const double series =
      polynomial(square, 1.0 / 355687428096000.0, -1.0 / 1307674368000.0, 1.0 / 6227020800.0,
                 -1.0 / 39916800.0, 1.0 / 362880.0, -1.0 / 5040.0, 1.0 / 120.0, -1.0 / 6.0);
  return x.high + (x.high * square * series + x.low * (1.0 - 0.5 * square));
}

double cosine_of(const Pair& x) {
  const double square = x.high * x.high;
  const double series =
      polynomial(square, -1.0 / 6402373705728000.0, 1.0 / 20922789888000.0, -1.0 / 87178291200.0,
                 1.0 / 479001600.0, -1.0 / 3628800.0, 1.0 / 40320.0, -1.0 / 720.0, 1.0 / 24.0);
  const Pair first = exact_sum_of_ordered(1.0, -0.5 * square);
  return first.high + (first.low + (square * square * series - x.high * x.low));
}

// The arc tangents of 0/16 to 16/16.
constexpr double kSteps = 16.0;
constexpr std::array<Pair, 17> kArcs{{{0x0.0p+0, 0x0.0p+0},
                                      {0x1.ff55bb72cfdeap-5, -0x1.c934d86d23f1dp-60},
                                      {0x1.fd5ba9aac2f6ep-4, -0x1.cd37686760c17p-59},
                                      {0x1.7b97b4bce5b02p-3, 0x1.347b0b4f881cap-58},
                                      {0x1.f5b75f92c80ddp-3, 0x1.8ab6e3cf7afbdp-57},
                                      {0x1.362773707ebccp-2, -0x1.963a544b672d8p-57},
                                      {0x1.6f61941e4def1p-2, -0x1.c63aae6f6e918p-56},
                                      {0x1.a64eec3cc23fdp-2, -0x1.24dec1b50b7ffp-56},
                                      {0x1.dac670561bb4fp-2, 0x1.a2b7f222f65e2p-56},
                                      {0x1.0657e94db30d0p-1, -0x1.d5b495f6349e6p-56},
                                      {0x1.1e00babdefeb4p-1, -0x1.928df287a668fp-58},
                                      {0x1.345f01cce37bbp-1, 0x1.1021137c71102p-55},
                                      {0x1.4978fa3269ee1p-1, 0x1.2419a87f2a458p-56},
                                      {0x1.5d58987169b18p-1, 0x1.0028e4bc5e7cap-57},
                                      {0x1.700a7c5784634p-1, -0x1.8c34d25aadef6p-56},
                                      {0x1.819d0b7158a4dp-1, -0x1.bf76229d3b917p-56},
                                      {0x1.921fb54442d18p-1, 0x1.1a62633145c07p-55}}};
constexpr Pair kPi{0x1.921fb54442d18p+1, 0x1.1a62633145c07p-53};

// Returns the arc tangent of numerator / denominator, which is within 1/32.
Pair small_arc(const Pair& numerator, const Pair& denominator) {
  const double ratio = numerator.high / denominator.high;
  const Pair back = exact_product(ratio, denominator.high);
  const double missing =
      ((numerator.high - back.high) - back.low + numerator.low - ratio * denominator.low) / denominator.high;
  const double square = ratio * ratio;
  const double series = polynomial(square, -1.0 / 11.0, 1.0 / 9.0, -1.0 / 7.0, 1.0 / 5.0, -1.0 / 3.0);
  return {ratio, missing + ratio * square * series};
}

constexpr double kLeastRatio = 0x1p-60;  // below, an arc tangent equals its argument

// Returns the arc tangent of y / x for 0 <= y <= x.
// With c = i/16 near y / x: atan(y / x) = atan(c) + atan((y - c x) / (x + c y)).
Pair arc(double y, double x) {
  if (x > 0x1p+500 || x < 0x1p-500) {  // Scaling changes no bit of the ratio and keeps the products in range.
    const double scale = x > 1.0 ? 0x1p-550 : 0x1p+550;
    y *= scale;
    x *= scale;
  }
  const double step = rounded(kSteps * (y / x));
  const double c = step / kSteps;
  const Pair cx = exact_product(c, x);
  const Pair numerator = exact_sum(y, -cx.high);
  const Pair rest = small_arc({numerator.high, numerator.low - cx.low}, exact_sum_of_ordered(x, c * y));
  const Pair& whole = kArcs[static_cast<std::size_t>(step)];
  const Pair sum = exact_sum(whole.high, rest.high);
  return {sum.high, sum.low + (whole.low + rest.low)};
}

// Returns the arc of two infinities, or of one and a number: as if they were far off.
double arc_of_infinite(double y, double x) {
  const auto near = [](double value) { return std::copysign(std::isinf(value) ? 1.0 : 0.0, value); };
  return atan2(near(y), near(x));
}

}  // namespace

CosSin cos_sin(double angle) {
  const Reduced r = reduced(angle);
  const double along = cosine_of(r.rest);
  const double across = sine_of(r.rest);
  switch (r.quarter & 3) {
    case 0: return {along, across};
    case 1: return {-across, along};
    case 2: return {-along, -across};
    default: return {across, -along};
  }
}

double sin(double angle) {
  const Reduced r = reduced(angle);
  const double size = (r.quarter & 1) == 0 ? sine_of(r.rest) : cosine_of(r.rest);
  return (r.quarter & 2) == 0 ? size : -size;
}

double cos(double angle) {
  const Reduced r = reduced(angle);
  const double size = (r.quarter & 1) == 0 ? cosine_of(r.rest) : sine_of(r.rest);
  return ((r.quarter + 1) & 2) == 0 ? size : -size;
}

double tan(double angle) {
  const CosSin at = cos_sin(angle);
  return at.sin / at.cos;
}

double atan2(double y, double x) {
  if (std::isnan(x) || std::isnan(y)) return std::numeric_limits<double>::quiet_NaN();
  if (std::isinf(x) || std::isinf(y)) return arc_of_infinite(y, x);
  double across = std::fabs(y);
  double along = std::fabs(x);
  const bool steep = across > along;
  if (steep) std::swap(across, along);
  if (along == 0.0) return std::copysign(std::signbit(x) ? std::numbers::pi : 0.0, y);
  Pair result = across < kLeastRatio * along ? Pair{across / along, 0.0} : arc(across, along);
  if (steep) {
    const Pair rest = exact_sum_of_ordered(0.5 * kPi.high, -result.high);
    result = {rest.high, rest.low + (0.5 * kPi.low - result.low)};
  }
  if (std::signbit(x)) {
    const Pair rest = exact_sum_of_ordered(kPi.high, -result.high);
    result = {rest.high, rest.low + (kPi.low - result.low)};
  }
  return std::copysign(result.high + result.low, y);
}

double acos(double x) { return atan2(std::sqrt((1.0 - x) * (1.0 + x)), x); }

double asin(double x) { return atan2(x, std::sqrt((1.0 - x) * (1.0 + x))); }

}  // namespace orca::portable
