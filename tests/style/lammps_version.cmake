# cmake -DFOUND=VERSION -P: what configuring says to that version of LAMMPS.
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/../../cmake/GrainstepLammps.cmake)
grainstep_check_lammps("${FOUND}" OFF)
