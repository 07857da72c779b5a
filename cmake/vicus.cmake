# What every folder's library and test shares: warnings, sanitizers, names.

add_library(vicus_options INTERFACE)
target_compile_options(vicus_options INTERFACE -Wall -Wextra -Wconversion -Wshadow -Wpedantic)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # g++ 12 warns falsely about "text" + std::string at -O3 (GCC bug 105329).
  target_compile_options(vicus_options INTERFACE -Wno-restrict)
endif()
if(VICUS_WERROR)
  target_compile_options(vicus_options INTERFACE -Werror)
endif()
if(VICUS_SANITIZE)
  target_compile_options(vicus_options INTERFACE -fsanitize=${VICUS_SANITIZE} -fno-omit-frame-pointer
                         -fno-sanitize-recover=all)
  target_link_options(vicus_options INTERFACE -fsanitize=${VICUS_SANITIZE})
endif()
option(VICUS_FUZZ "Build the libFuzzer targets (clang)" OFF)
if(VICUS_FUZZ)
  # What is fuzzed tells which ways it went.
  target_compile_options(vicus_options INTERFACE -fsanitize=fuzzer-no-link)
endif()
target_include_directories(vicus_options INTERFACE ${CMAKE_SOURCE_DIR})

# vicus_library(FOLDER [DEPENDS lib…]): static library vicus_FOLDER from the folder's own sources.
function(vicus_library folder)
  cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  if(NOT sources)
    add_library(vicus_${folder} INTERFACE)
    return()
  endif()
  add_library(vicus_${folder} STATIC ${sources})
  target_link_libraries(vicus_${folder} PUBLIC vicus_options ${ARG_DEPENDS})
endfunction()

# vicus_test(FOLDER [DEPENDS lib…]): GoogleTest program test_FOLDER from tests/FOLDER, one CTest entry for each test.
function(vicus_test folder)
  cmake_parse_arguments(ARG "" "" "DEPENDS" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${folder} ${sources})
  target_link_libraries(test_${folder} PRIVATE vicus_options vicus_${folder} ${ARG_DEPENDS} GTest::gmock GTest::gtest_main)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    # g++ 12 warns falsely about vectors copied from short initialiser lists at -O3 (GCC bug 105705).
    target_compile_options(test_${folder} PRIVATE -Wno-stringop-overflow -Wno-array-bounds)
  endif()
  gtest_discover_tests(test_${folder} TEST_PREFIX "${folder}." DISCOVERY_TIMEOUT 60
                       PROPERTIES TIMEOUT 600 ENVIRONMENT "VICUS_BUILD_DIR=${CMAKE_BINARY_DIR}"
                       WORKING_DIRECTORY ${CMAKE_SOURCE_DIR})
endfunction()
