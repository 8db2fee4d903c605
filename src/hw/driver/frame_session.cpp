// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/frame_session.hpp"

namespace orca::hw {

Status FrameSession::begin(TimePoint now) {
  frames_ = LineFrames(protocol_);
  begun_ = now;
  return ok();
}

Result<bool> FrameSession::advance(TimePoint now) {
  if (Status read_well = read(now); !read_well.ok()) return read_well.error();
  if (counts().frames > 0) return true;
  if (now < next()) return false;
  return fail(Code::not_found, "nothing that makes sense comes over " + link_.name() +
                                   "; is the device switched on, is this its line, and is the rate right?");
}

}  // namespace orca::hw
