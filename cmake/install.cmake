# cmake --install: the library, its headers, and what find_package(landfall CONFIG) needs. A wheel carries the
# Python module alone.
if(SKBUILD)
  return()
endif()
include(CMakePackageConfigHelpers)
set(landfall_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/landfall)

set_target_properties(landfall PROPERTIES
  VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
install(TARGETS landfall EXPORT landfall-targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/engine/include/landfall DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/bindings/c/landfall.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT landfall-targets NAMESPACE landfall:: DESTINATION ${landfall_config_dir})
get_target_property(landfall_library_type landfall TYPE)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/landfall-config.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/landfall-config.cmake INSTALL_DESTINATION ${landfall_config_dir})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/landfall-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/landfall-config.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/landfall-config-version.cmake DESTINATION ${landfall_config_dir})
