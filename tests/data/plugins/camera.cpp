// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// A camera whose pictures have `size` bytes that hardly repeat, each with others.
class Camera final : public orca::Component {
 public:
  explicit Camera(orca::ComponentHost& host) : Component(host) { lap_every(std::chrono::milliseconds(10)); }

 private:
  orca::Outcome work() override {
    auto image = image_.loan();
    const auto size = static_cast<std::uint32_t>(*size_);
    image->width(size);
    image->height(1);
    image->step(size);
    image->data().resize(size);
    for (std::uint8_t& byte : image->data())
      byte = static_cast<std::uint8_t>((state_ = state_ * 1664525U + 1013904223U) >> 24U);
    image_.push(std::move(image));
    return orca::again();
  }

  orca::PushServer<orca::idl::Image> image_{*this, "image"};
  orca::Param<std::int64_t> size_{
      *this, "size", 1000, {.min = 1, .max = 10'000'000, .text = "Bytes of a picture."}};
  std::uint32_t state_ = 1;
};

}  // namespace

ORCA_COMPONENT(Camera, "test.Camera")
