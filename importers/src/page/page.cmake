# The page's own text and Debian's three.js become part of the library, so that a page needs no network and no file beside it.
set(page ${CMAKE_CURRENT_SOURCE_DIR}/src/page)
set(page_scripts
  data/recording.js data/rotation.js data/motion.js
  controls/store.js controls/playback.js
  timeline/canvas.js
  scene/geometry.js scene/deform.js scene/bounds.js scene/orbit.js scene/particles.js scene/cast.js scene/scene.js scene/looking.js scene/joints.js scene/steps.js scene/overlay.js
  timeline/axis.js timeline/graphs.js timeline/rows.js timeline/labels.js timeline/strips.js timeline/timeline.js timeline/series.js timeline/curves.js
  controls/readout.js controls/actions.js controls/controls.js controls/main.js)
find_file(TWEENFALL_THREE three.min.js PATHS /usr/share/javascript/three NO_DEFAULT_PATH
          DOC "three.js as Debian's libjs-three installs it; the 3-D page carries it")

set(parts page.html=${page}/page.html page.css=${page}/page.css
  beside.html=${page}/beside/beside.html beside.js=${page}/beside/beside.js)
set(part_files ${page}/embed.cmake ${page}/page.html ${page}/page.css ${page}/beside/beside.html ${page}/beside/beside.js)
foreach(script IN LISTS page_scripts)
  list(APPEND parts page.js=${page}/${script})
  list(APPEND part_files ${page}/${script})
endforeach()
if(TWEENFALL_THREE)
  list(APPEND parts three.js=${TWEENFALL_THREE})
  list(APPEND part_files ${TWEENFALL_THREE})
else()
  message(WARNING "three.js is not installed: everything builds, but no HTML pages can be written (`tweenfall view`, "
                  "`run -o NAME.html`). To have them: apt-get install libjs-three, then configure again with "
                  "-U TWEENFALL_THREE.")
endif()

set(page_source ${CMAKE_CURRENT_BINARY_DIR}/page_files.cpp)
add_custom_command(OUTPUT ${page_source}
  COMMAND ${CMAKE_COMMAND} -DOUT=${page_source} "-DPARTS=${parts}" -P ${page}/embed.cmake
  DEPENDS ${part_files} COMMENT "Embedding the page" VERBATIM)
set_source_files_properties(${page_source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
target_sources(tweenfall_importers PRIVATE ${page_source})
