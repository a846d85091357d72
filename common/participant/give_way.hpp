/// @file Which thread waits when there are fewer cores than threads: the one that computes.
#pragma once

namespace grainstep::participant {

/// Lowers the priority of the calling thread against the threads that move its messages, and those of the other
/// programs of the run. Messages need a few microseconds every step, and whoever computes on the core that they need
/// would have the other side wait for its time slice (docs/decisions/0008-cost-of-coupling.md). No effect where the
/// system does not allow it, and none where cores are free.
void give_way_to_messages();

/// The same for a thread that others seldom wait for, such as one that writes files: it also gives way to whoever
/// computes, and takes what cores they leave while they wait for each other.
void give_way_to_all();

}  // namespace grainstep::participant
