/// @file Tests that run once for each path of data.
#pragma once

#include <gtest/gtest.h>

#include <ostream>
#include <string>

#include "orchestrator/session/session.hpp"

namespace grainstep::orchestrator {

inline std::string name_of_path(const ::testing::TestParamInfo<Path>& path) { return text_of(path.param); }
inline void PrintTo(Path path, std::ostream* out) { *out << text_of(path); }

}  // namespace grainstep::orchestrator
