// SPDX-License-Identifier: GPL-3.0-or-later
#include "bare_iceoryx.hpp"

#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <iceoryx_posh/internal/roudi/roudi.hpp>
#include <iceoryx_posh/popo/untyped_publisher.hpp>
#include <iceoryx_posh/popo/untyped_subscriber.hpp>
#include <iceoryx_posh/popo/wait_set.hpp>
#include <iceoryx_posh/roudi/iceoryx_roudi_components.hpp>
#include <iceoryx_posh/runtime/posh_runtime.hpp>

namespace orca::bench {
namespace {

constexpr std::uint32_t kPieces = 16;
const iox::capro::ServiceDescription kThere{"orca", "bench", "there"};
const iox::capro::ServiceDescription kBack{"orca", "bench", "back"};

[[noreturn]] void serve(std::size_t size) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  iox::mepoo::MePooConfig pools;
  pools.addMemPool({static_cast<std::uint32_t>(size), kPieces});
  iox::RouDiConfig_t config;
  const auto group = iox::posix::PosixGroup::getGroupOfCurrentProcess().getName();
  config.m_sharedMemorySegments.push_back({group, group, pools});
  iox::roudi::IceOryxRouDiComponents components(config);
  iox::roudi::RouDi daemon(components.rouDiMemoryManager, components.portManager,
                           {iox::roudi::MonitoringMode::OFF, false});
  for (;;) pause();
}

}  // namespace

struct BareIceoryxPair::Ends {
  explicit Ends(bool is_child) : out(is_child ? kBack : kThere), in(is_child ? kThere : kBack) {
    (void)news.attachState(in, iox::popo::SubscriberState::HAS_DATA);
  }
  void put(std::size_t size) {
    out.loan(static_cast<std::uint32_t>(size)).and_then([this](void* piece) { out.publish(piece); });
  }
  void take() {
    for (bool taken = false; !taken;) {
      (void)news.wait();
      in.take().and_then([&](const void* piece) {
        in.release(piece);
        taken = true;
      });
    }
  }
  [[noreturn]] void echo(std::size_t size) {
    for (;;) {
      take();
      put(size);
    }
  }

  iox::popo::UntypedPublisher out;
  iox::popo::UntypedSubscriber in;
  iox::popo::WaitSet<> news;
};

BareIceoryxPair::BareIceoryxPair(std::size_t size) : size_(size) {
  daemon_ = fork();
  if (daemon_ == 0) serve(size_);
  child_ = fork();
  if (child_ == 0) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    iox::runtime::PoshRuntime::initRuntime("orca-bench-echo");
    Ends(true).echo(size_);
  }
  static const bool once = [] {
    iox::runtime::PoshRuntime::initRuntime("orca-bench");
    return true;
  }();
  (void)once;
  ends_ = std::make_unique<Ends>(false);
  while (!ends_->out.hasSubscribers() || ends_->in.getSubscriptionState() != iox::SubscribeState::SUBSCRIBED)
    usleep(1000);
}

BareIceoryxPair::~BareIceoryxPair() {
  ends_.reset();
  for (const pid_t process : {child_, daemon_}) {
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
  }
}

Nanoseconds BareIceoryxPair::time(int round_trips) {
  return time_per_operation(2 * round_trips, [&] {
    for (int i = 0; i < round_trips; ++i) {
      ends_->put(size_);
      ends_->take();
    }
  });
}

}  // namespace orca::bench
