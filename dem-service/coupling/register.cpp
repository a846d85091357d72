/// @file The one function of libgrainstep_lammps.so, which examples/lammps/grainstep_lammps.py calls in an unmodified
/// LAMMPS: from then on the script may use `fix grainstep/coupling` and `pair_style grainstep/hooke`.
#include "dem-service/coupling/coupling_fix.hpp"
#include "dem-service/lammps/pair_style.hpp"

extern "C" [[gnu::visibility("default")]] void grainstep_register(void* lammps) {
  auto& instance = *static_cast<grainstep::dem::lammps::Instance*>(lammps);
  grainstep::dem::lammps::register_fix<grainstep::dem::CouplingFix>(instance);
  grainstep::dem::PairStyle::register_style(instance);
}
