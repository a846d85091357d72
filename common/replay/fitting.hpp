/// @file Whether a record can take its part in a run.
#pragma once

#include <string>

#include "grainstep/wire.pb.h"
#include "replay/recording.hpp"

namespace grainstep::replay {

/// InputError where what was recorded is of another symmetry, depth, dimension or half than what `setup` asks for.
void require_fits(const wire::Setup& setup, const record::About& about, const std::string& key);

/// The Ready of the side that is played, as it was recorded, so that both sides agree on the same steps; but for what a
/// player has not: its time, memory, and the books of what is inside.
[[nodiscard]] wire::Ready ready_of(const wire::Ready& recorded, const wire::Setup& setup, const Recording& recording);

/// Whether the run's windows are those of the record, to the last bit.
[[nodiscard]] inline bool same_windows(const wire::Start& start, const record::About& about) {
  return start.window() == about.window();
}

}  // namespace grainstep::replay
