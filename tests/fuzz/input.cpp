/// What libFuzzer calls, and the driver that takes its place (driver.cpp): bytes to scripts, scripts to other scripts.
#include "input.hpp"

#include <google/protobuf/stubs/logging.h>

#include "mutate.hpp"
#include "target.hpp"

namespace grainstep::fuzz {
namespace {

bool parse(Script& script, const std::uint8_t* data, std::size_t size) {
  return script.ParseFromArray(data, static_cast<int>(size));
}

/// The script's bytes in place of `data`; what does not fit leaves it as it is.
std::size_t store(const Script& script, std::uint8_t* data, std::size_t size, std::size_t most) {
  const std::size_t needed = script.ByteSizeLong();
  if (needed > most) return size;
  script.SerializeToArray(data, static_cast<int>(needed));
  return needed;
}

}  // namespace
}  // namespace grainstep::fuzz

using grainstep::fuzz::Script;

extern "C" int LLVMFuzzerInitialize(int* /*argc*/, char*** /*argv*/) {
  google::protobuf::SetLogHandler(nullptr);  // it complains of every text that is no UTF-8
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Script script;
  if (!grainstep::fuzz::parse(script, data, size)) return 0;
  ++grainstep::fuzz::statistics().inputs;
  grainstep::fuzz::try_script(script);
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  Script script;
  if (!grainstep::fuzz::parse(script, data, size)) script.Clear();
  grainstep::fuzz::Random random(seed);
  grainstep::fuzz::mutate(script, random);
  return grainstep::fuzz::store(script, data, size, most);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* one, std::size_t one_size,
                                                 const std::uint8_t* other, std::size_t other_size, std::uint8_t* out,
                                                 std::size_t most, unsigned seed) {
  Script script;
  Script source;
  if (!grainstep::fuzz::parse(script, one, one_size) || !grainstep::fuzz::parse(source, other, other_size)) return 0;
  grainstep::fuzz::Random random(seed);
  grainstep::fuzz::cross(script, source, random);
  return grainstep::fuzz::store(script, out, 0, most);
}
