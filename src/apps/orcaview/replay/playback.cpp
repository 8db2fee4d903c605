// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "replay/playback.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

#include "orca/base/exhaustion.hpp"
#include "orca/base/text.hpp"
#include "orca/supervisor/channel.hpp"

namespace orca::view {
namespace {

using supervisor::Ask;
using supervisor::ControlAnswer;
using supervisor::Record;
using supervisor::Tapped;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kTurn{20};
constexpr std::chrono::milliseconds kLongestTurn{100};  // of which the time goes on at most
constexpr std::chrono::milliseconds kMostWork{40};      // then the pages are served

double seconds(recording::Stamp time) { return static_cast<double>(time) * 1e-9; }

Result<double> number(const std::vector<std::string>& words, double min, double max) {
  char* rest = nullptr;
  const double value = words.size() == 2 ? std::strtod(words[1].c_str(), &rest) : NAN;
  if (rest != nullptr && *rest == '\0' && value >= min && value <= max) return value;
  return fail(Code::invalid_argument, "replay " + words[0] + " expects a number from " + std::to_string(min) +
                                          " to " + std::to_string(max));
}

// Returns what is no option among the words of `log`.
std::set<std::string> names_in(const std::vector<std::string>& words) {
  std::set<std::string> names;
  for (const std::string& word : words)
    if (!word.starts_with("--")) names.insert(word);
  return names;
}

}  // namespace

Playback::Playback(const boost::asio::any_io_executor& loop, RecordedSystem system,
                   std::function<void()> jumped)
    : loop_(loop),
      system_(std::move(system)),
      jumped_(std::move(jumped)),
      timer_(loop),
      now_(system_.begin()) {
  turned_ = Clock::now();
  wait();
}

Playback::~Playback() {
  for (const Client& client : clients_) client.wire->close();
  for (const Line& line : lines_) line.wire->close();
}

Result<Descriptor> Playback::connect() {
  Result<supervisor::SocketPair> pair =
      contain_exhaustion([]() -> Result<supervisor::SocketPair> { return supervisor::make_socket_pair(); });
  if (!pair) return pair.error();
  const std::shared_ptr<Wire> wire = Wire::make(loop_, std::move(pair->supervisor));
  if (!wire) return fail(Code::unavailable, "there are no descriptors left");
  const auto client = clients_.insert(clients_.end(), Client{wire});
  wire->start([this, client](supervisor::Message message) { take(*client, std::move(message)); },
              [this, client](const Error&) { clients_.erase(client); });
  return std::move(pair->host);
}

void Playback::take(Client& client, supervisor::Message message) {
  const std::uint64_t request = message.request;
  const Result<Ask> ask = supervisor::decode_ask(std::move(message));
  if (ask) answer(client, *ask, request);
}

// Answers a command that shows something. Returns false if it is none.
bool Playback::show(const Ask& ask, const std::function<void(ControlAnswer)>& say) const {
  const auto rows = [&](std::vector<Record> all) {
    for (Record& row : all) say(supervisor::RecordAnswer{std::move(row)});
    return true;
  };
  static const std::set<std::string_view> empty{"counters", "missions", "names"};
  if (ask.command == "graph") return say(supervisor::TextAnswer{system_.graph()}), true;
  if (ask.command == "ports") return say(supervisor::TextAnswer{system_.ports()}), true;
  if (ask.command == "ps") return rows(system_.components());
  if (ask.command == "alarms" && ask.words.empty()) return rows(system_.alarms(now_));
  if (ask.command == "log") return rows(system_.newest_log(now_, names_in(ask.words)));
  return empty.contains(ask.command);
}

void Playback::answer(Client& client, const Ask& ask, std::uint64_t request) {
  const auto say = [&](ControlAnswer answer) {
    (void)client.wire->post(supervisor::encode(std::move(answer), request));
  };
  Status outcome = ok();
  if (show(ask, say)) {
    if (std::ranges::find(ask.words, "--follow") != ask.words.end()) {
      client.log = request;
      client.who = names_in(ask.words);
      return;
    }
  } else if (ask.command == "line" && !ask.words.empty() && ask.words.back() == "--objects") {
    outcome = open_line(client, ask.words.front(), request);
  } else if (ask.command == "replay") {
    outcome = steer(ask.words);
    if (outcome.ok()) say(supervisor::RecordAnswer{state()});
  } else {
    outcome = fail(Code::failed_precondition, "this is a recording: nothing of it can be changed");
  }
  say(supervisor::EndAnswer{outcome});
}

Record Playback::state() const {
  return {{"begin", seconds(system_.begin()), 6},
          {"end", seconds(system_.end()), 6},
          {"now", seconds(now_), 6},
          {"speed", speed_, 3},
          {"plays", plays_}};
}

Status Playback::steer(const std::vector<std::string>& words) {
  if (words.empty()) return ok();
  const std::string& order = words.front();
  if (order == "play" || order == "pause") {
    if (order == "play" && now_ >= system_.end()) jump(system_.begin());
    plays_ = order == "play";
    turned_ = Clock::now();
    return ok();
  }
  if (order == "speed") {
    const Result<double> speed = number(words, kSlowest, kFastest);
    return speed ? (speed_ = *speed, ok()) : Status(speed.error());
  }
  if (order != "seek") return fail(Code::invalid_argument, "replay expects play, pause, speed or seek");
  const Result<double> time = number(words, 0.0, 1e10);
  if (!time) return time.error();
  jump(std::clamp(static_cast<Stamp>(std::llround(*time * 1e9)), system_.begin(), system_.end()));
  return ok();
}

// A port at which nothing was recorded is looked at in vain.
Status Playback::open_line(Client& client, const std::string& port, std::uint64_t request) {
  const std::string row = system_.row_of(port);
  if (row.empty()) return fail(Code::not_found, "nothing of " + in_quotes(port) + " is in the recording");
  Result<supervisor::SocketPair> pair =
      contain_exhaustion([]() -> Result<supervisor::SocketPair> { return supervisor::make_socket_pair(); });
  if (!pair) return pair.error();
  const std::shared_ptr<Wire> wire = Wire::make(loop_, std::move(pair->host));
  if (!wire) return fail(Code::unavailable, "there are no descriptors left");
  const auto line = lines_.insert(lines_.end(), Line{row, wire});
  wire->start([](const supervisor::Message&) {}, [this, line](const Error&) { lines_.erase(line); });
  supervisor::LineAnswer answer{std::move(pair->supervisor), system_.type_of(row), "", {port}};
  Status sent = client.wire->post(supervisor::encode(ControlAnswer(std::move(answer)), request));
  if (std::optional<Tapped> last = system_.last(row, now_); last && sent.ok())
    sent = wire->post(supervisor::encode(supervisor::LineWord(*std::move(last))));
  return sent;
}

// Whoever looks begins anew, and gets what had passed last by then.
void Playback::jump(Stamp time) {
  now_ = time;
  turned_ = Clock::now();
  for (const Line& line : std::exchange(lines_, {})) line.wire->close();
  jumped_();
}

void Playback::wait() {
  timer_.expires_after(kTurn);
  timer_.async_wait([this](const boost::system::error_code& error) {
    if (error) return;
    turn();
    wait();
  });
}

void Playback::turn() {
  const Clock::time_point now = Clock::now();
  const std::chrono::nanoseconds passed = std::min<std::chrono::nanoseconds>(now - turned_, kLongestTurn);
  turned_ = now;
  if (!plays_) return;
  const auto step = static_cast<Stamp>(static_cast<double>(passed.count()) * speed_);
  const Stamp until = std::min(now_ + step, system_.end());
  pass_on(now_ + 1, until);
  if (now_ >= system_.end()) plays_ = false;
}

// Passes on what has passed meanwhile. What takes too long is gone on with at the next turn, so it plays more slowly.
void Playback::pass_on(Stamp from, Stamp to) {
  const Clock::time_point limit = Clock::now() + kMostWork;
  std::set<std::string> rows;
  for (const Line& line : lines_) rows.insert(line.row);
  Stamp reached = to;
  Stamp last = from;  // Those of one instant, of which there are many in virtual time, pass together.
  const Status read = system_.pass(rows, from, to, [&](const std::string& row, const Tapped& passed) {
    if (static_cast<Stamp>(passed.passed) != last && Clock::now() >= limit) {
      reached = last;
      return false;
    }
    last = static_cast<Stamp>(passed.passed);
    for (const Line& line : lines_)
      if (line.row == row) (void)line.wire->post(supervisor::encode(supervisor::LineWord(passed)));
    return true;
  });
  now_ = read.ok() ? std::max(now_, reached) : to;  // a damaged chunk is passed over
  for (Client& client : clients_)
    if (client.log)
      for (Record& line : system_.log(from, now_, client.who))
        (void)client.wire->post(
            supervisor::encode(ControlAnswer(supervisor::RecordAnswer{std::move(line)}), *client.log));
}

}  // namespace orca::view
