# grainstep-dem derives from LAMMPS's own C++ classes (dem-service/lammps/adapter.hpp). They are no stable interface: with
# another version what compiles may still read another layout. So only versions that passed our tests are taken.
set(GRAINSTEP_LAMMPS_KNOWN 20210929)  # as liblammps.pc says it; Debian 12

# grainstep_check_lammps(found any): `found` is a version or empty; `any` lets an unknown one pass with a warning.
function(grainstep_check_lammps found any)
  if(found IN_LIST GRAINSTEP_LAMMPS_KNOWN)
    return()
  endif()
  if(NOT found)
    set(found "none that pkg-config knows (liblammps.pc)")
  endif()
  set(text "LAMMPS: found ${found}, expected ${GRAINSTEP_LAMMPS_KNOWN} (liblammps-dev of Debian 12). Grainstep builds on \
LAMMPS's inner classes, which change between versions. Install that version; or, to try yours, configure with \
-DGRAINSTEP_ANY_LAMMPS=ON, run the tests (ctest -R 'dem|Dem|Engine'), and add it to GRAINSTEP_LAMMPS_KNOWN in \
cmake/GrainstepLammps.cmake.")
  if(any)
    message(WARNING "${text}")
  else()
    message(FATAL_ERROR "${text}")
  endif()
endfunction()
