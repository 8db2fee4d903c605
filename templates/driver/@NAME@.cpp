#include <cstdint>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "orca/hardware.hpp"
#include "orca/hw/framing/byte_reader.hpp"
#include "orca/hw/framing/checksums.hpp"
#include "orca/hw/laser_driver.hpp"
#include "orca/hw/line_frames.hpp"

namespace {

using namespace std::chrono_literals;
using orca::Duration;
using orca::Result;
using orca::Status;
using orca::TimePoint;
using orca::hw::framing::ByteReader;
using orca::hw::framing::Finding;
using Bytes = std::span<const std::uint8_t>;

// A frame of @CLASS@: A5h, its kind, the length of its content in two bytes, the content, a CRC of all that in two bytes.
constexpr std::uint8_t kStart = 0xA5;
constexpr std::size_t kHead = 4, kCheck = 2, kLongestContent = 256;  // [bytes]
constexpr std::uint8_t kName = 'v', kScan = 's';                     // kinds

Finding look_for(Bytes bytes) {
  if (bytes[0] != kStart) return {Finding::Kind::nothing, 0};
  if (bytes.size() < kHead) return {Finding::Kind::need_more, 0};
  ByteReader head(bytes.subspan(2));
  const std::size_t content = head.u16();
  if (content > kLongestContent) return {Finding::Kind::nothing, 0};
  const std::size_t whole = kHead + content + kCheck;
  if (bytes.size() < whole) return {Finding::Kind::need_more, 0};
  ByteReader check(bytes.subspan(kHead + content));
  if (check.u16() != orca::hw::framing::crc_ccitt(bytes.first(kHead + content)))
    return {Finding::Kind::bad_checksum, 0};
  return {Finding::Kind::frame, whole};
}

/// The conversation with @CLASS@.
class @CLASS@Session final : public orca::hw::LineSession {
 public:
  using Take = std::function<void(Bytes scan, TimePoint sent)>;

  @CLASS@Session(orca::hw::link::ByteLink& link, Take take) : link_(link), take_(std::move(take)) {}

  // The line is open: ask who is there, again until it answers.
  Status begin(TimePoint now) override {
    named_ = false;
    begun_ = asked_ = now;
    return ask('V');
  }
  Result<bool> advance(TimePoint now) override {
    if (Status read = receive(now); !read.ok()) return read.error();
    if (named_) return true;
    if (now - begun_ > 2s)
      return orca::fail(orca::Code::deadline_exceeded, "nothing answers as @CLASS@ does; is it switched on?");
    if (now < next()) return false;
    asked_ = now;
    if (Status asked = ask('V'); !asked.ok()) return asked.error();
    return false;
  }
  [[nodiscard]] TimePoint next() const override { return named_ ? orca::kForever : asked_ + 300ms; }
  [[nodiscard]] orca::hw::LineCounts counts() const override {
    return orca::hw::counts_of(frames_.statistics());
  }

  Status ask(char what) {
    const auto byte = static_cast<std::uint8_t>(what);
    return link_.write({&byte, 1});
  }
  Status receive(TimePoint now) {
    return frames_.read(link_, now, [this](const orca::hw::framing::Frame& frame, TimePoint sent) {
      const Bytes content = frame.bytes.subspan(kHead, frame.bytes.size() - kHead - kCheck);
      if (frame.bytes[1] == kName) named_ = true;
      if (frame.bytes[1] == kScan) take_(content, sent);
    });
  }

 private:
  orca::hw::link::ByteLink& link_;
  const Take take_;
  orca::hw::LineFrames frames_{{look_for, kHead + kLongestContent + kCheck}};
  bool named_ = false;
  TimePoint begun_{}, asked_{};
};

/// @CLASS@, a made-up laser with 61 beams over half a circle, ten times a second.
class @CLASS@ final : public orca::hw::LaserDriver {
 public:
  explicit @CLASS@(orca::hw::HardwareHost& host)
      : LaserDriver(host, {.baud = 115200}, {.vendor = "nobody", .model = "@CLASS@"}) {}

 protected:
  [[nodiscard]] Scans scans() const override {
    return {.beams = kBeams,
            .first_angle = -0.5 * std::numbers::pi,
            .increment = std::numbers::pi / (kBeams - 1),
            .min_range = 0.05,
            .max_range = 8.0,
            .period = 100ms};
  }
  orca::hw::LineSession& session() override {
    if (!session_) session_.emplace(line(), [this](Bytes scan, TimePoint sent) { take(scan, sent); });
    return *session_;
  }

  // Somebody wants scans, or nobody any more.
  Status start() override { return session_->ask('S'); }
  void stop() override { (void)session_->ask('Q'); }
  void take_leave() override { stop(); }

  // Called when something has come, and now and then.
  Status look(TimePoint now) override { return session_->receive(now); }
  // When nobody uses it, it says nothing.
  [[nodiscard]] Duration longest_silence() const override {
    return state() == orca::hw::HardwareState::active ? Duration(1s) : Duration::max();
  }

 private:
  static constexpr std::size_t kBeams = 61;

  void take(Bytes scan, TimePoint sent) {
    if (scan.size() != 2 * kBeams) return;
    heard(sent);
    std::vector<double> ranges;
    for (ByteReader reader(scan); reader.remaining() > 0;) {
      const std::uint16_t millimetres = reader.u16();  // 0: nothing is there
      ranges.push_back(millimetres == 0 ? std::numeric_limits<double>::infinity() : 0.001 * millimetres);
    }
    publish(ranges, sent, 0.0);
  }

  std::optional<@CLASS@Session> session_;
};

}  // namespace

ORCA_HARDWARE(@CLASS@, "@TYPE@")
