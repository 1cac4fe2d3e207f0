# One module: a static library of every source below src, exported as tweenfall::NAME.
# Sources are found by globbing, so that adding a kind of thing means adding its files and nothing else.
#
# tweenfall_module(NAME PUBLIC what its headers need  PRIVATE what its sources need)
function(tweenfall_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/include/*.h)
  set(target tweenfall_${name})
  add_library(${target} STATIC ${sources})
  add_library(tweenfall::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    EXPORT_NAME ${name} LINKER_LANGUAGE CXX POSITION_INDEPENDENT_CODE ON)
  target_sources(${target} PUBLIC
    FILE_SET HEADERS BASE_DIRS ${CMAKE_CURRENT_SOURCE_DIR}/include FILES ${headers})
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # Public, because inline functions of the headers are compiled with the consumer's flags too:
  # one contracted a*b+c there and the same document gives other bits.
  target_compile_options(${target} PUBLIC -ffp-contract=off)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  tweenfall_flags(${target})
  tweenfall_compile_by_room(${target} src "${sources}")
  tweenfall_precompile(${target} tweenfall_curves)
  if(TWEENFALL_INSTALL)
    include(GNUInstallDirs)
    install(TARGETS ${target} EXPORT tweenfall_${name} FILE_SET HEADERS)
    install(EXPORT tweenfall_${name} NAMESPACE tweenfall:: FILE ${name}.cmake
      DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/tweenfall)
  endif()
endfunction()

# What a unity build compiles as one: sources of one room alone, at most CMAKE_UNITY_BUILD_BATCH_SIZE of them. So a file
# that comes or goes changes what is compiled in its own room and nowhere else. A room is a folder of FOLDER with all
# that is below it; with TWEENFALL_ROOMS_TOGETHER all that is in FOLDER is one.
function(tweenfall_compile_by_room target folder sources)
  set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
  set(size ${CMAKE_UNITY_BUILD_BATCH_SIZE})
  if(NOT size)
    set(size 8)
  endif()
  set(counted "")
  foreach(source IN LISTS sources)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/${folder} OUTPUT_VARIABLE path)
    string(REGEX REPLACE "/.*" "" room "${path}")
    if(room STREQUAL path OR TWEENFALL_ROOMS_TOGETHER)
      set(room ${target})
    endif()
    if(NOT room IN_LIST counted)
      list(APPEND counted ${room})
      set(count_${room} 0)
    endif()
    math(EXPR batch "${count_${room}} / ${size}")
    math(EXPR count_${room} "${count_${room}} + 1")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${batch})
  endforeach()
endfunction()

# The headers that nearly every source includes, compiled once for all targets of the same flags: by OWNER.
function(tweenfall_precompile target owner)
  set(eigen_inlined ${PROJECT_SOURCE_DIR}/.cmake/eigen_inlined.h)
  if(CMAKE_DISABLE_PRECOMPILE_HEADERS)
    target_compile_options(${target} PRIVATE -include ${eigen_inlined})
  elseif(target STREQUAL owner OR NOT TARGET ${owner})
    target_precompile_headers(${target} PRIVATE
      ${eigen_inlined} <Eigen/Geometry> <algorithm> <functional> <memory> <span> <string> <vector>)
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

# How everything of ours is compiled: the same bits everywhere, so no contraction of a*b+c and no fast-math.
function(tweenfall_flags target)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  # Eigen adds in another order where it vectorizes, and what is not inlined is one weak symbol for the whole program:
  # a consumer's own, compiled with other flags, would take the place of ours. So ours is scalar, and inlined always,
  # which eigen_inlined.h, the first of the precompiled headers, sees to.
  target_compile_definitions(${target} PRIVATE EIGEN_DONT_VECTORIZE)
  # Settings are aggregates with defaults, so leaving members out is the manner, not a slip.
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers
    -ffp-contract=off
    # What g++ 12 says of std::string and std::sort when it has inlined them is false (GCC bugs 105329, 105651);
    # and it takes the sources of a unity build for headers, where an anonymous namespace would be odd.
    $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow -Wno-array-bounds -Wno-restrict -Wno-subobject-linkage>
    $<$<BOOL:${TWEENFALL_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()
