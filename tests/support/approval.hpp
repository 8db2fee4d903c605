// SPDX-License-Identifier: GPL-3.0-or-later
// Approval tests: texts that people have read and approved. The output of Orca must equal them, byte for
// byte.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace orca::test {

/// Compares `found` with the approved text in `expected`. With ORCA_APPROVE=1 in the environment it becomes
/// the approved text, to be reviewed in git's difference.
void check_approved(const std::filesystem::path& expected, const std::string& found);

/// Returns the files of a folder with this ending, sorted, without those of its subfolders.
[[nodiscard]] std::vector<std::filesystem::path> files_in(const std::filesystem::path& folder,
                                                          std::string_view ending);

/// Returns `path` with ".expected" in place of its ending.
[[nodiscard]] std::filesystem::path approved_text_of(std::filesystem::path path);

/// Returns the bytes of a file; fails the test if it cannot be read.
[[nodiscard]] std::string bytes_of(const std::filesystem::path& path);

}  // namespace orca::test
