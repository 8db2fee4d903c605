// SPDX-License-Identifier: LGPL-3.0-or-later
#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>

#include "orca/base/steady_clock.hpp"
#include "orca/hw/camera/video_calls.hpp"

namespace orca::hw::camera {
namespace {

constexpr unsigned kVideoDevices = 81;  // major number of the kernel's list of devices

class SystemVideo final : public VideoCalls {
 public:
  // Opened as a camera, a device of another kind may do things, so it is looked at before.
  int open(const std::string& path) override {
    struct stat about {};
    if (stat(path.c_str(), &about) != 0) return -errno;
    if (!S_ISCHR(about.st_mode) || major(about.st_rdev) != kVideoDevices) return -ENOTTY;
    const int descriptor = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return descriptor < 0 ? -errno : descriptor;
  }

  void close(int descriptor) override { ::close(descriptor); }

  int control(int descriptor, unsigned long request, void* argument) override {
    int done = 0;
    do done = ioctl(descriptor, request, argument);
    while (done != 0 && errno == EINTR);
    return done == 0 ? 0 : errno;
  }

  void* map(int descriptor, std::size_t length, std::int64_t offset) override {
    void* const at = mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, offset);
    return at == MAP_FAILED ? nullptr : at;
  }

  void unmap(void* at, std::size_t length) override { (void)munmap(at, length); }

  [[nodiscard]] Duration now() const override { return to_steady(steady_now()).time_since_epoch(); }
};

}  // namespace

std::unique_ptr<VideoCalls> make_system_video() { return std::make_unique<SystemVideo>(); }

}  // namespace orca::hw::camera
