// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ros_ends.hpp"

#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/log.hpp"

namespace orca::dds::of_ros {
namespace {

constexpr std::size_t kMostQueued = std::size_t{4} << 20;  // [bytes] that wait for the outbox
constexpr Duration kPatience = 3s;                         // with those who say where sensors are
constexpr std::size_t kMostWaiting = 256;                  // objects that wait for a strand
constexpr std::size_t kMostBytes = std::size_t{16} << 20;  // [bytes] that they had as messages

}  // namespace

// --- Out --------------------------------------------------------------------------------------------------

bool RosPublication::write(const ObjectRef& object, std::size_t /*size*/, const Label& /*label*/) {
  // An object of a derived type may say more in the same message.
  const ros::Twin* const twin = ros::twin_to_ros(object.type(), twin_.message);
  if (twin == nullptr) return false;
  std::vector<std::vector<std::byte>> payloads;
  twin->to_ros(object, payloads);
  for (const std::vector<std::byte>& payload : payloads) writer_->write(payload);
  frames_.say(object);
  return true;
}

bool RosPublication::write(std::vector<std::byte> /*messages*/) { return false; }

bool RosPublication::post(const std::shared_ptr<RosPublication>& to, const ObjectRef& object,
                          Outbox& outbox) {
  if (!to->is_latched() && to->queued.load(std::memory_order_relaxed) >= kMostQueued) return false;
  outbox.post({to, object, {}, {}, object.type().write(object.get(), {})});
  return true;
}

PushToRos::PushToRos(Strand& strand, PushSource& source, std::shared_ptr<RosPublication> publication,
                     Outbox& outbox, std::shared_ptr<Bell> bell, Unread unread)
    : strand_(strand),
      source_(source),
      publication_(std::move(publication)),
      outbox_(outbox),
      bell_(std::move(bell)),
      unread_(unread) {
  strand_.add_intake(*this);
}

PushToRos::~PushToRos() {
  bell_->remove();
  strand_.remove_intake(*this);
  const MutexLock lock(mutex_);
  if (attached_) source_.detach();
}

std::optional<Duration> PushToRos::deliver(ObjectRef&& object) {
  Unread first = Unread::first;
  if (RosPublication::post(publication_, object, outbox_) &&
      unread_.compare_exchange_strong(first, Unread::nothing))
    bell_->ring();  // it may leave now
  return std::nullopt;
}

bool PushToRos::take_in() {
  if (!mutex_.try_lock()) return false;
  const MutexLock lock(mutex_, std::adopt_lock);
  const Unread unread = unread_;
  const bool wanted = unread == Unread::all || unread == Unread::first || publication_->has_readers() ||
                      (unread == Unread::moves && publication_->are_frames_heard());
  if (wanted == attached_) return false;
  attached_ = wanted;
  if (wanted)
    source_.attach(*this, {});
  else
    source_.detach();
  return true;
}

std::optional<Status> SendToRos::offer(const ObjectRef& object, SendReplySink& /*reply_to*/, RequestId /*id*/,
                                       bool /*may_wait*/) {
  if (!publication_->is_latched() && !publication_->has_readers())
    return fail(Code::unavailable, "nobody reads topic " + topic_ + " of ROS 2");
  if (RosPublication::post(publication_, object, outbox_)) return ok();
  return fail(Code::unavailable, "topic " + topic_ + " of ROS 2 takes no more: the network is slower");
}

// --- In ---------------------------------------------------------------------------------------------------

RosIntake::RosIntake(Strand& strand, std::string user, std::string topic, const ros::Twin& twin,
                     RosFrames& frames)
    : strand_(strand), user_(std::move(user)), topic_(std::move(topic)), twin_(twin), frames_(frames) {}

Status RosIntake::open(RosParticipant& participant, const RosChannel& channel) {
  opened_ = strand_.executive().now();
  auto reader =
      participant.make_reader(channel, [this](std::span<const std::byte> payload) { hear(payload); });
  if (!reader) return reader.error();
  reader_ = std::move(reader).value();
  strand_.add_intake(*this);
  return ok();
}

void RosIntake::close() {
  if (reader_ == nullptr) return;
  reader_.reset();
  strand_.remove_intake(*this);
}

void RosIntake::hear(std::span<const std::byte> payload) {
  const TimePoint now = strand_.executive().now();
  const auto mount_of = [this](const std::string& frame) { return find_mount(frame); };
  is_mount_missing_ = false;
  Result<ObjectRef> object =
      contain_exhaustion([&]() -> Result<ObjectRef> { return twin_.from_ros(payload, mount_of, now); });
  if (!object) {
    if (!complained_.exchange(true))
      log::warning(user_, "a message of topic " + topic_ +
                              " is dropped, and others like it without a word: " + object.error().message);
    return;
  }
  if (is_mount_missing_ && now < opened_ + kPatience) return;  // /tf_static comes soon
  if (is_mount_missing_ && !std::exchange(warned_of_mount_, true))
    log::warning(user_, "nobody says on /tf_static where the frame '" + object->header().origin() +
                            "' of topic " + topic_ +
                            " is; it is taken to be in the middle of the robot, looking ahead");
  keep(ring_.take(*object), payload.size());
  strand_.wake();
}

std::optional<idl::Frame3D> RosIntake::find_mount(const std::string& frame) {
  if (frame.empty()) return std::nullopt;
  std::optional<idl::Frame3D> mount = frames_.mount_of(frame);
  is_mount_missing_ = !mount.has_value();
  return mount;
}

// The oldest are dropped, as from any queue of sensors.
void RosIntake::keep(ObjectRef object, std::size_t size) {
  const MutexLock lock(mutex_);
  waiting_.push_back({std::move(object), size});
  waiting_bytes_ += size;
  while (waiting_.size() > 1 && (waiting_.size() > kMostWaiting || waiting_bytes_ > kMostBytes)) {
    waiting_bytes_ -= waiting_.front().size;
    waiting_.pop_front();
    ++lost_;
  }
}

bool RosIntake::take_in() {
  if (!reading_.try_lock()) return false;
  const MutexLock reading(reading_, std::adopt_lock);
  std::deque<Waiting> taken;
  std::uint64_t lost = 0;
  {
    const MutexLock lock(mutex_);
    taken.swap(waiting_);
    waiting_bytes_ = 0;
    lost = std::exchange(lost_, 0);
  }
  if (lost > 0) pass_on_losses(lost);
  for (Waiting& waiting : taken) pass_on(std::move(waiting.object));
  return !taken.empty();
}

void RosToPush::attach(PushSink& sink, const UpdateRate& rate) {
  const MutexLock lock(mutex_);
  sink_ = &sink;
  rate_ = rate;
  sink.granted(grant_rate(rate, Duration{0}));
}

void RosToPush::detach() {
  const MutexLock lock(mutex_);
  sink_ = nullptr;
}

void RosToPush::change(const UpdateRate& rate) {
  const MutexLock lock(mutex_);
  rate_ = rate;
  if (sink_ != nullptr) sink_->granted(grant_rate(rate, Duration{0}));
}

void RosToPush::pass_on(ObjectRef object) {
  const MutexLock lock(mutex_);
  if (sink_ == nullptr || count_++ % rate_.multiple != 0) return;
  const TimePoint now = strand().executive().now();
  if (rate_.interval > Duration{0} && now < next_) return;
  next_ = now + rate_.interval;
  // A publisher of ROS waits for nobody.
  if (sink_->deliver(std::move(object)).has_value()) sink_->give_up(object);
}

void RosToPush::pass_on_losses(std::uint64_t objects) {
  const MutexLock lock(mutex_);
  if (sink_ != nullptr) sink_->lost(objects);
}

void RosToSend::pass_on(ObjectRef object) {
  if (std::optional<Status> answer = target_->offer(object, *this, next_++, false)) reply(next_, *answer);
}

void RosToSend::pass_on_losses(std::uint64_t objects) {
  log::warning(user(), std::to_string(objects) + " messages of topic " + topic() +
                           " came faster than they were handled, and are lost");
}

void RosToSend::reply(RequestId /*id*/, Status answer) {
  if (answer.ok()) {
    refused_ = false;
  } else if (!refused_.exchange(true)) {
    log::warning(user(), "refuses what comes on topic " + topic() + ": " + answer.error().message);
  }
}

}  // namespace orca::dds::of_ros
