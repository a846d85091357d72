# How every library, program and test of the project is declared: one function each, warnings as errors, C++20.

option(GRAINSTEP_WERROR "Warnings are errors" ON)
option(GRAINSTEP_SANITIZE "Address and undefined-behaviour sanitizers" OFF)

add_library(grainstep_options INTERFACE)
target_compile_features(grainstep_options INTERFACE cxx_std_20)
target_compile_options(grainstep_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Wnon-virtual-dtor -Wold-style-cast
  -Woverloaded-virtual -Wnull-dereference -Wduplicated-cond -Wlogical-op
  # GCC 12 sees overlapping copies in `"text" + std::string` where there are none (GCC bug 105651).
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>
  $<$<BOOL:${GRAINSTEP_WERROR}>:-Werror>
  # Bits must not depend on which operations a compiler fuses where.
  -ffp-contract=off)
if(GRAINSTEP_SANITIZE)
  target_compile_options(grainstep_options INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer -fno-sanitize-recover=undefined)
  target_link_options(grainstep_options INTERFACE -fsanitize=address,undefined)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_CXX_FLAGS_RELWITHDEBINFO "-O3 -g")

# grainstep_library(name SOURCES ... DEPENDS ... PRIVATE_DEPENDS ...): folder = library = namespace.
# Headers are included as "folder/file.hpp".
function(grainstep_library name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  if(arg_SOURCES)
    add_library(grainstep_${name} STATIC ${arg_SOURCES})
    target_include_directories(grainstep_${name} PUBLIC ${CMAKE_CURRENT_SOURCE_DIR}/..)
    target_link_libraries(grainstep_${name} PUBLIC ${arg_DEPENDS} PRIVATE grainstep_options ${arg_PRIVATE_DEPENDS})
    target_compile_features(grainstep_${name} PUBLIC cxx_std_20)
  else()
    add_library(grainstep_${name} INTERFACE)
    target_include_directories(grainstep_${name} INTERFACE ${CMAKE_CURRENT_SOURCE_DIR}/..)
    target_link_libraries(grainstep_${name} INTERFACE ${arg_DEPENDS})
    target_compile_features(grainstep_${name} INTERFACE cxx_std_20)
  endif()
  add_library(grainstep::${name} ALIAS grainstep_${name})
endfunction()

# grainstep_program(name SOURCES ... DEPENDS ...): main only wires.
function(grainstep_program name)
  cmake_parse_arguments(arg "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE grainstep_options ${arg_DEPENDS})
endfunction()

# What a test bears on a loaded machine, s; the number stands in the header. A test may have several such waits, and
# CTest ends it only after that: its limit is for tests that hang, not for machines that are busy.
file(STRINGS ${PROJECT_SOURCE_DIR}/tests/support/patience.hpp GRAINSTEP_PATIENCE REGEX "seconds patience{")
string(REGEX REPLACE ".*{([0-9]+)}.*" "\\1" GRAINSTEP_PATIENCE "${GRAINSTEP_PATIENCE}")
math(EXPR GRAINSTEP_TEST_TIMEOUT "4 * ${GRAINSTEP_PATIENCE}")
math(EXPR GRAINSTEP_LONG_TIMEOUT "12 * ${GRAINSTEP_PATIENCE}")  # of tests that compute for minutes
set_property(DIRECTORY ${PROJECT_SOURCE_DIR} APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS tests/support/patience.hpp)

# grainstep_test(name SOURCES ... DEPENDS ... LABELS ... [TIMEOUT s]): one GoogleTest program, one CTest entry per TEST.
# LABELS long keeps it out of `make test`; LABELS verify puts it on docs/verification.md and brings
# support/verification_record.hpp.
function(grainstep_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;DEPENDS;LABELS" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE grainstep_options ${arg_DEPENDS} GTest::gtest GTest::gmock GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  if(verify IN_LIST arg_LABELS)
    target_link_libraries(${name} PRIVATE grainstep::verification_record)
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT ${GRAINSTEP_TEST_TIMEOUT})
  endif()
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT ${GRAINSTEP_PATIENCE} TEST_LIST ${name}_list)
  # gtest_discover_tests takes its properties apart at every semicolon, and an empty one shifts what follows it. So they
  # are set on the discovered tests by a file that CTest reads after the discovery.
  set(properties ${CMAKE_CURRENT_BINARY_DIR}/${name}_properties.cmake)
  file(WRITE ${properties} "foreach(test IN LISTS ${name}_list)
  set_tests_properties(\"\${test}\" PROPERTIES LABELS \"${arg_LABELS}\" TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT \"GRAINSTEP_TEST=\${test};OMPI_ALLOW_RUN_AS_ROOT=1;OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1\")
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
