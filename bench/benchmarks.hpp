// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace orca::bench {

void register_hand_over();
void register_push();
void register_fan_out();
void register_isolation();
void register_query();
void register_shm();
void register_dds();
void register_start();
void register_throughput();
void register_graph();
void register_sim_cast();
void register_sim_world();
void register_sim_scaling();
void register_stalling_device();
void register_planner();
void register_collision();

}  // namespace orca::bench
