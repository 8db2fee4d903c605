// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/camera/pixels.hpp"
#include "orca/hw/camera/video_calls.hpp"

namespace orca::hw::camera {

/// The pictures that somebody would like to have. A plain value.
struct Wish {
  std::size_t width = 640;   ///< [pixels]
  std::size_t height = 480;  ///< [pixels]
  double rate = 30.0;        ///< [Hz]
  Channels channels = Channels::rgb;
};

/// The pictures that a camera gives. A plain value.
struct Mode {
  Layout layout;
  std::optional<double> rate;  ///< [Hz]; nothing: the camera does not say.
  std::string format;          ///< As Video4Linux2 calls it: "MJPG".
  friend bool operator==(const Mode&, const Mode&) = default;
};

/// A picture as it came. Its bytes are those of the device: they are there until the function that got it returns.
struct Frame {
  std::span<const std::uint8_t>
      bytes;               ///< Empty if the driver says that it is broken, or gives a length that cannot be.
  Duration age{0};         ///< Since the middle of its exposure, as well as that is known.
  std::uint64_t lost = 0;  ///< Pictures before it that did not come, or were too old when somebody looked.
};

/// The conversation with a camera by the streaming of Video4Linux2, whose pictures lie in buffers of the device that are mapped into
/// memory. No function waits for a picture; open() and start() return when the device has taken its orders, which it may take a
/// fraction of a second to do.
///
/// Thread contract: not synchronised; one strand.
class Stream {
 public:
  /// @param calls  outlives this object.
  /// @param path   of the device, as people wrote it: /dev/video0.
  Stream(VideoCalls& calls, std::string path) : calls_(calls), path_(std::move(path)) {}
  ~Stream() { close(); }
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;

  /// Opens the device, and chooses the format, size and rate that come nearest to the wish: see choose_mode().
  /// @errors  not_found: nothing is there. failed_precondition: this user may not open it. unavailable: another program has it.
  ///          invalid_argument: it is no camera, or gives no format that is read here. Each says what to do.
  Result<Mode> open(const Wish& wish);
  /// Returns what the device calls itself. @pre  it is open.
  [[nodiscard]] const std::string& card() const { return card_; }
  /// Lets pictures come. @pre  it is open.
  /// @errors  as open(); unavailable if the bus has no room for such pictures.
  Status start();
  /// Lets no more come, and gives the buffers back; also if the device has gone.
  void stop();
  /// Stops, and closes the device; also if it is closed.
  void close();
  /// Returns whether pictures come, or may come.
  [[nodiscard]] bool is_started() const { return !buffers_.empty(); }
  /// Returns the descriptor at which pictures arrive; -1 while none can come.
  [[nodiscard]] int descriptor() const { return is_started() ? descriptor_ : -1; }

  /// Looks for pictures, and gives the latest to `use`. Those before it are counted as lost.
  /// @return whether there was one.
  /// @errors  not_found: the device has gone. unavailable: it has failed in another way.
  Result<bool> take(const std::function<void(const Frame&)>& use);
  /// Looks whether the device is still there. @pre  it is open.
  /// @errors  not_found: it has gone.
  Status check_present();

 private:
  struct Buffer {
    std::uint8_t* at = nullptr;
    std::size_t length = 0;
  };
  struct Taken {
    std::uint32_t index = 0;
    std::size_t length = 0;  // 0: broken
    std::uint32_t sequence = 0;
    Duration age{0};
  };

  Status meet();
  Status set_up_buffers();
  Status map_buffer(std::uint32_t index);
  Status queue(std::uint32_t index);
  Result<std::optional<Taken>> dequeue();
  [[nodiscard]] Duration half_exposure() const;
  [[nodiscard]] Error failed(const std::string& what, int reason) const;

  VideoCalls& calls_;
  const std::string path_;
  int descriptor_ = -1;
  std::string card_;
  std::vector<Buffer> buffers_;
  Duration half_exposure_{0};
  std::optional<std::uint32_t> last_;  // sequence number of the latest picture
};

}  // namespace orca::hw::camera
