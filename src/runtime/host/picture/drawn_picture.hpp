// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/output_file.hpp"
#include "orca/base/result.hpp"
#include "orca/host/picture.hpp"

namespace orca::host {

/// The function of liborca_picture.so.
/// @param drawn  set to the result; see write_picture().
extern "C" void orca_draw_picture(const Scene& scene, const PictureOptions& options, OutputFile& file,
                                  Status& drawn);

}  // namespace orca::host
