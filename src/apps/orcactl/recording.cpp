// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "recording.hpp"

#include <poll.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "asking.hpp"
#include "client.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/base/text.hpp"
#include "orca/idl/object.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"
#include "orca/recording/objects/carmen_writer.hpp"
#include "orca/recording/objects/object_writer.hpp"
#include "orca/recording/objects/ring_writer.hpp"
#include "orca/supervisor/control_socket.hpp"
#include "orca/xml/values.hpp"
#include "tapping/object_learning.hpp"
#include "tapping/tapping.hpp"

namespace orca::orcactl {
namespace {

using supervisor::Ask;
using supervisor::Channel;
using supervisor::Message;
using supervisor::Record;
using supervisor::Tapped;
using Clock = std::chrono::steady_clock;

constexpr std::size_t kDiskBound = std::size_t{64} << 20;  // [bytes] that wait for the disk
constexpr const char* kLineBound = "67108864";             // [bytes] that wait in each process for this one
constexpr std::chrono::milliseconds kFlush{200};  // with the time of a chunk, less than 0.25 s are lost
constexpr std::chrono::milliseconds kTurn{20};
constexpr std::chrono::milliseconds kSearch{25};       // between two attempts to reach ports
constexpr std::chrono::milliseconds kLateSearch{500};  // after kSearchTime: of processes that run on demand
constexpr std::chrono::seconds kSearchTime{20};
constexpr std::chrono::milliseconds kAlarmLook{100};
constexpr std::chrono::seconds kEndLimit{2};
constexpr int kMostAtOnce = 2000;  // objects of a line before another one has its turn

std::atomic<bool> g_is_to_end{false};

std::string cell(const Record& record, std::string_view name) {
  const auto found = std::ranges::find(record, name, &supervisor::Cell::name);
  return found == record.end() ? "" : found->value;
}

log::Level level_of(const std::string& name) { return log::parse_level(name).value_or(log::Level::info); }

// One line to a process.
struct Line {
  explicit Line(supervisor::LineAnswer answer)
      : channel(std::move(answer.line), Channel::kDefaultBound), ports(std::move(answer.ports)) {}
  Channel channel;
  std::vector<std::string> ports;
  bool is_asked_to_end = false;
};

// A recording of a system that runs.
class Recording {
 public:
  Recording(Descriptor control, recording::ObjectSink& writer, std::vector<std::string> ports)
      : control_(std::move(control)), writer_(writer), wanted_(std::move(ports)) {}

  // Returns when the system has ended, or when everything that had passed before the end is written.
  Status run(std::optional<Duration> whole) {
    record(whole);
    close_lines();
    return status_;
  }

  [[nodiscard]] const std::map<std::string, std::uint64_t>& lost() const { return lost_; }
  [[nodiscard]] std::size_t count_ports() const { return wanted_.size(); }
  // Returns whether a port was named that there is not.
  [[nodiscard]] bool is_refused() const { return is_refused_; }
  // Returns the ports of which nothing could be recorded, because their processes were not reached.
  [[nodiscard]] std::string unreached() const {
    std::string ports;
    for (const std::string& port : wanted_)
      if (!reached_.contains(port)) ports += (ports.empty() ? "" : " ") + port;
    return ports;
  }

 private:
  using Taker = std::function<void(supervisor::ControlAnswer&)>;

  void record(std::optional<Duration> whole) {
    ask("graph", {}, [this](supervisor::ControlAnswer& answer) { take_graph(answer); });
    for (const char* const what : {"graph", "ports"})
      ask(
          what, {}, [this, what](supervisor::ControlAnswer& answer) { take_json(what, answer); }, true);
    ask("sources", {}, [this](supervisor::ControlAnswer& answer) { take_source(answer); });
    ask("log", {"--follow", "--level", "debug"},
        [this](supervisor::ControlAnswer& answer) { take_log(answer); });
    const auto begin = Clock::now();
    for (;;) {
      const auto now = Clock::now();
      const bool is_over = whole && now - begin >= std::chrono::duration_cast<Clock::duration>(*whole);
      if (is_over || g_is_to_end) ask_for_end(now);
      if (is_done(now)) return;
      go_on(now);
      wait();
      take_control();
      for (auto line = lines_.begin(); line != lines_.end();)
        line = serve(*line) ? std::next(line) : lose(line);
      if (!status_.ok()) return;
    }
  }

  void ask(const std::string& command, std::vector<std::string> words, Taker taker, bool as_json = false) {
    const std::uint64_t request = ++last_request_;
    takers_[request] = std::move(taker);
    (void)control_.post(supervisor::encode(Ask{command, std::move(words), as_json}, request));
  }

  // ---- What the supervisor answers

  void take_control() {
    while (is_connected_) {
      Result<std::optional<Message>> message = control_.receive();
      if (!message) is_connected_ = false;
      if (!message || !*message) return;
      const std::uint64_t request = (*message)->request;
      Result<supervisor::ControlAnswer> answer = supervisor::decode_answer(std::move(**message));
      const auto taker = takers_.find(request);
      if (!answer || taker == takers_.end()) continue;
      taker->second(*answer);
      if (std::holds_alternative<supervisor::EndAnswer>(*answer)) takers_.erase(request);
    }
  }

  void take_graph(supervisor::ControlAnswer& answer) {
    if (const auto* const text = std::get_if<supervisor::TextAnswer>(&answer)) graph_ = text->text;
  }

  // For whoever shows the recording as the system was shown.
  void take_json(const std::string& what, supervisor::ControlAnswer& answer) {
    if (const auto* const text = std::get_if<supervisor::TextAnswer>(&answer))
      json_[what + ".json"] = text->text;
  }

  // With the last source everything is known with which a recording begins.
  void take_source(supervisor::ControlAnswer& answer) {
    if (const auto* const record = std::get_if<supervisor::RecordAnswer>(&answer)) {
      const std::string start = cell(record->record, "start");
      if (!start.empty()) start_ = TimePoint(Duration(std::atoll(start.c_str())));
      if (const std::string port = cell(record->record, "port"); !port.empty()) sources_.push_back(port);
    }
    if (!std::holds_alternative<supervisor::EndAnswer>(answer)) return;
    if (wanted_.empty()) wanted_ = sources_;
    const std::size_t at = graph_.find("name=\"");
    const std::string name =
        at == std::string::npos ? "" : graph_.substr(at + 6, graph_.find('"', at + 6) - at - 6);
    note(writer_.begin({name, false, wanted_, {}}));
    note(writer_.attach_graph(graph_));
    for (const auto& [what, text] : json_) note(writer_.attach_json(what, text));
    missing_.insert(wanted_.begin(), wanted_.end());
    has_begun_ = true;
  }

  void take_log(supervisor::ControlAnswer& answer) {
    const auto* const line = std::get_if<supervisor::RecordAnswer>(&answer);
    if (line == nullptr || !has_begun_) return;
    const TimePoint time = start_ + from_seconds(std::atof(cell(line->record, "time").c_str()));
    note(writer_.add(recording::kLogRow,
                     recording::log_record(level_of(cell(line->record, "level")), cell(line->record, "who"),
                                           cell(line->record, "text"), time),
                     time));
  }

  // An alarm that came, or came again, or is cleared.
  void take_alarm(supervisor::ControlAnswer& answer) {
    const auto* const row = std::get_if<supervisor::RecordAnswer>(&answer);
    if (row == nullptr) return;
    const std::string state = cell(row->record, "times") + cell(row->record, "active");
    if (std::exchange(alarms_[cell(row->record, "number")], state) == state) return;
    Loan<idl::Alarm> alarm = make_object<idl::Alarm>();
    const std::string severity = cell(row->record, "severity");
    alarm->severity(severity == "critical"  ? idl::ALARM_CRITICAL
                    : severity == "warning" ? idl::ALARM_WARNING
                                            : idl::ALARM_NOTICE);
    alarm->kind(idl::OWN_KIND);
    alarm->own_kind(cell(row->record, "kind"));
    alarm->source(cell(row->record, "source"));
    alarm->text(cell(row->record, "text"));
    alarm->active(cell(row->record, "active") == "true");
    const TimePoint time = start_ + from_seconds(std::atof(cell(row->record, "time").c_str()));
    alarm->stamp(to_time_value(time));
    alarm->creation_time(alarm->stamp());
    note(writer_.add(recording::kAlarmRow, std::move(alarm).seal().ref(), time));
  }

  void take_line(supervisor::ControlAnswer& answer) {
    if (auto* const line = std::get_if<supervisor::LineAnswer>(&answer)) {
      for (const std::string& port : line->ports) missing_.erase(port);
      reached_.insert(line->ports.begin(), line->ports.end());
      lines_.emplace_back(std::move(*line));
    }
    if (const auto* const record = std::get_if<supervisor::RecordAnswer>(&answer))
      note_absence(cell(record->record, "missing"));
    const auto* const end = std::get_if<supervisor::EndAnswer>(&answer);
    if (end == nullptr) return;
    const Code code = end->outcome.ok() ? Code::internal : end->outcome.error().code;
    if (code == Code::not_found || code == Code::failed_precondition)  // it runs on another machine
      note_absence(end->outcome.error().message);
    is_searching_ = false;
    has_searched_ = true;
  }

  // A port that there has never been is a mistake of whoever named it; one that has left the graph may come back.
  void note_absence(const std::string& reason) {
    if (has_searched_) return;
    is_refused_ = true;
    note(fail(Code::not_found, reason));
  }

  // ---- Turns

  void go_on(Clock::time_point now) {
    if (has_begun_ && now >= flushed_ + kFlush) {
      note(writer_.flush());
      flushed_ = now;
    }
    if (!is_connected_ || !has_begun_ || ending_since_) return;
    if (!missing_.empty() && !is_searching_ &&
        now >= searched_ + (now < begun_ + kSearchTime ? kSearch : kLateSearch)) {
      is_searching_ = true;
      searched_ = now;
      std::vector<std::string> words(missing_.begin(), missing_.end());
      words.insert(words.end(), {"--tap", "--objects", "--bound", kLineBound});
      ask("line", std::move(words), [this](supervisor::ControlAnswer& answer) { take_line(answer); });
    }
    if (now >= looked_ + kAlarmLook) {
      looked_ = now;
      ask("alarms", {}, [this](supervisor::ControlAnswer& answer) { take_alarm(answer); });
    }
  }

  void wait() {
    std::vector<pollfd> all;
    if (is_connected_) all.push_back({control_.descriptor(), POLLIN, 0});
    for (const Line& line : lines_) all.push_back({line.channel.descriptor(), POLLIN, 0});
    (void)poll(all.data(), all.size(), static_cast<int>(kTurn.count()));
    (void)control_.flush();
  }

  // Returns false if the line has ended.
  bool serve(Line& line) {
    for (int i = 0; i < kMostAtOnce; ++i) {
      Result<std::optional<Message>> message = line.channel.receive();
      if (!message) return false;
      if (!*message) return true;
      Result<supervisor::LineWord> word = supervisor::decode_line_word(std::move(**message));
      if (!word) return false;
      if (const auto* const passed = std::get_if<Tapped>(&*word)) take(line, *passed);
      if (const auto* const ended = std::get_if<supervisor::LineEnded>(&*word))
        return note_end(line, *ended), false;
    }
    return true;
  }

  void take(Line& line, const Tapped& passed) {
    if (passed.place >= line.ports.size()) return;
    const std::string& port = line.ports[passed.place];
    lost_by_line_[{&line, port}] = passed.lost;
    const Result<ObjectRef> object = object_of(passed);
    if (!object) return note(object.error());
    note(writer_.add(port, *object, TimePoint(Duration(static_cast<Duration::rep>(passed.passed)))));
  }

  void note_end(Line& line, const supervisor::LineEnded& ended) {
    for (std::size_t i = 0; i < ended.lost.size() && i < line.ports.size(); ++i)
      lost_by_line_[{&line, line.ports[i]}] = ended.lost[i];
  }

  std::list<Line>::iterator lose(std::list<Line>::iterator line) {
    for (const std::string& port : line->ports) {
      const auto count = lost_by_line_.extract({&*line, port});
      if (!count.empty()) lost_[port] += count.mapped();
      if (!ending_since_) missing_.insert(port);  // the process may be started again
    }
    return lines_.erase(line);
  }

  // What a line that is still open has not brought is missing, and nobody knows how much that is.
  void close_lines() {
    std::string ports;
    for (auto line = lines_.begin(); line != lines_.end(); line = lose(line))
      for (const std::string& port : line->ports) ports += (ports.empty() ? "" : ", ") + port;
    if (!ports.empty())
      note(fail(
          Code::deadline_exceeded,
          "the recording may lack the last objects of ports whose processes did not end their lines within " +
              std::to_string(kEndLimit.count()) + " s: " + ports));
  }

  void ask_for_end(Clock::time_point now) {
    if (!ending_since_) ending_since_ = now;
    for (Line& line : lines_)
      if (!std::exchange(line.is_asked_to_end, true))
        (void)line.channel.post(supervisor::encode(supervisor::LineWord(supervisor::EndLine{})));
  }

  [[nodiscard]] bool is_done(Clock::time_point now) const {
    if (lines_.empty() && (!is_connected_ || ending_since_)) return true;
    return ending_since_ && now >= *ending_since_ + kEndLimit;
  }

  void note(const Status& status) {
    if (!status.ok() && status_.ok()) status_ = status;
  }

  Channel control_;
  recording::ObjectSink& writer_;
  std::vector<std::string> wanted_;  // ports
  bool is_connected_ = true;
  bool has_begun_ = false;
  bool is_searching_ = false;
  bool has_searched_ = false;  // once at least
  bool is_refused_ = false;
  std::uint64_t last_request_ = 0;
  std::map<std::uint64_t, Taker> takers_;  // by request
  std::string graph_;
  std::map<std::string, std::string> json_;  // graph and ports, by the names of attachments
  std::vector<std::string> sources_;
  TimePoint start_{};              // of the run
  std::set<std::string> missing_;  // ports without a line
  std::set<std::string> reached_;  // ports that have had a line
  std::list<Line> lines_;
  std::map<std::pair<const Line*, std::string>, std::uint64_t> lost_by_line_;
  std::map<std::string, std::uint64_t> lost_;  // by port, on lines that have ended
  std::map<std::string, std::string> alarms_;  // by number: as they were last
  std::optional<Clock::time_point> ending_since_;
  const Clock::time_point begun_ = Clock::now();
  Clock::time_point flushed_ = begun_;
  Clock::time_point searched_{};
  Clock::time_point looked_ = begun_;
  Status status_ = ok();
};

// Connects to the system that a call names, and waits for it if the call says so.
std::variant<Descriptor, Failure> wait_for_system(const apps::Call& call) {
  const auto limit =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(call.duration("--wait").value_or(0s));
  for (;;) {
    std::variant<Descriptor, Failure> socket = connect_to(call);
    const auto* const failure = std::get_if<Failure>(&socket);
    if (failure == nullptr || failure->code != ExitCode::no_deployer || Clock::now() >= limit || g_is_to_end)
      return socket;
    std::this_thread::sleep_for(kTurn);
  }
}

ExitCode finish(const std::string& file, recording::ObjectSink& writer, const Recording& recording,
                const Status& done) {
  std::string lost;
  for (const auto& [port, count] : recording.lost())
    if (count > 0) lost += (lost.empty() ? ", objects LOST: " : ", ") + port + " " + std::to_string(count);
  const std::string unreached = recording.unreached();
  const Status closed =
      writer.close(recording.lost(),
                   unreached.empty() ? recording::Values{} : recording::Values{{"unreached", unreached}});
  std::fprintf(stderr, "orcactl: %s: %llu messages of %zu ports, %.1f MB%s\n", file.c_str(),
               static_cast<unsigned long long>(writer.messages()), recording.count_ports(),
               static_cast<double>(writer.size()) / 1e6, lost.c_str());
  if (!unreached.empty())
    std::fprintf(stderr, "orcactl: never reached, so nothing of them is recorded: %s\n", unreached.c_str());
  if (!done.ok()) return report({done.error()});
  return closed.ok() ? ExitCode::done : report({closed.error()});
}

using Sink = std::unique_ptr<recording::ObjectSink>;

// Opens what a call names: a new file, or a folder with a ring of files.
std::variant<Sink, Failure> open_sink(const apps::Call& call) {
  const auto refuse = [](const std::string& why) {
    return Failure{fail(Code::invalid_argument, why), ExitCode::usage};
  };
  const std::string& name = call.words.front();
  const bool names_log = name.ends_with(".carmen");
  const bool names_file = names_log || name.ends_with(".mcap");
  const std::optional<std::string> room = call.text("--ring");
  if (!room && !names_file)
    return refuse("name a file that ends in .mcap or .carmen, not " + in_quotes(name));
  if (room && names_file)
    return refuse("--ring keeps several files; name a folder for them, not " + in_quotes(name));
  if (!room) {
    auto output = recording::open_file_in_background(name, kDiskBound);
    if (!output) return Failure{output.error()};
    if (names_log) return Sink(std::make_unique<recording::CarmenWriter>(*std::move(output)));
    return Sink(std::make_unique<recording::ObjectWriter>(*std::move(output)));
  }
  constexpr xml::ValueRule kRoom{
      .form = xml::ValueRule::Form::number, .unit = "B", .min = recording::RingWriter::kLeast, .max = 1e15};
  xml::ValueFault fault;
  const std::optional<double> bytes = xml::read_number(*room, kRoom, fault);
  if (!bytes) return refuse("--ring: " + fault.message);
  return Sink(std::make_unique<recording::RingWriter>(name, static_cast<std::uint64_t>(*bytes)));
}

// Takes the file away of a recording that has not come about, so that the next attempt may have its name.
void discard(const apps::Call& call, recording::ObjectSink& writer) {
  (void)writer.close({}, {});
  if (!call.text("--ring")) (void)std::remove(call.words.front().c_str());
}

}  // namespace

ExitCode record(const apps::Call& call) {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) std::signal(number, [](int) { g_is_to_end = true; });
  std::signal(SIGXFSZ, SIG_IGN);  // a limit of the file's size is like a full disk
  const std::string& file = call.words.front();
  std::variant<Sink, Failure> opened = open_sink(call);
  if (const auto* const failure = std::get_if<Failure>(&opened)) return report(*failure);
  const Sink& writer = std::get<Sink>(opened);
  std::variant<Descriptor, Failure> socket = wait_for_system(call);
  if (const auto* const failure = std::get_if<Failure>(&socket)) {
    discard(call, *writer);
    return report(*failure);
  }
  learn_objects(call);
  Recording recording(std::get<Descriptor>(std::move(socket)), *writer,
                      {call.words.begin() + 1, call.words.end()});
  const Status done = recording.run(call.duration("--for"));
  if (recording.is_refused()) {
    discard(call, *writer);
    return report({done.error()});
  }
  return finish(file, *writer, recording, done);
}

}  // namespace orca::orcactl
