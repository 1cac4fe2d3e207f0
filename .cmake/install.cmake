# find_package(tweenfall COMPONENTS ...): the modules install themselves, this adds what finds them.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)
set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/tweenfall)
configure_package_config_file(.cmake/tweenfall-config.cmake.in tweenfall-config.cmake
  INSTALL_DESTINATION ${folder} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(tweenfall-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/tweenfall-config.cmake ${PROJECT_BINARY_DIR}/tweenfall-config-version.cmake
  DESTINATION ${folder})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
