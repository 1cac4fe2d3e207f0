# One module: a static library of every source below src, exported as tweenfall::NAME.
# Sources are found by globbing, so that adding a kind of thing means adding its files and nothing else.
function(tweenfall_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE")
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp)
  if(NOT sources)
    add_library(tweenfall_${name} INTERFACE)
    add_library(tweenfall::${name} ALIAS tweenfall_${name})
    return()
  endif()
  add_library(tweenfall_${name} STATIC ${sources})
  add_library(tweenfall::${name} ALIAS tweenfall_${name})
  set_target_properties(tweenfall_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(tweenfall_${name} PUBLIC cxx_std_20)
  target_include_directories(tweenfall_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:include>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(tweenfall_${name} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
  tweenfall_flags(tweenfall_${name})
endfunction()

# The same bits everywhere: no contraction of a*b+c, no fast-math.
function(tweenfall_flags target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wno-missing-field-initializers -ffp-contract=off
    $<$<BOOL:${TWEENFALL_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()
