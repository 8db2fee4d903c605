// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cstdint>
#include <numeric>
#include <string>

#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Looks at the pictures of a test.Camera, keeps the last few, and tells in the log when they begin to be lent or copied:
/// "gallery PROCESS: lent".
class Gallery final : public orca::Component {
 public:
  explicit Gallery(orca::ComponentHost& host) : Component(host) { lap_on("in"); }

 private:
  static constexpr std::size_t kKept = 4;

  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto image = in_.get_update();
    if (!is_whole(*image)) log_error("gallery: a wrong picture");
    const auto* const block = image->data().block();
    const std::string way = block != nullptr && block->ended != nullptr ? "lent" : "copied";
    if (way != way_) log_info("gallery " + std::to_string(getpid()) + ": " + way);
    way_ = way;
    kept_[next_++ % kKept] = image;
    for (const auto& kept : kept_)
      if (kept && !is_whole(*kept)) log_error("gallery: a wrong picture among those that it keeps");
    return orca::again();
  }

  // Each byte of a picture is as likely as all others.
  static bool is_whole(const orca::idl::Image& image) {
    const auto& bytes = image.data();
    if (bytes.size() != image.width()) return false;
    const auto sum = std::accumulate(bytes.begin(), bytes.end(), std::uint64_t{0});
    const double mean = static_cast<double>(sum) / static_cast<double>(bytes.size());
    return mean > 120.0 && mean < 135.0;
  }

  orca::PushProxy<orca::idl::Image> in_{*this, "in"};
  orca::ObjectPtr<orca::idl::Image> kept_[kKept];
  std::size_t next_ = 0;
  std::string way_;
};

}  // namespace

ORCA_COMPONENT(Gallery, "test.Gallery")
