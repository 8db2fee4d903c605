// SPDX-License-Identifier: GPL-3.0-or-later
// Functions that compute the same bits on each machine, against the C library's in long double.
#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>

#include "orca/base/hash.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/base/random.hpp"

using namespace orca;

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr int kDraws = 20'000;

// How far a result is from the right one, in units of the right one's last place.
double ulps(double result, long double right) {
  int exponent = 0;
  (void)std::frexp(static_cast<double>(right), &exponent);
  const int last = std::max(exponent, std::numeric_limits<double>::min_exponent) - 53;
  return static_cast<double>(std::fabs(static_cast<long double>(result) - right)) / std::ldexp(1.0, last);
}

// Draws numbers of either sign, evenly over exponents: what goes wrong does so near powers of two.
double drawn(RandomStream& random, double least_exponent, double most_exponent) {
  const double size = std::ldexp(random.uniform(1.0, 2.0),
                                 static_cast<int>(std::floor(random.uniform(least_exponent, most_exponent))));
  return random.chance(0.5) ? size : -size;
}

// Returns the worst error of a function over drawn arguments with a reference that gets them as long double.
template <class Function, class Reference>
double worst(Function function, Reference reference, double least_exponent, double most_exponent) {
  RandomStream random(1, "portable_math_test", "arguments");
  double result = 0.0;
  for (int i = 0; i < kDraws; ++i) {
    const double a = drawn(random, least_exponent, most_exponent);
    const double b = drawn(random, least_exponent, most_exponent);
    result = std::max(result, ulps(function(a, b), reference(static_cast<long double>(a), b)));
  }
  return result;
}

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

}  // namespace

TEST_CASE("sine and cosine are within 1 ulp up to 1e6 rad", "[base][math]") {
  CHECK(worst([](double a, double) { return portable::sin(a); },
              [](long double a, long double) { return std::sin(a); }, -60, 19) < 1.0);
  CHECK(worst([](double a, double) { return portable::cos(a); },
              [](long double a, long double) { return std::cos(a); }, -60, 19) < 1.0);
  CHECK(worst([](double a, double) { return portable::tan(a); },
              [](long double a, long double) { return std::tan(a); }, -60, 19) < 2.5);
}

TEST_CASE("sine and cosine are within 1 ulp beside whole quarter turns", "[base][math]") {
  double most = 0.0;
  for (int quarter = -5000; quarter <= 5000; ++quarter) {
    const double angle = quarter * 0.5 * std::numbers::pi;
    most = std::max(most, ulps(portable::sin(angle), std::sin(static_cast<long double>(angle))));
    most = std::max(most, ulps(portable::cos(angle), std::cos(static_cast<long double>(angle))));
  }
  CHECK(most < 1.0);
}

TEST_CASE("beyond 1e6 rad, sine and cosine are those of an angle less than half a place away",
          "[base][math]") {
  RandomStream random(2, "portable_math_test", "far");
  for (int i = 0; i < kDraws; ++i) {
    const double angle = drawn(random, 20, 60);
    const double half_place = 0.5 * (std::nextafter(std::fabs(angle), kInfinity) - std::fabs(angle));
    const long double off_sine = portable::sin(angle) - std::sin(static_cast<long double>(angle));
    const long double off_cosine = portable::cos(angle) - std::cos(static_cast<long double>(angle));
    CHECK(std::fabs(off_sine) <= half_place + 1.2e-16L);
    CHECK(std::fabs(off_cosine) <= half_place + 1.2e-16L);
  }
}

TEST_CASE("cos_sin gives what cos and sin give", "[base][math]") {
  RandomStream random(3, "portable_math_test", "both");
  for (int i = 0; i < kDraws; ++i) {
    const double angle = drawn(random, -30, 25);
    const auto [cosine, sine] = portable::cos_sin(angle);
    CHECK(bits(cosine) == bits(portable::cos(angle)));
    CHECK(bits(sine) == bits(portable::sin(angle)));
  }
}

TEST_CASE("the arc tangent is within 1 ulp, arc sine and arc cosine within 2", "[base][math]") {
  const auto own = [](double y, double x) { return portable::atan2(y, x); };
  const auto right = [](long double y, long double x) { return std::atan2(y, x); };
  CHECK(worst(own, right, -3, 3) < 1.0);
  CHECK(worst(own, right, -40, 40) < 1.0);
  CHECK(worst(own, right, -1000, 1000) < 1.0);
  CHECK(worst([](double x, double) { return portable::asin(x); },
              [](long double x, long double) { return std::asin(x); }, -30, 0) < 2.0);
  CHECK(worst([](double x, double) { return portable::acos(x); },
              [](long double x, long double) { return std::acos(x); }, -30, 0) < 2.0);
}

TEST_CASE("exponential and logarithm are within 1 ulp", "[base][math]") {
  CHECK(worst([](double x, double) { return portable::exp(x); },
              [](long double x, long double) { return std::exp(x); }, -40, 9) < 1.0);
  const auto own = [](double x, double) { return portable::log(std::fabs(x)); };
  const auto right = [](long double x, long double) { return std::log(std::fabs(x)); };
  CHECK(worst(own, right, -2, 2) < 1.0);
  CHECK(worst(own, right, -1070, 1023) < 1.0);
  // Near 1 the logarithm vanishes.
  CHECK(worst([](double x, double) { return portable::log(1.0 + x); },
              [](long double x, long double) {
                return std::log(static_cast<long double>(1.0 + static_cast<double>(x)));
              },
              -40, -1) < 1.0);
}

TEST_CASE("results of exp below the least normal number are within 1 ulp", "[base][math]") {
  RandomStream random(4, "portable_math_test", "small");
  for (int i = 0; i < kDraws; ++i) {
    const double x = random.uniform(-745.0, -708.0);
    CHECK(ulps(portable::exp(x), std::exp(static_cast<long double>(x))) <= 1.0);
  }
}

TEST_CASE("lengths are within 1 ulp, without overflow and underflow on the way", "[base][math]") {
  const auto own = [](double x, double y) { return portable::hypot(x, y); };
  const auto right = [](long double x, long double y) { return std::hypot(x, y); };
  CHECK(worst(own, right, -3, 3) < 1.0);
  CHECK(worst(own, right, -30, 30) < 1.0);
  CHECK(worst(own, right, -1022, 1020) < 1.0);
  CHECK(portable::hypot(3e300, 4e300) == Approx(5e300));
  CHECK(portable::hypot(3e-310, 4e-310) == Approx(5e-310));
  CHECK(portable::hypot(2.0, 3.0, 6.0) == 7.0);
}

TEST_CASE("infinities, zeros and NaN are treated as the C library treats them", "[base][math]") {
  const auto same = [](double own, double right) {
    return std::isnan(right) ? std::isnan(own) : bits(own) == bits(right);
  };
  for (const double a : {0.0, -0.0, kInfinity, -kInfinity, kNan}) {
    CAPTURE(a);
    CHECK(same(portable::sin(a), std::sin(a)));
    CHECK(same(portable::cos(a), std::cos(a)));
    CHECK(same(portable::tan(a), std::tan(a)));
    CHECK(same(portable::asin(a), std::asin(a)));
    CHECK(same(portable::acos(a), std::acos(a)));
    CHECK(same(portable::exp(a), std::exp(a)));
    CHECK(same(portable::log(a), std::log(a)));
    for (const double b : {0.0, -0.0, 1.0, -1.0, 1e-320, -1e-320, kInfinity, -kInfinity, kNan}) {
      CAPTURE(b);
      CHECK(same(portable::atan2(a, b), std::atan2(a, b)));
      CHECK(same(portable::atan2(b, a), std::atan2(b, a)));
      CHECK(same(portable::hypot(a, b), std::hypot(a, b)));
      CHECK(same(portable::hypot(b, a), std::hypot(b, a)));
    }
  }
  CHECK(std::isnan(portable::log(-1.0)));
  CHECK(std::isnan(portable::asin(1.0 + 1e-15)));
  CHECK(portable::exp(710.0) == kInfinity);
  CHECK(portable::exp(-746.0) == 0.0);
  CHECK(portable::log(1.0) == 0.0);
}

TEST_CASE("the functions give these bits on every machine", "[base][math]") {
  RandomStream random(5, "portable_math_test", "bits");
  Fnv1a hash;
  for (int i = 0; i < kDraws; ++i) {
    const double a = random.uniform(-20.0, 20.0);
    const double b = random.uniform(-20.0, 20.0);
    for (const double value : {portable::sin(a), portable::cos(a), portable::tan(a), portable::atan2(a, b),
                               portable::asin(0.05 * a), portable::acos(0.05 * a), portable::exp(a),
                               portable::log(std::fabs(a)), portable::hypot(a, b)})
      hash.add_u64(bits(value));
  }
  CHECK(hash.value() == 0xc890e1547e8a4c3bULL);
}
