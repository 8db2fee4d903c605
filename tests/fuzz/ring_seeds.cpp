// SPDX-License-Identifier: GPL-3.0-or-later
// Writes seeds for ring_fuzz into a folder: for each pattern and side, what an honest peer writes into the segment.
#include <fstream>
#include <iostream>
#include <string>

#include "all_ports.hpp"
#include "bulk_pools.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/patterns/shm/shm_edges.hpp"
#include "shm/bulk_loans.hpp"

namespace {

using namespace orca;
using test::AllPorts;
using test::port;

struct Camera : test::Peer {
  explicit Camera(Executive& executive) : Peer(executive, "server") {}
  PushServer<idl::Image> out{*this, "out"};
};
struct Viewer : test::Peer {
  explicit Viewer(Executive& executive) : Peer(executive, "client") {}
  PushProxy<idl::Image> in{*this, "in"};
};

// One edge, with both ends here.
struct Edge {
  explicit Edge(Executive& executive)
      : client(executive, "peer"), server(executive, "peer"), camera(executive), viewer(executive) {
    camera.strand().set_doorbell(bells[1]);
    viewer.strand().set_doorbell(bells[0]);
    client.strand().set_doorbell(bells[0]);
    server.strand().set_doorbell(bells[1]);
    server.open();
  }
  RingSegment map() const { return RingSegment::map(file.descriptor()).value(); }
  ShmPeer to_client() { return {"client.port", &bells[0]}; }
  ShmPeer to_server() { return {"server.port", &bells[1]}; }

  void push() {
    make_shm_end(port<PushServerEndpoint>(server, "out"), map(), to_client(), {});
    make_shm_end(port<PushClientEndpoint>(client, "in"), map(), to_server(), {}, Duration{0});
    client.in.subscribe();
    server.strand().take_in();
    server.out.push(full_stop());
  }
  void send() {
    make_shm_end(port<SendServerEndpoint>(server, "taker"), map(), to_client(), {});
    make_shm_end(port<SendClientEndpoint>(client, "sender"), map(), to_server(), {});
    (void)client.sender.send_request(full_stop());
    server.strand().take_in();
  }
  // Pushes an image whose bytes are lent.
  void show() {
    test::provide_to_itself();
    make_shm_end(port<PushServerEndpoint>(camera, "out"), map(), to_client(), {});
    make_shm_end(port<PushClientEndpoint>(viewer, "in"), map(), to_server(), {}, Duration{0});
    viewer.in.subscribe();
    camera.strand().take_in();
    shm::loans_in(map().memory().bytes(), 1).readable = BulkPool::own().identity();
    auto image = camera.out.loan();
    image->data().resize(20'000);
    camera.out.push(std::move(image));
  }
  void ask() {
    make_shm_end(port<QueryServerEndpoint>(server, "answerer"), map(), to_client());
    make_shm_end(port<QueryClientEndpoint>(client, "question"), map(), to_server());
    (void)client.question.query_request(client.question.loan());
    server.strand().take_in();
    (void)server.handle_one();
  }

  MemoryFile file = RingSegment::create("seed", 4096).value();
  DoorbellWord bells[2] = {};
  AllPorts client;
  AllPorts server;
  Camera camera;
  Viewer viewer;
};

void write_piece(std::ofstream& out, std::span<const std::byte> segment, std::size_t at, std::size_t count) {
  out.put(static_cast<char>(at % 256)).put(static_cast<char>(at / 256)).put(static_cast<char>(count));
  out.write(reinterpret_cast<const char*>(segment.data() + at), static_cast<std::streamsize>(count));
}

// Writes what the peer of one side has written: its records, then its line of the control block.
void write_seed(const std::string& path, const Edge& edge, std::size_t choice, std::size_t ring) {
  std::ofstream out(path, std::ios::binary);
  const RingSegment segment = edge.map();
  const auto bytes = segment.memory().bytes();
  out.put(static_cast<char>(choice));
  write_piece(out, bytes, 4096 + ring * 4096, 248);
  write_piece(out, bytes, ring * 128, 32);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: ring_seeds FOLDER\n";
    return 2;
  }
  const auto executive = make_executive({}).value();
  executive->run([&] {
    void (Edge::*const actions[])() = {&Edge::push, &Edge::send, &Edge::ask};
    for (std::size_t pattern = 0; pattern < 3; ++pattern) {
      Edge edge(*executive);
      (edge.*actions[pattern])();
      for (std::size_t side = 0; side < 2;
           ++side)  // the server first, to which the client writes the first ring
        write_seed(std::string(argv[1]) + "/" + std::to_string(2 * pattern + side), edge, 2 * pattern + side,
                   side);
    }
    Edge edge(*executive);
    edge.show();
    write_seed(std::string(argv[1]) + "/6", edge, 6, 1);
  });
  return 0;
}
