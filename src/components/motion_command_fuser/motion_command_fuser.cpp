// SPDX-License-Identifier: LGPL-3.0-or-later
#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "decide.hpp"
#include "ear.hpp"
#include "orca/component.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/system.hpp"
#include "orca/idl/time.hpp"

namespace {

using orca::ObjectPtr;
using orca::Status;
using orca::fuse::Decision;
using orca::fuse::Listened;
using orca::fuse::MotionPort;
using orca::fuse::Verdict;
using orca::fuse::Voice;
using orca::fuse::Wish;
using Source = MotionPort::Source;
using Names = orca::Param<std::vector<std::string>>;

constexpr double kNever = std::numeric_limits<double>::infinity();

// The period in which the fuser looks for behaviours that have fallen silent.
constexpr orca::Duration kWatchPeriod = std::chrono::milliseconds(20);
// [s] A shorter silence is no sign of a fault on a machine without real-time scheduling.
constexpr double kShortestSilence = 0.1;
constexpr double kSilentPeriods = 3.0;

bool listens_to(const std::vector<Listened>& listened, const Source& source) {
  return std::ranges::find(listened, source, &Listened::source) != listened.end();
}

// A behaviour that was disconnected and is connected again still has the subscription that it had. Its wishes, which nobody takes, would make lap
// follow lap.
void silence_others(const MotionPort& motion, const std::vector<Listened>& listened) {
  for (const Source& source : motion.sources())
    if (source.new_data_arrived() && !listens_to(listened, source)) source.unsubscribe();
}

/// The component that fuses the wishes of the behaviours in a client's list into one crisp command (thesis
/// 11.1). A list may name the behaviours that the graph connects to `motion`. README.md explains the modes.
class MotionCommandFuser final : public orca::Component {
 public:
  explicit MotionCommandFuser(orca::ComponentHost& host) : Component(host) { behaviours_.add(motion_); }

 private:
  Status configure() override {
    if (Status sound = params_changed(); !sound.ok()) return sound;
    if (const Status chosen = choose(*first_clients_); !chosen.ok())
      return first_clients_.refuse(chosen.error());
    return orca::ok();
  }

  Status params_changed() override {
    orca::fuse::Rules rules = this->rules();
    if (rules.mode == orca::fuse::Mode::priority && rules.order.empty())
      return mode_.refuse("mode priority needs the parameter order: the behaviours, highest first");
    if (Status read = read_nodes(suppress_, rules.wiring.suppress); !read.ok()) return read;
    if (Status read = read_nodes(inhibit_, rules.wiring.inhibit); !read.ok()) return read;
    // A required behaviour that is absent would keep the robot standing for good, and a misspelt name in the order
    // would silently change who goes first.
    for (const Names* names : {&required_, &optional_, &order_})
      for (const std::string& name : **names)
        if (!source_of(name)) return names->refuse(not_connected(name).error());
    rules_ = std::move(rules);
    return orca::ok();
  }

  Status start() override {
    for (Listened& behaviour : listened_) {
      behaviour.source.subscribe();
      behaviour.since = now();
    }
    return orca::ok();
  }

  void stop() override {
    for (Listened& behaviour : listened_) behaviour = {behaviour.source, behaviour.name};
    decision_ = {};
    voices_.clear();
    refused_ = true;  // at the very end the base takes nothing any more
    explain(send());  // nobody is listened to any more: the robot must not go on with the last command
  }

  // Whoever sent the list does not send it again.
  void save_state(orca::StateWriter& state) const override {
    std::vector<std::string> names;
    for (const Listened& behaviour : listened_) names.push_back(behaviour.name);
    state.write(names);
  }
  Status load_state(orca::StateReader& state) override {
    std::vector<std::string> names;
    if (Status read = state.read(names); !read.ok()) return read;
    const auto gone = std::ranges::find_if(names, [this](const auto& name) { return !source_of(name); });
    if (gone == names.end()) return listen_to(names);
    log_warning(not_connected(*gone).error().text() + "; the robot stands until a client list comes");
    return listen_to({});
  }

  Status on_client_list(const ObjectPtr<orca::idl::ClientList>& list) { return listen_to(list->clients()); }

  Status listen_to(const std::vector<std::string>& names) {
    if (Status chosen = choose(names); !chosen.ok()) return chosen;
    for (const Source& source : motion_.sources())
      listens_to(listened_, source) ? source.subscribe() : source.unsubscribe();
    return orca::ok();
  }

  orca::Result<orca::Loan<orca::idl::ClientList>> on_check(const ObjectPtr<orca::idl::ClientList>& list) {
    for (const std::string& name : list->clients())
      if (!source_of(name)) return not_connected(name).error();
    return orca::make_object<orca::idl::ClientList>(*list);
  }

  // Forgets the messages of the behaviours that it listened to before.
  Status choose(const std::vector<std::string>& names) {
    lost_.remember(listened_);
    std::vector<Listened> chosen;
    for (const std::string& name : names) {
      const std::optional<Source> source = source_of(name);
      if (!source) return not_connected(name);
      const auto same = [&](const Listened& behaviour) { return behaviour.source == *source; };
      if (std::none_of(chosen.begin(), chosen.end(), same)) chosen.push_back(anew(*source, name));
    }
    listened_ = std::move(chosen);
    stay_active(!listened_.empty());
    return orca::ok();
  }

  // Returns a behaviour of which nothing has been heard yet. One that had fallen silent is reported as silent at once.
  [[nodiscard]] Listened anew(const Source& source, const std::string& name) const {
    const orca::fuse::Reliance reliance = lost_.reliance_of(source);
    const orca::TimePoint since = reliance.is_lost() ? orca::TimePoint{} : now();
    return {.source = source, .name = name, .since = since, .reliance = reliance};
  }

  orca::Outcome work() override {
    const bool heard = await_wishes();
    if (heard) silence_others(motion_, listened_);
    if (listened_.empty()) return orca::again();
    voices_.clear();
    for (Listened& behaviour : listened_) voices_.push_back(hear(behaviour));
    const double last_rate = decision_.command.kind == Wish::Kind::turn_rate ? decision_.command.value : 0.0;
    Decision decision = decide(voices_, rules_, last_rate);
    tell_change(decision);
    if (!heard && decision.verdict == decision_.verdict) return orca::again();  // it only looked for silence
    decision_ = std::move(decision);
    name_cause();
    explain(send());
    return orca::again();
  }

  // The command answers the message that decided, and belongs to the mission of the client list. Without a
  // list, or with one that belongs to no mission, it belongs to the mission of that message.
  void name_cause() {
    for (const Listened& behaviour : listened_)
      if (behaviour.name == decision_.decided_by && behaviour.last) note_cause(*behaviour.last);
  }

  // Waits by one of the three policies of thesis 7.4, for the behaviours that it is subscribed to now. With
  // policy all there are two exceptions: a full stop is not delayed, and a silent behaviour does not delay the
  // others for ever.
  // @return false if nothing has come: it is time to look for silence.
  bool await_wishes() {
    if (*sync_ == "period") {
      behaviours_.wait_to_fuse(orca::Fusing::clock, orca::from_seconds(*period_));
      return true;
    }
    const orca::TimePoint asked = now();
    const bool heard = behaviours_.wait(kWatchPeriod) != nullptr;
    ear_.note_wait(now() - asked);
    if (!heard) return false;
    if (*sync_ == "all")
      behaviours_.wait_all(orca::from_seconds(*all_wait_), [this] { return stop_is_waiting(); });
    return true;
  }

  [[nodiscard]] bool stop_is_waiting() const {
    return std::any_of(listened_.begin(), listened_.end(), [](const Listened& behaviour) {
      const auto newest = behaviour.source.latest();
      return newest && behaviour.source.new_data_arrived() && newest->kind() == orca::idl::FULLSTOP;
    });
  }

  Voice hear(Listened& behaviour) {
    const double limit = silence_limit(behaviour);
    const auto newest = behaviour.source.take_latest();
    if (newest && newest != behaviour.last) ear_.take(behaviour, newest, limit);
    Voice voice;
    voice.name = behaviour.name;
    voice.silence_limit = limit;
    if (!behaviour.last) return voice;
    voice.said = orca::fuse::said(*behaviour.last);
    voice.age = age_of(*behaviour.last);
    behaviour.reliance.look(voice.age, limit);
    voice.lost = behaviour.reliance.is_lost();
    if (!behaviour.last_wish) return voice;
    voice.wish = orca::fuse::wish_of(behaviour.last_wish);
    voice.wish_age = age_of(*behaviour.last_wish);
    return voice;
  }

  // Returns how long the behaviour may be silent [s].
  [[nodiscard]] double silence_limit(const Listened& behaviour) const {
    if (std::find(optional_->begin(), optional_->end(), behaviour.name) != optional_->end()) return kNever;
    if (*silence_limit_ > 0.0) return *silence_limit_;
    const double announced = orca::to_seconds(behaviour.source.base_period());
    return announced > 0.0 ? std::clamp(kSilentPeriods * announced, kShortestSilence, *max_age_) : *max_age_;
  }

  [[nodiscard]] double age_of(const orca::idl::MotionCommand& command) const {
    return orca::to_seconds(now() - orca::to_time_point(command.creation_time()));
  }

  // Sends the command and returns it as it was sent.
  orca::idl::MotionCommand send() {
    orca::Loan<orca::idl::MotionCommand> loan = orca::fuse::command_of(decision_, rules_.ballot.steer_gain);
    const orca::idl::MotionCommand sent = *loan;
    const Status taken = base_.send(std::move(loan));
    if (!taken.ok() && !refused_) log_warning("the base refuses commands: " + taken.error().text());
    refused_ = !taken.ok();
    return sent;
  }

  void explain(const orca::idl::MotionCommand& sent) {
    if (reason_.subscriber_count() == 0) return;
    auto reason = reason_.loan();
    reason->mode() = *mode_;
    reason->verdict(static_cast<orca::idl::FusionVerdict>(decision_.verdict));
    reason->decided_by() = decision_.decided_by;
    reason->command(sent);
    reason->voices().resize(voices_.size());
    for (std::size_t i = 0; i < voices_.size(); ++i)
      orca::fuse::describe(voices_[i], listened_[i], decision_.shares[i], reason->voices()[i]);
    reason_.push(std::move(reason));
  }

  // Reports silence and its end, but not the moment before all have spoken for the first time.
  void tell_change(const Decision& decision) {
    if (decision.verdict == Verdict::told_to_stop) return;  // which says nothing about the other behaviours
    const bool is_silent = decision.verdict == Verdict::required_silent;
    if (is_silent && !has_had_time(decision.decided_by)) return;
    if (is_silent && !told_silence_) log_warning("stops the robot: " + why_silent(decision.decided_by));
    if (told_silence_ && !is_silent) log_info("all behaviours are heard again");
    told_silence_ = is_silent;
  }

  [[nodiscard]] std::string why_silent(const std::string& name) const {
    const auto behaviour = std::ranges::find(listened_, name, &Listened::name);
    if (behaviour == listened_.end())
      return "the client list leaves out the behaviour \"" + name + "\", which is required";
    return (behaviour->talks_nonsense ? "nothing valid is heard of the behaviour \""
                                      : "nothing is heard of the behaviour \"") +
           name + "\"";
  }

  [[nodiscard]] bool has_had_time(const std::string& name) const {
    for (const Listened& behaviour : listened_)
      if (behaviour.name == name)
        return now() - behaviour.since > orca::from_seconds(silence_limit(behaviour));
    return true;
  }

  Status read_nodes(const Names& texts, std::vector<orca::fuse::Node>& nodes) const {
    for (const std::string& text : *texts) {
      const auto node = orca::fuse::parse_node(text);
      if (!node)
        return texts.refuse("cannot read \"" + text + "\"; expected \"higher > lower\", as \"avoid > goto\"");
      for (const std::string& name : {node->higher, node->lower})
        if (!source_of(name)) return texts.refuse(not_connected(name).error());
      nodes.push_back(*node);
    }
    return orca::ok();
  }

  [[nodiscard]] orca::fuse::Rules rules() const {
    return {.mode = orca::fuse::mode_of(*mode_),
            .max_age = *max_age_,
            .ballot = {*steer_gain_, *max_turn_rate_, *rate_spread_, *speed_spread_, *inertia_},
            .order = *order_,
            .wiring = {{}, {}, *max_age_, *hold_},
            .required = *required_};
  }

  // Returns whether the source is the behaviour or port `name`, seen from the fuser's own context or from the
  // top: a Command beside it in a sub-graph "left" says "goto" for "left/goto".
  [[nodiscard]] bool is_called(const Source& source, const std::string& name) const {
    const std::string path = source.path();
    const std::string behaviour = path.substr(0, path.rfind('.'));
    const std::string here = this->name().substr(0, this->name().rfind('/') + 1) + name;
    return path == here || behaviour == here || path == name || behaviour == name;
  }

  [[nodiscard]] std::optional<Source> source_of(const std::string& name) const {
    for (const Source& source : motion_.sources())
      if (is_called(source, name)) return source;
    return std::nullopt;
  }

  [[nodiscard]] Status not_connected(const std::string& name) const {
    return orca::fail(orca::Code::not_found, "no behaviour \"" + name + "\" is connected to " +
                                                 motion_.path() + "; connected are: " + connected_names());
  }

  [[nodiscard]] std::string connected_names() const {
    std::string names;
    for (const Source& source : motion_.sources()) names += (names.empty() ? "" : ", ") + source.path();
    return names.empty() ? "none" : names;
  }

  MotionPort motion_{
      *this,
      "motion",
      {.text = "Commands of the behaviours; a client list chooses among them.", .optional = true}};
  orca::SendServer<orca::idl::ClientList> clients_{
      *this,
      "ClientListSend",
      &MotionCommandFuser::on_client_list,
      {.text = "List of the behaviours to listen to from now on."}};
  orca::QueryServer<orca::idl::ClientList, orca::idl::ClientList> check_{
      *this,
      "ClientListQuery",
      &MotionCommandFuser::on_check,
      {.text = "Whether a list of behaviours is right: the list itself, or the error that it would give."}};
  orca::SendProxy<orca::idl::MotionCommand> base_{
      *this, "base", {.text = "Receiver of the fused command: a robot base."}};
  orca::PushServer<orca::idl::FusionReason> reason_{
      *this,
      "FusionReasonPush",
      {.text = "Reason of each command: the mode and what each behaviour contributed."}};

  orca::Param<std::string> mode_{
      *this,
      "mode",
      "weighted",
      {.choices = orca::fuse::kModes, .text = "Rule by which the wishes become one command."}};
  orca::Param<std::string> sync_{
      *this,
      "sync",
      "any",
      {.choices = {"any", "all", "period"},
       .fixed = true,
       .text = "Time to fuse: when any behaviour has sent a command, when all have, or once a period."}};
  orca::Param<double> period_{
      *this,
      "period",
      0.05,
      {.unit = "s", .min = 0.001, .fixed = true, .text = "Time between two commands, with sync period."}};
  orca::Param<double> all_wait_{
      *this,
      "all_wait",
      0.2,
      {.unit = "s", .min = 0.001, .text = "Longest wait for silent behaviours, with sync all."}};
  Names first_clients_{
      *this, "clients", {}, {.fixed = true, .text = "Behaviours to listen to until a client list comes."}};
  Names required_{
      *this,
      "required",
      {},
      {.text = "Behaviours without which the robot does not move, even if a client list leaves them out."}};
  Names optional_{
      *this,
      "optional",
      {},
      {.text =
           "Behaviours that may fall silent; the silence of any other in the client list stops the robot."}};
  orca::Param<double> silence_limit_{*this,
                                     "silence_limit",
                                     0.0,
                                     {.unit = "s",
                                      .min = 0.0,
                                      .text = "Time without a command of a behaviour after which the robot "
                                              "stops; 0: three of the behaviour's periods, within 0.1 s and "
                                              "max_age."}};
  orca::Param<double> max_age_{
      *this, "max_age", 0.3, {.unit = "s", .min = 0.1, .text = "Age beyond which a command is disregarded."}};
  orca::Param<double> steer_gain_{
      *this,
      "steer_gain",
      1.0,
      {.unit = "1/s",
       .min = 0.01,
       .text = "Turn rate per radian of direction, where one is converted into the other."}};
  orca::Param<double> max_turn_rate_{
      *this,
      "max_turn_rate",
      1.0,
      {.unit = "rad/s",
       .min = 0.01,
       .text = "Mode vote: largest turn rate among the candidates, to either side."}};
  orca::Param<double> rate_spread_{
      *this,
      "rate_spread",
      0.15,
      {.unit = "rad/s",
       .min = 0.01,
       .text = "Mode vote: standard deviation of a wish's votes over the turn rates."}};
  orca::Param<double> speed_spread_{
      *this,
      "speed_spread",
      0.1,
      {.unit = "m/s",
       .min = 0.01,
       .text = "Mode vote: standard deviation of a wish's votes over the speeds."}};
  orca::Param<double> inertia_{
      *this,
      "inertia",
      0.2,
      {.min = 0.0,
       .max = 1.0,
       .text = "Mode vote: votes for its last choice; 0: none, 1: as many as all wishes have together."}};
  Names order_{
      *this, "order", {}, {.text = "Mode priority: behaviours in order of priority, highest first."}};
  Names suppress_{
      *this,
      "suppress",
      {},
      {.text = "Mode subsumption: with \"avoid > goto\" a wish of avoid replaces the wish of goto."}};
  Names inhibit_{
      *this, "inhibit", {}, {.text = "Mode subsumption: with \"arm > goto\" a wish of arm silences goto."}};
  orca::Param<double> hold_{
      *this,
      "hold",
      0.5,
      {.unit = "s",
       .min = 0.0,
       .text = "Mode subsumption: time for which a node still acts after the last wish."}};
  orca::Synchronizer behaviours_;
  orca::fuse::Ear ear_{host()};
  orca::fuse::Rules rules_;
  std::vector<Listened> listened_;
  orca::fuse::Lost lost_;
  std::vector<Voice> voices_;
  Decision decision_;  // the last one
  bool told_silence_ = false;
  bool refused_ = false;
};

}  // namespace

ORCA_COMPONENT(MotionCommandFuser, "orca.MotionCommandFuser")
