// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "guest_component.hpp"

#include <algorithm>
#include <exception>
#include <optional>
#include <stdexcept>
#include <utility>

#include "guest_objects.hpp"
#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::guest {
namespace {

class Proxy final : public PushProxyHandle {
 public:
  using PushProxyHandle::PushProxyHandle;

  // @param how  "latest", "update" or "wait".
  ObjectRef get(const std::string& how, std::optional<Duration> limit) {
    if (how == "latest") return latest_ref();
    if (how == "update") return get_update_ref();
    return get_update_wait_ref(limit ? deadline_in(*limit) : kForever);
  }
};

class Server final : public PushServerHandle {
 public:
  using PushServerHandle::push_loan;
  using PushServerHandle::PushServerHandle;
};

class Asker final : public QueryProxyHandle {
 public:
  using QueryProxyHandle::ask_loan;
  using QueryProxyHandle::QueryProxyHandle;
};

class Sender final : public SendProxyHandle {
 public:
  using SendProxyHandle::send_loan;
  using SendProxyHandle::SendProxyHandle;
};

std::string text_of(const ParamValue& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return std::to_string(*whole);
  if (const auto* real = std::get_if<double>(&value)) return xml::number_text(*real);
  return std::get<std::string>(value);
}

// Longer than any run [s].
constexpr double kLongest = 1e9;

std::optional<Duration> limit_of(const std::string& seconds) {
  if (seconds.empty()) return std::nullopt;
  return from_seconds(std::clamp(xml::parse_number(seconds).value(), 0.0, kLongest));
}

}  // namespace

struct GuestComponent::Ports {
  std::map<std::string, Proxy> proxies;
  std::map<std::string, Server> servers;
  std::map<std::string, Asker> askers;
  std::map<std::string, Sender> senders;
  std::map<std::string, SendServerHandle> takers;
  std::map<std::string, QueryServerHandle> repliers;
  std::map<std::string, const PortContract*> contracts;
};

GuestComponent::GuestComponent(ComponentHost& host, const GuestType& type, PacketLine& line)
    : Component(host), type_(type), line_(line), ports_(std::make_unique<Ports>()) {
  declare_ports();
  declare_params();
  if (type.trigger.kind == Trigger::Kind::period) lap_every(type.trigger.period);
  if (type.trigger.kind == Trigger::Kind::on_any) lap_on(type.trigger.ports.front());
}

GuestComponent::~GuestComponent() = default;

void GuestComponent::declare_ports() {
  for (const PortContract& port : type_.ports) {
    declare_port_of(port);
    ports_->contracts[port.name] = &port;
  }
}

void GuestComponent::declare_port_of(const PortContract& port) {
  const PortOptions options{.text = port.text, .optional = !port.required};
  const auto add = [&](auto& map, const auto&... more) {
    map.try_emplace(port.name, *this, port.name, port.type, more..., options);
  };
  const bool serves = port.role == Role::server;
  if (port.pattern == Pattern::push) return serves ? add(ports_->servers) : add(ports_->proxies);
  if (port.pattern == Pattern::send && !serves) return add(ports_->senders);
  if (port.pattern == Pattern::send)
    return add(ports_->takers,
               SendHandler([this, &port](const ObjectRef& object) { return take(port.name, object); }));
  if (!serves) return add(ports_->askers, *port.reply);
  add(ports_->repliers, *port.reply,
      QueryHandler([this, &port](const ObjectRef& question) { return reply(port, question); }));
}

Status GuestComponent::take(const std::string& port, const ObjectRef& object) {
  Packet words = packet_of(object);
  words.front() = port;
  const Packet last = call("handle", words);
  return last.front() == "failed" ? Status(fail(Code::failed_precondition, last.back())) : ok();
}

Result<ObjectLoan> GuestComponent::reply(const PortContract& port, const ObjectRef& question) {
  Packet words = packet_of(question);
  words.front() = port.name;
  const Packet last = call("handle", words);
  if (last.front() == "failed") return fail(Code::failed_precondition, last.back());
  return object_of(Packet(last.begin() + 1, last.end()), *port.reply);
}

void GuestComponent::declare_params() {
  for (const ParamContract& param : type_.params) {
    ParamValue& value = params_[param.name] = param.default_value;
    declare_param({param, [&value](const ParamValue& given) { value = given; }, &locked_});
  }
}

Packet GuestComponent::params() const {
  Packet all;
  for (const auto& [name, value] : params_) {
    all.push_back(name);
    all.push_back(text_of(value));
  }
  return all;
}

Status GuestComponent::start() {
  (void)call("start", params());
  return ok();
}

Outcome GuestComponent::work() {
  const Packet last = call("work");
  if (last.front() == "done") return done();
  if (last.front() == "failed") return failed(last.size() > 1 ? last[1] : "");
  return again();
}

void GuestComponent::stop() { (void)call("stop"); }

Status GuestComponent::params_changed() {
  (void)call("params", params());
  return ok();
}

Packet GuestComponent::call(const std::string& hook, const Packet& more) {
  Packet order{"call", name(), type_.type, hook};
  order.insert(order.end(), more.begin(), more.end());
  line_.send(order);
  Packet last = await_end();
  if (last.front() == "raised") {
    last.resize(3);
    log_error(last[2]);
    throw std::runtime_error(last[1]);
  }
  return last;
}

Packet GuestComponent::await_end() {
  std::exception_ptr interruption;
  for (;;) {
    const std::optional<Packet> said = line_.receive();
    if (!said) throw std::runtime_error("the program that has its code has ended");
    const std::string& word = said->front();
    if (word == "again" || word == "done" || word == "failed" || word == "reply" || word == "raised") {
      if (interruption) std::rethrow_exception(interruption);
      return *said;
    }
    try {
      if (interruption) std::rethrow_exception(interruption);  // whatever it asks for on its way out
      Packet reply = answer(*said);
      reply.insert(reply.begin() + 1, name());
      line_.send(reply);
    } catch (const Interrupted&) {
      interruption = std::current_exception();
      line_.send({"interrupted", name()});
    }
  }
}

Packet GuestComponent::answer(const Packet& wish) {
  const std::string& word = wish.front();
  const auto at = [&](std::size_t index) { return index < wish.size() ? wish[index] : std::string(); };
  const auto from = [&](std::size_t index) {
    return Packet(wish.begin() + static_cast<std::ptrdiff_t>(std::min(index, wish.size())), wish.end());
  };
  if (word == "get") return get(at(1), at(2), at(3));
  if (word == "push") return push(at(1), from(2));
  if (word == "send") return send(at(1), from(2));
  if (word == "query") return query(at(1), from(3), at(2));
  if (word == "log") return log(at(1), at(2));
  if (word == "now") return {"ok", std::to_string(now().time_since_epoch().count())};
  if (word == "random") return {"ok", std::to_string(random(at(1))())};
  if (word != "sleep") return {"error", "a component cannot be asked for " + in_quotes(word)};
  sleep(limit_of(at(1)).value_or(Duration{0}));
  return {"ok"};
}

Packet GuestComponent::get(const std::string& port, const std::string& how, const std::string& seconds) {
  const auto found = ports_->proxies.find(port);
  if (found == ports_->proxies.end()) return {"error", "no PushProxy " + in_quotes(port)};
  if (how == "connected") return {"ok", found->second.connected() ? "1" : ""};
  if (how == "new") return {"ok", found->second.connected() && found->second.new_data_arrived() ? "1" : ""};
  if (!found->second.connected()) {
    if (how == "latest") return {"ok"};
    return {"error", "the port " + in_quotes(port) + " is not connected"};
  }
  return packet_of(found->second.get(how, limit_of(seconds)));
}

Packet GuestComponent::push(const std::string& port, const Packet& object) {
  const auto found = ports_->servers.find(port);
  if (found == ports_->servers.end()) return {"error", "no PushServer " + in_quotes(port)};
  Result<ObjectLoan> loan = object_of(object, ports_->contracts.at(port)->type);
  if (!loan) return packet_of(loan.error());
  found->second.push_loan(std::move(loan).value());
  return {"ok"};
}

Packet GuestComponent::send(const std::string& port, const Packet& object) {
  const auto found = ports_->senders.find(port);
  if (found == ports_->senders.end()) return {"error", "no SendProxy " + in_quotes(port)};
  Result<ObjectLoan> loan = object_of(object, ports_->contracts.at(port)->type);
  if (!loan) return packet_of(loan.error());
  const Status sent = found->second.send_loan(std::move(loan).value());
  return sent.ok() ? Packet{"ok"} : packet_of(sent.error());
}

Packet GuestComponent::query(const std::string& port, const Packet& object, const std::string& seconds) {
  const auto found = ports_->askers.find(port);
  if (found == ports_->askers.end()) return {"error", "no QueryProxy " + in_quotes(port)};
  Result<ObjectLoan> loan = object_of(object, ports_->contracts.at(port)->type);
  if (!loan) return packet_of(loan.error());
  const Result<ObjectRef> reply =
      found->second.ask_loan(std::move(loan).value(), limit_of(seconds).value_or(1s));
  return reply ? packet_of(*reply) : packet_of(reply.error());
}

Packet GuestComponent::log(const std::string& level, const std::string& text) const {
  if (level == "error") log_error(text);
  if (level == "warning") log_warning(text);
  if (level == "info") log_info(text);
  return {"ok"};
}

}  // namespace orca::guest
