# What a build of tweenfall itself takes when nothing was said; a consumer's project decides for itself.
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo or MinSizeRel" FORCE)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(TWEENFALL_CCACHE ccache)
if(TWEENFALL_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  # Precompiled headers carry times and macros that ccache would otherwise refuse to look past.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${TWEENFALL_CCACHE})
endif()

# Sources are compiled several as one, in about half the time. The names that a room keeps to itself, those of anonymous
# namespaces too, therefore stand in the room's own namespace (tweenfall::slopes, tweenfall::staging) and are used once
# per room; those that stand in tweenfall itself, once per module. -DCMAKE_UNITY_BUILD=OFF compiles each alone.
# tweenfall_compile_by_room in module.cmake says which are compiled together.
# Few as one where sources change; many, and rooms together, where all is compiled anyway: what they share is then read
# less often.
if(NOT DEFINED CMAKE_UNITY_BUILD)
  set(CMAKE_UNITY_BUILD ON)
endif()
option(TWEENFALL_BUILT_ONCE "build what is tested once and thrown away: many sources as one, little optimized" $ENV{CI})
if(NOT DEFINED CMAKE_UNITY_BUILD_BATCH_SIZE)
  set(batch 5)
  if(TWEENFALL_BUILT_ONCE)
    set(batch 32)
    option(TWEENFALL_ROOMS_TOGETHER "compile sources of several rooms as one" ON)
  endif()
  set(CMAKE_UNITY_BUILD_BATCH_SIZE ${batch} CACHE STRING "how many sources are compiled as one")
endif()
# For one run of the tests optimizing thoroughly takes longer than it saves. The bits are the same, which so is tested
# too; what users build is tested by .ci/nightly.
if(TWEENFALL_BUILT_ONCE)
  string(REPLACE "-O3" "-O1" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
endif()
