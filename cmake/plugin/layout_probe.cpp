// SPDX-License-Identifier: LGPL-3.0-or-later
// Everything that a plugin can compile in, so that its layout is in this file's debug information, from which
// list_layouts.py makes the table that plugins and loader compare. A class template needs a line here. What only libraries of object
// types compile in is here, too.
#include "orca/component.hpp"
#include "orca/hardware.hpp"
#include "orca/hw/server.hpp"
#include "orca/idl/geometry.hpp"
#include "orca/idl/make_object_type.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/pool.hpp"

namespace {

using orca::idl::MotionCommand;

}  // namespace

template class orca::Travelling<orca::idl::Point>;
template class orca::ObjectPtr<MotionCommand>;
template class orca::Loan<MotionCommand>;
template class orca::PushServer<MotionCommand>;
template class orca::PushProxy<MotionCommand>;
template class orca::PushSourceOf<MotionCommand>;
template class orca::PushProxyArray<MotionCommand>;
template class orca::QueryProxy<MotionCommand, MotionCommand>;
template class orca::QueryServer<MotionCommand, MotionCommand>;
template class orca::SendProxy<MotionCommand>;
template class orca::SendServer<MotionCommand>;
template class orca::Param<bool>;
template class orca::Param<std::int64_t>;
template class orca::Param<double>;
template class orca::Param<std::string>;
template class orca::Param<std::vector<std::string>>;
template class orca::Result<orca::ObjectRef>;
template class orca::hw::SensorHW<MotionCommand>;
template class orca::hw::ActuatorHW<MotionCommand>;
