// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

/// A graph that is too large, too deep or too odd to be kept as a file. `order` is one line:
/// "nested N" elements in each other; "components N"; "bytes N", a comment filled up to that size;
/// "elements N".
[[nodiscard]] std::string made_graph(const std::string& order);
