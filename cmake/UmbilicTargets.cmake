# SPDX-License-Identifier: LGPL-2.1-or-later
# Compile options of every target, and one function each for tests and benchmarks.

add_library(umbilic_options INTERFACE)
# Contraction to fused operations would make results depend on the machine and void the error bounds.
target_compile_options(umbilic_options INTERFACE -Wall -Wextra -Wno-psabi -Wno-missing-field-initializers -ffp-contract=off)
if(UMBILIC_SANITIZE)
  target_compile_options(umbilic_options INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                                   -fno-omit-frame-pointer -g1)
  target_link_options(umbilic_options INTERFACE -fsanitize=address,undefined)
endif()

# umbilic_add_test(NAME sources... [LIBRARIES targets...]): a GoogleTest program, run test by test through CTest.
function(umbilic_add_test name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE umbilic_options umbilic_test_support GTest::gtest_main ${ARG_LIBRARIES})
  target_compile_definitions(${name} PRIVATE
      UMBILIC_SHARED_CAD_DIR="${UMBILIC_SHARED_CAD_DIR}" UMBILIC_MODELS_DIR="${PROJECT_SOURCE_DIR}/models")
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()

# umbilic_add_benchmark(NAME sources... [LIBRARIES targets...]): a Google Benchmark program, run by ./dev bench.
function(umbilic_add_benchmark name)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(${name} PRIVATE umbilic_options umbilic_test_support benchmark::benchmark_main ${ARG_LIBRARIES})
  target_compile_definitions(${name} PRIVATE
      UMBILIC_SHARED_CAD_DIR="${UMBILIC_SHARED_CAD_DIR}" UMBILIC_MODELS_DIR="${PROJECT_SOURCE_DIR}/models")
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY "${CMAKE_BINARY_DIR}/bench")
endfunction()
