// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/supervisor/vocabulary.hpp"

#include "channel/transfer.hpp"

namespace orca::supervisor {
// The fields of each order and each report.

void fields(auto& archive, StateKept& m) { transfer(archive, m); }
void fields(auto& archive, Setup& m) {
  transfer_all(archive, m.process, m.graph, m.options, m.run_page, m.edges, m.doorbells, m.states,
               m.processes);
  transfer_optional(archive, m.pool);
}
void fields(auto& /*archive*/, Build& /*m*/) {}
void fields(auto& /*archive*/, OpenHardware& /*m*/) {}
void fields(auto& archive, Configure& m) { transfer(archive, m.component); }
void fields(auto& /*archive*/, OpenGates& /*m*/) {}
void fields(auto& archive, TakeDown& m) { transfer(archive, m.keeps_states); }
void fields(auto& archive, StopMotors& m) { transfer_all(archive, m.reason, m.only_devices); }
void fields(auto& archive, Suspend& m) { transfer(archive, m.component); }
void fields(auto& archive, Resume& m) { transfer(archive, m.component); }
void fields(auto& archive, SetParams& m) { transfer_all(archive, m.component, m.values); }
void fields(auto& archive, RenewEdge& m) { transfer(archive, m.edge); }
void fields(auto& archive, CutEdge& m) { transfer_all(archive, m.edge, m.reason); }
void fields(auto& /*archive*/, ReleaseMotors& /*m*/) {}
void fields(auto& /*archive*/, Count& /*m*/) {}
void fields(auto& archive, OpenLine& m) {
  transfer_all(archive, m.ports, m.taps, m.objects, m.bound, m.line);
}
void fields(auto& archive, TellAlarm& m) { transfer_all(archive, m.process, m.object); }
void fields(auto& archive, ForgetAlarm& m) { transfer_all(archive, m.kind, m.source, m.process); }
void fields(auto& archive, Meet& m) {
  transfer_all(archive, m.name, m.type, m.topic, m.address, m.interface, m.others, m.domain, m.keys);
}
void fields(auto& archive, Say& m) { transfer(archive, m.state); }
void fields(auto& archive, NoteGraph& m) { transfer(archive, m.graph); }
void fields(auto& archive, MoveEdge& m) { transfer(archive, m.edge); }
void fields(auto& archive, Rewire& m) { transfer(archive, m.changes); }
void fields(auto& archive, AddComponent& m) { transfer_all(archive, m.node, m.values, m.doorbell); }
void fields(auto& archive, RemoveComponent& m) { transfer(archive, m.component); }
void fields(auto& archive, NoteProcess& m) { transfer_all(archive, m.process, m.place, m.is_of_fibers); }
void fields(auto& archive, OpenGate& m) { transfer(archive, m.component); }
void fields(auto& archive, ConcludeCall& m) {
  transfer_all(archive, m.component, m.number, m.outcome, m.before);
}

void fields(auto& archive, Outlive& m) { transfer_all(archive, m.output, m.wait); }
void fields(auto& /*archive*/, Adopt& /*m*/) {}
void fields(auto& /*archive*/, AskUse& /*m*/) {}
void fields(auto& archive, TellLines& m) { transfer(archive, m.lines); }
void fields(auto& archive, SwapCode& m) {
  transfer_all(archive, m.component, m.type, m.values, m.probation, m.origin, m.plugin, m.tried, m.fresh);
}

void fields(auto& archive, Answer& m) { transfer_all(archive, m.outcome, m.records); }
void fields(auto& archive, Built& m) { transfer_all(archive, m.robots, m.builds); }
void fields(auto& archive, StateChange& m) {
  transfer_all(archive, m.component, m.state, m.failure, m.has_worked, m.has_failed, m.ended_badly);
}
void fields(auto& archive, RestChange& m) { transfer(archive, m.at_rest); }
template <Kind kind>
void fields(auto& archive, ObjectReport<kind>& m) {
  transfer(archive, m.object);
}
void fields(auto& archive, Logged& m) { transfer_all(archive, m.level, m.who, m.text); }
void fields(auto& archive, LastWordsReport& m) { transfer(archive, m.text); }
void fields(auto& archive, Tally& m) { transfer_all(archive, m.edges, m.clients, m.servers, m.ways); }
void fields(auto& archive, OutputFailed& m) { transfer(archive, m.outcome); }
void fields(auto& archive, Glance& m) { transfer_all(archive, m.unwell, m.goals); }
void fields(auto& archive, Prompting& m) { transfer(archive, m.begins); }

void fields(auto& archive, MissionStep& m) {
  transfer_all(archive, m.mission, m.time, m.port, m.type, m.seq, m.cause_origin, m.cause_port, m.cause_seq);
}

void fields(auto& archive, Orphaned& m) {
  transfer_all(archive, m.process, m.graph, m.options, m.run_page, m.output, m.doorbells, m.processes);
}
void fields(auto& archive, ExchangedCode& m) {
  transfer_all(archive, m.component, m.type, m.file, m.build_id, m.swaps, m.params, m.values);
}
void fields(auto& archive, Standing& m) { transfer_all(archive, m.alarms, m.motors_held, m.params); }
void fields(auto& /*archive*/, Leaving& /*m*/) {}
void fields(auto& archive, EdgeDamaged& m) { transfer(archive, m.edge); }
void fields(auto& archive, LogWished& m) { transfer(archive, m.is_wanted); }
void fields(auto& archive, PeerCalled& m) {
  transfer_up_to(archive, m.act, PeerCalled::Act::resume);
  transfer_all(archive, m.by, m.number, m.component, m.param, m.value);
}

Message encode(Order order, std::uint64_t request) { return encode_any(order, request); }
Message encode(Report report, std::uint64_t request) { return encode_any(report, request); }

Result<Order> decode_order(Message message) { return decode_any(message, Order{}); }
Result<Report> decode_report(Message message) { return decode_any(message, Report{}); }

}  // namespace orca::supervisor
