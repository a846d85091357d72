# How every library, program and test of the project is declared: one function each, warnings as errors, C++20.

option(GRAINSTEP_WERROR "Warnings are errors" ON)
option(GRAINSTEP_SANITIZE "Address and undefined-behaviour sanitizers" OFF)

add_library(grainstep_options INTERFACE)
target_compile_features(grainstep_options INTERFACE cxx_std_20)
target_compile_options(grainstep_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Woverloaded-virtual -Wduplicated-cond -Wlogical-op
  # GCC 12 takes strings that are moved or joined for null pointers and overruns, at -O1 and where they come from a
  # precompiled header (GCC bug 105651 and others like it): these three warnings are for the code of a step.
  $<$<NOT:$<BOOL:$<TARGET_PROPERTY:GRAINSTEP_COLD>>>:-Wnull-dereference>
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:$<TARGET_PROPERTY:GRAINSTEP_COLD>>>:-Wno-array-bounds>
  $<$<AND:$<CXX_COMPILER_ID:GNU>,$<BOOL:$<TARGET_PROPERTY:GRAINSTEP_COLD>>>:-Wno-stringop-overflow>
  # GCC 12 sees overlapping copies in `"text" + std::string` where there are none (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${GRAINSTEP_WERROR}>:-Werror>
  $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>  # ccache sees through precompiled headers only with it
  # Bits must not depend on which operations a compiler fuses where.
  -ffp-contract=off)
if(GRAINSTEP_SANITIZE)
  target_compile_options(grainstep_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(grainstep_options INTERFACE -fsanitize=address,undefined)
endif()
# The programs of tests/fuzz with libFuzzer, and all that they link with its coverage and these sanitizers: clang only.
option(GRAINSTEP_FUZZ "Fuzz targets with libFuzzer (clang)" OFF)
if(GRAINSTEP_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "GRAINSTEP_FUZZ needs clang, found ${CMAKE_CXX_COMPILER_ID}: configure with `cmake --preset fuzz`")
  endif()
  # A number that does not fit the integer it becomes is looked for, too: clang leaves it out of `undefined`.
  set(GRAINSTEP_FUZZ_SANITIZERS address,undefined,float-cast-overflow)
  target_compile_options(grainstep_options INTERFACE -fsanitize=fuzzer-no-link,${GRAINSTEP_FUZZ_SANITIZERS}
    -fno-omit-frame-pointer -fno-sanitize-recover=all -Wno-unknown-warning-option)
  target_link_options(grainstep_options INTERFACE -fsanitize=${GRAINSTEP_FUZZ_SANITIZERS})
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O3 -g1")  # line numbers for perf and backtraces; values want the debug preset

# Most of a build is reading the headers of Protobuf and GoogleTest again and again: they are compiled once, for
# each kind of target. What a file includes stays what it needs: it must compile with this OFF as well.
option(GRAINSTEP_PCH "Precompiled headers" ON)
set(GRAINSTEP_PCH_hot <grainstep/wire.pb.h> <filesystem> <string> <vector>)
# JSON's would cost every file a second: its literals ask for the whole parser, which is instantiated wherever it is seen.
set(GRAINSTEP_PCH_cold ${GRAINSTEP_PCH_hot})
set(GRAINSTEP_PCH_test ${GRAINSTEP_PCH_hot} <gtest/gtest.h> <gmock/gmock.h>)

# grainstep_precompile(target kind): `kind` as above; of one kind all compile with the same options.
function(grainstep_precompile target kind)
  if(NOT GRAINSTEP_PCH)
    return()
  endif()
  set(pch grainstep_pch_${kind})
  if(NOT TARGET ${pch})
    file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/pch/${kind}.cpp CONTENT "// Precompiled headers want a source.\n")
    add_library(${pch} OBJECT ${PROJECT_BINARY_DIR}/pch/${kind}.cpp)
    target_link_libraries(${pch} PRIVATE grainstep_options grainstep::proto)
    target_compile_features(${pch} PUBLIC cxx_std_20)
    if(NOT kind STREQUAL test)
      grainstep_position_independent(${pch})
    endif()
    if(kind STREQUAL cold)
      grainstep_compile_cold(${pch})
    elseif(kind STREQUAL test)
      target_link_libraries(${pch} PRIVATE GTest::gtest GTest::gmock)
    endif()
    # Not through ccache: where it has to preprocess, GCC takes the old precompiled header for the new one's text, and
    # ccache the old one for the new.
    set_target_properties(${pch} PROPERTIES CXX_COMPILER_LAUNCHER "")
    target_precompile_headers(${pch} PRIVATE ${GRAINSTEP_PCH_${kind}})
  endif()
  target_precompile_headers(${target} REUSE_FROM ${pch})
endfunction()

# Libraries may end up in shared ones. What they export is nobody's to replace, so nothing is lost by it.
function(grainstep_position_independent target)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
endfunction()

# Code that runs once a run, not once a step, is worth no minutes of an optimiser.
function(grainstep_compile_cold target)
  set_target_properties(${target} PROPERTIES GRAINSTEP_COLD ON)
  target_compile_options(${target} PRIVATE $<$<CONFIG:RelWithDebInfo>:-O1>)
endfunction()

# grainstep_library(name [COLD] [MESSAGES] SOURCES ... DEPENDS ... PRIVATE_DEPENDS ...): folder = library = namespace.
# Headers are included as "folder/file.hpp". MESSAGES: it works with those of proto/. COLD: nothing of it runs in a step.
function(grainstep_library name)
  # Headers are named from the root; those of common and of the tests from there.
  set(from ${PROJECT_SOURCE_DIR})
  foreach(folder common tests)
    set(inside ${PROJECT_SOURCE_DIR}/${folder})
    cmake_path(IS_PREFIX inside ${CMAKE_CURRENT_SOURCE_DIR} is_inside)
    if(is_inside)
      set(from ${inside})
    endif()
  endforeach()
  cmake_parse_arguments(arg "COLD;MESSAGES" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  if(arg_SOURCES)
    add_library(grainstep_${name} STATIC ${arg_SOURCES})
    target_include_directories(grainstep_${name} PUBLIC ${from})
    target_link_libraries(grainstep_${name} PUBLIC ${arg_DEPENDS} PRIVATE grainstep_options ${arg_PRIVATE_DEPENDS})
    target_compile_features(grainstep_${name} PUBLIC cxx_std_20)
    grainstep_position_independent(grainstep_${name})
    if(arg_COLD)
      grainstep_compile_cold(grainstep_${name})
    endif()
    if(arg_MESSAGES AND arg_COLD)
      grainstep_precompile(grainstep_${name} cold)
    elseif(arg_MESSAGES)
      grainstep_precompile(grainstep_${name} hot)
    endif()
  else()
    add_library(grainstep_${name} INTERFACE)
    target_include_directories(grainstep_${name} INTERFACE ${from})
    target_link_libraries(grainstep_${name} INTERFACE ${arg_DEPENDS})
    target_compile_features(grainstep_${name} INTERFACE cxx_std_20)
  endif()
  add_library(grainstep::${name} ALIAS grainstep_${name})
endfunction()

# grainstep_instruction_sets(OUT): the copies that a kernel's source is compiled into; which of them runs is decided at run
# time. On x86-64 its levels, on every other machine one copy for whatever the compiler targets.
function(grainstep_instruction_sets out)
  if(GRAINSTEP_FUZZ)  # one is enough to try, and takes a sanitizer's compiler long enough
    set(${out} generic PARENT_SCOPE)
  elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|amd64)$")
    set(${out} x86_64 x86_64_v3 x86_64_v4 PARENT_SCOPE)
  else()
    set(${out} generic PARENT_SCOPE)
  endif()
endfunction()

# grainstep_compile_for(target isa): options of one of these copies.
function(grainstep_compile_for target isa)
  grainstep_position_independent(${target})
  if(isa STREQUAL "generic")
    return()
  endif()
  string(REPLACE "x86_64" "x86-64" march ${isa})
  string(REPLACE "_" "-" march ${march})
  target_compile_options(${target} PRIVATE -march=${march})
  if(isa STREQUAL "x86_64_v4")
    target_compile_options(${target} PRIVATE -mprefer-vector-width=512)
  endif()
endfunction()

# grainstep_program(name SOURCES ... DEPENDS ...): main only wires.
function(grainstep_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE grainstep_options ${arg_DEPENDS})
  grainstep_compile_cold(${name})
endfunction()

# What a test bears on a loaded machine, s; the number stands in the header. A test may have several such waits, and
# CTest ends it only after that: its limit is for tests that hang, not for machines that are busy.
file(STRINGS ${PROJECT_SOURCE_DIR}/tests/support/patience.hpp GRAINSTEP_PATIENCE REGEX "seconds patience{")
string(REGEX REPLACE ".*{([0-9]+)}.*" "\\1" GRAINSTEP_PATIENCE "${GRAINSTEP_PATIENCE}")
math(EXPR GRAINSTEP_TEST_TIMEOUT "4 * ${GRAINSTEP_PATIENCE}")
math(EXPR GRAINSTEP_LONG_TIMEOUT "12 * ${GRAINSTEP_PATIENCE}")  # of tests that compute for minutes
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS tests/support/patience.hpp)

# grainstep_test(name SOURCES ... DEPENDS ... LABELS ... [TIMEOUT s] [BOTH_ENGINES]): one GoogleTest program, one CTest
# entry per TEST. LABELS long keeps it out of `make test`; LABELS verify puts it on docs/verification.md and brings
# support/verification_record.hpp. BOTH_ENGINES: every test a second time, as native.NAME, with the native engine
# wherever dem-service/engine_rig.hpp runs one.
function(grainstep_test name)
  cmake_parse_arguments(arg "BOTH_ENGINES" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE grainstep_options ${arg_DEPENDS} GTest::gtest GTest::gmock GTest::gtest_main)
  set_target_properties(${name} PROPERTIES GRAINSTEP_COLD ON)  # for its warnings; it is optimised like the code of a step
  grainstep_precompile(${name} test)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  if(verify IN_LIST arg_LABELS)
    target_link_libraries(${name} PRIVATE grainstep::verification_record)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT ${GRAINSTEP_TEST_TIMEOUT})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT ${GRAINSTEP_PATIENCE} TEST_LIST ${name}_list)
  if(arg_BOTH_ENGINES)
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT ${GRAINSTEP_PATIENCE} TEST_PREFIX native. TEST_LIST ${name}_native)
  endif()
  # gtest_discover_tests takes its properties apart at every semicolon, and an empty one shifts what follows it. So they
  # are set on the discovered tests by a file that CTest reads after the discovery.
  set(properties ${CMAKE_CURRENT_BINARY_DIR}/${name}_properties.cmake)
  file(WRITE ${properties} "foreach(test IN LISTS ${name}_list ${name}_native)
  set(engine lammps)
  if(test MATCHES [[^native\\.]])
    set(engine native)
  endif()
  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${arg_LABELS}\" TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT \"GRAINSTEP_TEST_ENGINE=\${engine};GRAINSTEP_TEST=\${test};PATH=${PROJECT_BINARY_DIR}/bin:$ENV{PATH};OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1\")
endforeach()
")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${properties})
endfunction()

# grainstep_verification_script(name SCRIPT file LABELS ... [TIMEOUT s]): a Python test that starts the built programs and
# records with tests/verification/record.py.
function(grainstep_verification_script name)
  cmake_parse_arguments(arg "" "SCRIPT;TIMEOUT" "LABELS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT ${GRAINSTEP_TEST_TIMEOUT})
  endif()
  add_test(NAME ${name} COMMAND ${Python3_EXECUTABLE} ${CMAKE_CURRENT_SOURCE_DIR}/${arg_SCRIPT})
  set_tests_properties(${name} PROPERTIES LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT} ENVIRONMENT
    "GRAINSTEP_TEST=${name};GRAINSTEP_PATIENCE=${GRAINSTEP_PATIENCE};GRAINSTEP_BIN=${PROJECT_BINARY_DIR}/bin;PYTHONDONTWRITEBYTECODE=1;OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1;PYTHONPATH=${PROJECT_SOURCE_DIR}/tests/verification:${PROJECT_SOURCE_DIR}/tests/system")
endfunction()
