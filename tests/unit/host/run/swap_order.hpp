// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "live_system.hpp"
#include "run/swap/swaps.hpp"

namespace orca::test {

/// A component that counts and one that it counts.
inline const std::string kPair = R"(<component name="teller" type="test.Teller"/>
  <component name="talker" type="test.Talker"/>
  <connect from="talker.out" to="teller.in" queue="100"/>
  <connect from="talker.poke" to="teller.poke" queue="100"/>
  <connect from="teller.out" to="talker.back" queue="100"/>)";

/// Returns the order to exchange component "teller" for a version of tests/unit/host/plugins/teller.hpp.
[[nodiscard]] inline host::SwapOrder next_teller(const std::string& version) {
  Result<plugin::PluginImage> image =
      plugin::PluginImage::copy(ORCA_BINARY_DIR "/tests/next_plugins/" + version + ".so");
  if (!image) throw std::runtime_error(image.error().text());
  return {"teller", std::move(image).value()};
}

/// Swaps in a system whose graph has become another one, and waits for the outcome.
inline Result<host::SwapReport> swap(LiveSystem& live, host::SwapOrder order, const graph::Graph& graph) {
  std::optional<Result<host::SwapReport>> outcome;
  host::Swaps swaps(graph, live.context(), live.catalogue(), live.system());
  swaps.begin(std::move(order), [&](const Result<host::SwapReport>& result) { outcome = result; });
  while (!outcome) {
    const TimePoint next = swaps.go_on();
    if (!outcome) live.changed().wait_until(next);
  }
  return *outcome;
}

/// Swaps, and waits for the outcome.
inline Result<host::SwapReport> swap(LiveSystem& live, host::SwapOrder order) {
  return swap(live, std::move(order), live.graph());
}

/// Returns what a refused or failed swap says.
[[nodiscard]] inline std::string refusal(LiveSystem& live, host::SwapOrder wanted) {
  const Result<host::SwapReport> outcome = swap(live, std::move(wanted));
  return outcome ? "it was taken" : outcome.error().text();
}

/// Returns the words that begin like this.
[[nodiscard]] inline std::vector<std::string> beginning(const std::vector<std::string>& all,
                                                        const std::string& begin) {
  std::vector<std::string> found;
  for (const std::string& word : all)
    if (word.starts_with(begin)) found.push_back(word);
  return found;
}

}  // namespace orca::test
